// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/OutOfCoreTriangulation.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "OutOfCore/Checkpoint.h"
#include "OutOfCore/InputSurvey.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/ScratchFolder.h"
#include "OutOfCore/SpillPoints.h"
#include "Parallel/Stopwatch.h"

#include <omp.h>

#include <algorithm>
#include <memory>

namespace tipp
{
namespace
{

constexpr const char* representativeName = "RepresentativePointId";

/// Not an error: the user's wish.
struct Aborted
{
};

/// What the statistics of a whole mesh say whichever process has finished it.
template <typename Archive>
void exchangeFigures(Archive& archive, OutOfCoreStatistics& statistics)
{
  archive(statistics.Points);
  archive(statistics.Triangles);
  archive(statistics.TriangleSum);
  archive(statistics.Duplicates);
  archive(statistics.Rejected);
  archive(statistics.Pieces);
  archive(statistics.Partitions);
  archive(statistics.WorkerVertices);
  archive(statistics.PeakRimTriangles);
  archive(statistics.PeakBorderBytes);
  archive(statistics.SpilledBytes);
  archive(statistics.MeshBytes);
}

class Run
{
public:
  Run(PointStream& points, const std::string& path, const OutOfCoreOptions& options)
    : Input(points)
    , Path(path)
    , Options(options)
    , Threads(options.Threads > 0 ? options.Threads : omp_get_max_threads())
    , Pending(PendingFolder::lasting(path, &replaceableMesh))
    , Scratch(this->Pending, options.Scratch)
  {
    this->Statistics.Threads = this->Threads;
    this->Mesh.Path = options.CountOnly ? "" : this->Pending.temporaryPath();
  }

  OutOfCoreStatistics run()
  {
    try
    {
      if (!this->resume())
      {
        this->survey();
        this->spill();
      }
      if (!this->IsWhole)
      {
        this->triangulate();
        this->Options.CountOnly ? this->count() : this->publish();
      }
      this->putInPlace();
    }
    catch (const Aborted&)
    {
      this->Statistics.Aborted = true;
    }
    return std::move(this->Statistics);
  }

private:
  void report(double fraction) const
  {
    if (this->Options.Progress && !this->Options.Progress(fraction))
    {
      throw Aborted();
    }
  }

  void endPhase(const char* name)
  {
    this->Statistics.Phases.push_back({ name, this->Watch.restart() });
  }

  void keep(bool kept = true)
  {
    this->Pending.keep(kept);
    this->Scratch.keep(kept);
    this->Statistics.Kept = kept;
  }

  /// False if there is nothing to resume.
  bool resume()
  {
    if (!this->Scratch.hasPlan())
    {
      return false;
    }
    this->keep();
    const Bytes bytes = readCheckpoint(this->Scratch.plan());
    LoadArchive archive(bytes);
    std::string identity;
    archive(identity);
    const bool isOurs = identity == this->identity();
    std::uint8_t isWhole = 0;
    archive(isWhole);
    this->IsWhole = isWhole == 1;
    this->IsWhole ? this->resumeWhole(archive, isOurs) : this->resumeBegun(archive, isOurs);
    this->Statistics.Resumed = this->Statistics.Kept;
    this->endPhase("resume");
    return this->Statistics.Resumed;
  }

  void resumeBegun(LoadArchive& archive, bool isOurs)
  {
    this->requireOurs(isOurs && this->Options.Resume);
    this->exchangeInput(archive);
    this->Memory = std::make_unique<MemoryPlan>(this->Options, this->Rows.Words);
    this->Plan = std::make_unique<PiecePlan>(archive);
    this->Spilled =
      std::make_unique<SpilledPoints>(this->Scratch.points(), *this->Plan, this->Rows, archive);
    this->describeMesh();
  }

  /// After recordWhole().
  void resumeWhole(LoadArchive& archive, bool isOurs)
  {
    exchangeFigures(archive, this->Statistics);
    archive(this->Fingerprint);
    this->IsInPlace = this->Fingerprint != 0 && fingerprintOf(this->Path) == this->Fingerprint;
    if (this->IsInPlace && !isOurs) // what is left of that run is of no use
    {
      this->keep(false);
      this->Statistics = {};
      this->Statistics.Threads = this->Threads;
      this->IsWhole = this->IsInPlace = false;
      return;
    }
    this->requireOurs(isOurs);
    if (!this->IsInPlace && fingerprintOf(this->Pending.temporaryPath()) != this->Fingerprint)
    {
      throw IOError(
        this->Pending.temporaryPath(), "is damaged; remove the folder around it and start again.");
    }
  }

  void requireOurs(bool isOurs) const
  {
    if (!isOurs)
    {
      throw IOError(this->Path,
        this->Options.Resume
          ? "was begun with another input, or with one that has been changed since, or with other "
            "options; give those, or remove " +
            this->Pending.workPath() + " to start again."
          : "has been begun by another run, and its work is in " + this->Pending.workPath() +
            "; resume it, or remove that folder to start again.");
    }
  }

  template <typename Archive>
  void exchangeInput(Archive& archive)
  {
    archive(this->Survey.Points);
    archive(this->Survey.Rejected);
    archive(this->Survey.Bounds);
    archive(this->Survey.Factor);
    archive(this->Survey.Collinear);
    archive(this->Rows.Words);
    archive(this->Rows.Z);
    archive(this->Rows.Attributes);
    std::vector<std::string> names;
    for (const StoredArray& array : this->Mesh.Arrays)
    {
      names.push_back(array.Name);
    }
    archive(names);
    this->Mesh.Arrays.clear();
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const bool isId = this->Rows.Attributes[i] < 0;
      this->Mesh.Arrays.push_back(
        { names[i], true, isId ? Scalar::Int64 : Scalar::Float64, 1, -1 });
    }
  }

  /// What tells that it is the same run.
  std::string identity() const
  {
    const OutOfCoreOptions& options = this->Options;
    return "TIPP out of core 2\n" + this->Input.identity() + std::to_string(options.Columns) + "x" +
      std::to_string(options.Rows) + " " + std::to_string(options.PiecePoints) + " " +
      std::to_string(options.PartitionPoints) + (options.MapDuplicates ? " mapped" : "") +
      (options.CountOnly ? " counted" : "") + "\n" + options.Scratch;
  }

  void savePlan()
  {
    SaveArchive archive;
    archive(this->identity());
    archive(std::uint8_t(this->IsWhole));
    this->exchangeInput(archive);
    this->Plan->save(archive);
    this->Spilled->save(archive);
    writeCheckpoint(this->Scratch.plan(), archive);
    this->keep();
  }

  void survey()
  {
    this->Scratch.clear();
    this->Memory = std::make_unique<MemoryPlan>(this->Options, 3 + this->Input.columns().size());
    this->Survey = surveyInput(this->Input, this->Memory->BlockPoints, this->Memory->SamplePoints,
      this->Threads, [this](std::int64_t) { this->report(0); });
    this->describeColumns();
    this->Memory = std::make_unique<MemoryPlan>(this->Options, this->Rows.Words);
    if (this->Survey.Points == this->Survey.Rejected)
    {
      throw IOError("There is no point with finite coordinates in the input, so nothing to write.");
    }
    this->requireSpace();
    this->Plan = std::make_unique<PiecePlan>(
      this->Survey, this->Options, *this->Memory, this->Rows.Words, this->Threads);
    this->Survey.Sample = {};
    this->describeMesh();
    this->endPhase("survey");
  }

  void requireSpace() const
  {
    const auto points = std::uint64_t(this->Survey.Points - this->Survey.Rejected);
    // Borders and ids of cells included; two triangles a point at most.
    const std::uint64_t stored =
      points * (24 + 8 + 1 + 8 * this->Mesh.Arrays.size() + 2 * (12 + 4 + 1 + 8)) / 50 * 51;
    this->Scratch.requireSpace(
      this->Path, this->Options.CountOnly ? 0 : stored, points * 8 * this->Rows.Words);
  }

  void describeColumns()
  {
    const std::vector<std::string> columns = this->Input.columns();
    this->Rows.Words = 3 + columns.size();
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      const bool isZ = this->Rows.Z < 0 && (columns[i] == "z" || columns[i] == "Z");
      if (isZ)
      {
        this->Rows.Z = int(2 + i);
        continue;
      }
      this->Mesh.Arrays.push_back({ columns[i], true, Scalar::Float64, 1, -1 });
      this->Rows.Attributes.push_back(int(2 + i));
    }
    if (this->Options.MapDuplicates)
    {
      this->Mesh.Arrays.push_back({ representativeName, true, Scalar::Int64, 1, -1 });
      this->Rows.Attributes.push_back(-1);
    }
  }

  void describeMesh()
  {
    this->Statistics.Points = this->Survey.Points;
    this->Statistics.Rejected = this->Survey.Rejected;
    this->Statistics.Pieces = this->Plan->pieces();
    this->Statistics.Partitions = this->Plan->Partitions.size();
    PartitionedMesh& mesh = this->Mesh;
    mesh.Points = this->Survey.Points;
    mesh.Tiling = "delaunay:" + std::to_string(this->Plan->pieces());
    mesh.Domain = this->boundsOf(this->Survey.Bounds);
    mesh.Pieces.resize(std::size_t(this->Plan->pieces()));
    for (PartitionIndex piece = 0; piece < this->Plan->pieces(); ++piece)
    {
      mesh.Pieces[this->Plan->number(piece)].Box = this->boundsOf(this->Plan->Pieces.box(piece));
    }
  }

  Bounds boundsOf(const Box2& box) const
  {
    const double factor = this->Survey.Factor;
    return { box.xmin / factor, box.xmax / factor, box.ymin / factor, box.ymax / factor, 0, 0 };
  }

  void spill()
  {
    this->Spilled = std::make_unique<SpilledPoints>(this->Input, this->Survey, *this->Plan,
      this->Rows, this->Scratch.points(), this->Memory->BlockPoints, this->Threads,
      [this](std::int64_t done)
      { this->report(0.2 * double(done) / double(this->Survey.Points)); });
    this->Statistics.SpilledBytes = this->Spilled->bytes();
    this->requireMemory();
    this->savePlan();
    this->endPhase("spill");
  }

  /// Pieces are of equal size but where very many points share a place.
  void requireMemory() const
  {
    std::int64_t most = 0;
    for (PartitionIndex piece = 0; piece < this->Plan->pieces(); ++piece)
    {
      most = std::max(most, this->Spilled->count(piece));
    }
    constexpr std::uint64_t always = std::uint64_t(64) << 20;
    const std::uint64_t bytes = MemoryPlan::pieceBytes(most, this->Rows.Words);
    if (bytes > std::max(this->Options.MemoryLimit, always))
    {
      throw IOError(this->Path,
        "would have a piece of " + std::to_string(most) + " points, which takes " +
          std::to_string(bytes / 1000000 + 1) + " MB; allow more memory.");
    }
  }

  void triangulate()
  {
    PieceRun pieces(*this->Plan, *this->Spilled, this->Survey.Factor, this->Rows, this->Mesh,
      *this->Memory, this->Threads,
      [this](std::int64_t done)
      {
        return !this->Options.Progress ||
          this->Options.Progress(0.2 + 0.7 * double(done) / double(this->Survey.Points));
      });
    if (!this->Survey.Collinear && !this->Plan->IsAlone)
    {
      pieces.setCheckpoint(this->Scratch.state());
    }
    const bool isDone = this->Survey.Collinear ? pieces.writePointsAlone()
      : this->Plan->IsAlone                    ? pieces.triangulateAlone()
                                               : pieces.triangulate();
    if (!isDone)
    {
      throw Aborted();
    }
    this->Statistics.Duplicates = pieces.Duplicates;
    this->Statistics.WorkerVertices = pieces.WorkerVertices;
    this->Statistics.PeakRimTriangles = pieces.PeakRimTriangles;
    this->Statistics.PeakBorderBytes = pieces.PeakBorderBytes;
    this->Finished = std::move(pieces.finished());
    this->endPhase("triangulate");
  }

  void count()
  {
    for (const FinishedPiece& piece : this->Finished)
    {
      this->Statistics.Triangles += piece.Summary.Cells;
      this->Statistics.TriangleSum += piece.TriangleSum;
    }
    this->recordWhole();
  }

  void publish()
  {
    for (std::size_t number = 0; number < this->Finished.size(); ++number)
    {
      FinishedPiece& piece = this->Finished[number];
      writeCellIds(this->Mesh, number, this->Mesh.Cells, piece);
      this->Mesh.Cells += piece.Summary.Cells;
      this->report(0.9 + 0.05 * double(number) / double(this->Finished.size()));
    }
    this->Statistics.Triangles = this->Mesh.Cells;
    for (std::size_t number = 0; number < this->Finished.size(); ++number)
    {
      syncToDisk(this->Mesh.piecePath(number));
      this->report(0.95 + 0.05 * double(number) / double(this->Finished.size()));
    }
    this->Statistics.MeshBytes = publishPieces(this->Mesh, this->Finished);
    this->Fingerprint = fingerprintOf(this->Mesh.Path);
    this->recordWhole();
  }

  /// Takes the plan's place: from now on neither the plan nor anything else in the work folder but
  /// the mesh is needed, and whatever ends the process, another has only to put it in place.
  void recordWhole()
  {
    this->IsWhole = true;
    SaveArchive archive;
    archive(this->identity());
    archive(std::uint8_t(this->IsWhole));
    exchangeFigures(archive, this->Statistics);
    archive(this->Fingerprint);
    writeCheckpoint(this->Scratch.plan(), archive);
    syncToDisk(this->Scratch.plan());
    syncToDisk(this->Pending.workPath());
  }

  void putInPlace()
  {
    if (this->Options.Progress)
    {
      this->Options.Progress(1); // too late to end it
    }
    if (this->Fingerprint != 0 && !this->IsInPlace)
    {
      this->Pending.commit();
    }
    this->Spilled.reset();
    this->keep(false);
    this->endPhase("publish");
  }

  PointStream& Input;
  const std::string Path;
  const OutOfCoreOptions& Options;
  const int Threads;
  PendingFolder Pending;
  ScratchFolder Scratch;
  OutOfCoreStatistics Statistics;
  std::unique_ptr<MemoryPlan> Memory;
  InputSurvey Survey;
  PointRowLayout Rows;
  PartitionedMesh Mesh;
  std::unique_ptr<PiecePlan> Plan;
  std::unique_ptr<SpilledPoints> Spilled;
  std::vector<FinishedPiece> Finished;
  bool IsWhole = false;          ///< all files of the mesh are there, or all triangles are counted
  bool IsInPlace = false;        ///< where it belongs
  std::uint64_t Fingerprint = 0; ///< of the whole mesh
  Stopwatch Watch;
};

} // namespace

OutOfCoreStatistics triangulateOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions& options)
{
  return Run(points, path, options).run();
}

} // namespace tipp

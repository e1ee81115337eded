// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/OutOfCoreTriangulation.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "OutOfCore/InputSurvey.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/SpillPoints.h"
#include "Partitioned/PendingMesh.h"
#include "Triangulation/Stopwatch.h"

#include <omp.h>

#include <filesystem>
#include <memory>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* representativeName = "RepresentativePointId";

/// Not an error: the user's wish.
struct Aborted
{
};

class Run
{
public:
  Run(PointStream& points, const std::string& path, const OutOfCoreOptions& options)
    : Input(points)
    , Path(path)
    , Options(options)
    , Threads(options.Threads > 0 ? options.Threads : omp_get_max_threads())
    , Pending(path)
  {
    this->Statistics.Threads = this->Threads;
  }

  OutOfCoreStatistics run()
  {
    try
    {
      this->survey();
      this->spill();
      this->triangulate();
      this->publish();
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

  void survey()
  {
    fs::create_directory(this->Pending.temporaryPath() + "/pieces");
    this->Memory =
      std::make_unique<MemoryPlan>(this->Options, 3 + this->Input.columns().size(), this->Threads);
    this->Survey = surveyInput(this->Input, this->Memory->BlockPoints, this->Memory->SamplePoints,
      this->Threads, [this](std::int64_t) { this->report(0); });
    this->describeColumns();
    this->Memory = std::make_unique<MemoryPlan>(this->Options, this->Rows.Words, this->Threads);
    this->Statistics.Points = this->Survey.Points;
    this->Statistics.Rejected = this->Survey.Rejected;
    if (this->Survey.Points == this->Survey.Rejected)
    {
      throw IOError("There is no point with finite coordinates in the input, so nothing to write.");
    }
    this->Plan = std::make_unique<PiecePlan>(
      this->Survey, this->Options, *this->Memory, this->Rows.Words, this->Threads);
    this->Survey.Sample = {};
    this->Statistics.Pieces = this->Plan->pieces();
    this->Statistics.Partitions = this->Plan->Partitions.size();
    this->describeMesh();
    this->endPhase("survey");
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
    PartitionedMesh& mesh = this->Mesh;
    mesh.Path = this->Pending.temporaryPath();
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
    this->Spilled =
      std::make_unique<SpilledPoints>(this->Input, this->Survey, *this->Plan, this->Rows,
        this->Pending.temporaryPath() + "/.points", this->Memory->BlockPoints, this->Threads,
        [this](std::int64_t done)
        { this->report(0.2 * double(done) / double(this->Survey.Points)); });
    this->Statistics.SpilledBytes = this->Spilled->bytes();
    this->endPhase("spill");
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

  void publish()
  {
    this->Spilled.reset();
    std::error_code ignored;
    fs::remove(this->Pending.temporaryPath() + "/.points.0", ignored);
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
    this->Pending.commit();
    this->endPhase("publish");
  }

  PointStream& Input;
  const std::string Path;
  const OutOfCoreOptions& Options;
  const int Threads;
  PendingMesh Pending;
  OutOfCoreStatistics Statistics;
  std::unique_ptr<MemoryPlan> Memory;
  InputSurvey Survey;
  PointRows Rows;
  PartitionedMesh Mesh;
  std::unique_ptr<PiecePlan> Plan;
  std::unique_ptr<SpilledPoints> Spilled;
  std::vector<FinishedPiece> Finished;
  Stopwatch Watch;
};

} // namespace

OutOfCoreStatistics triangulateOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions& options)
{
  return Run(points, path, options).run();
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/OutOfCoreTriangulation.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "OutOfCore/Checkpoint.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/OutOfCoreRanks.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/PreparedRun.h"
#include "OutOfCore/ScratchFolder.h"
#include "OutOfCore/TriangleTaker.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Partitioned/NeighborIds.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace tipp
{
namespace
{

/// Not an error: the user's wish.
struct Aborted
{
};

/// Different for different numbers.
std::string exactText(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// What the statistics of a whole mesh say whichever process has finished it.
template <typename Archive>
void exchangeFigures(Archive& archive, OutOfCoreStatistics& statistics)
{
  archive(statistics.Points);
  archive(statistics.Triangles);
  archive(statistics.TriangleSum);
  archive(statistics.Rejected);
  archive(statistics.Pieces);
  archive(statistics.Partitions);
  archive(static_cast<PieceFigures&>(statistics));
  archive(statistics.SpilledBytes);
  archive(statistics.MeshBytes);
}

class Run
{
public:
  Run(PointStream& points, const std::string& path, const OutOfCoreOptions& options,
    Communicator* ranks)
    : Input(points)
    , Ranks(ranks)
    , Path(path)
    , Options(options)
    , Threads(threadCount(options.Threads))
    , Pending(PendingFolder::lasting(path, &replaceableMesh))
    , Scratch(this->Pending, options.Scratch)
  {
    this->Statistics.Threads = this->Threads;
    this->Prepared.Mesh.Path = options.CountOnly ? "" : this->Pending.temporaryPath();
    this->Prepared.Results = this->Scratch.results();
    this->Prepared.Taker = options.Taker;
    this->Prepared.MaximumEdge = options.MaximumEdge;
    this->Prepared.Duplicates = options.Duplicates;
  }

  OutOfCoreStatistics run()
  {
    try
    {
      if (this->Ranks)
      {
        requireSharedFolder(*this->Ranks, this->Pending.workPath());
        requireSharedFolder(*this->Ranks, this->Scratch.folder());
      }
      if (!this->resume())
      {
        this->survey();
        this->spill();
      }
      if (!this->IsWhole)
      {
        this->Prepared.beginTaking();
        this->triangulate();
        this->endTaking();
        this->Options.CountOnly ? this->count() : this->publish();
      }
      this->putInPlace();
    }
    catch (const Aborted&)
    {
      this->Statistics.Aborted = true;
    }
    catch (const RankFailure& failure)
    {
      if (!failure.Aborted)
      {
        throw;
      }
      this->Statistics.Aborted = true;
    }
    return std::move(this->Statistics);
  }

private:
  void report(double fraction) const
  {
    if (this->Ranks)
    {
      Message message; // there is none but of a failure, which is thrown
      this->Ranks->poll(message);
    }
    this->tell(fraction);
  }

  void tell(double fraction) const
  {
    if (this->Options.Progress && !this->Options.Progress(fraction))
    {
      throw Aborted();
    }
  }

  void warn(const std::string& sentence) const
  {
    if (this->Options.Warn)
    {
      this->Options.Warn(sentence);
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
    if (!this->Scratch.hasRun())
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
    this->Prepared.load(archive, this->Scratch.points());
    this->planMemory(this->Prepared.Rows.Words);
    this->describePlan();
  }

  /// After recordWhole().
  void resumeWhole(LoadArchive& archive, bool isOurs)
  {
    exchangeFigures(archive, this->Statistics);
    archive(this->Fingerprint);
    this->IsInPlace = this->Fingerprint != 0 && holdsMesh(this->Path, this->Fingerprint);
    if (this->IsInPlace && !isOurs) // what is left of that run is of no use
    {
      this->keep(false);
      this->Statistics = {};
      this->Statistics.Threads = this->Threads;
      this->IsWhole = this->IsInPlace = false;
      return;
    }
    this->requireOurs(isOurs);
    if (this->hasMeshToPublish())
    {
      this->verifyWhole();
    }
  }

  bool hasMeshToPublish() const { return !this->Options.CountOnly && !this->IsInPlace; }

  /// The process that made the mesh has ended, and its files may have changed since.
  void verifyWhole() const
  {
    try
    {
      verifyMesh(this->Pending.temporaryPath(), this->Fingerprint, this->Threads);
    }
    catch (const IOError& error)
    {
      throw IOError(error.path(),
        "is damaged or missing; remove " + this->Pending.workPath() + " and start again.");
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

  void planMemory(std::size_t words)
  {
    this->Memory = std::make_unique<MemoryPlan>(this->Options, words);
  }

  /// What tells that it is the same run.
  std::string identity() const
  {
    const OutOfCoreOptions& options = this->Options;
    return "TIPP out of core 9\n" + this->Input.identity() + std::to_string(options.Columns) + "x" +
      std::to_string(options.Rows) + " " + std::to_string(options.PiecePoints) + " " +
      std::to_string(options.PartitionPoints) + (options.MapDuplicates ? " mapped" : "") +
      (options.Neighbors ? " linked" : "") + (options.CountOnly ? " counted" : "") +
      (options.MaximumEdge > 0 ? " edges " + exactText(options.MaximumEdge) : "") +
      (options.Duplicates != DuplicateRule::First
          ? " duplicates " + std::to_string(int(options.Duplicates))
          : "") +
      "\n" + (options.Taker ? options.Taker->identity() : "") + "\n" + options.Scratch;
  }

  void savePlan()
  {
    writeCheckpoint(this->Scratch.plan(),
      [this](SaveArchive& archive)
      {
        archive(this->identity());
        archive(std::uint8_t(this->IsWhole));
        this->Prepared.save(archive);
      });
    this->keep();
  }

  void survey()
  {
    this->keep(false);
    this->Scratch.clear();
    this->planMemory(3 + this->Input.columns().size());
    InputSurvey& survey = this->Prepared.Survey;
    survey = InputPasses(this->Input, this->Ranks,
      this->passOptions(
        [this](std::int64_t) {
          this->tell(0);
        })).survey();
    this->Statistics.LeftOut = this->Input.leftOut();
    this->Statistics.ThinnedOut = this->Input.thinnedOut();
    this->Prepared.describeColumns(
      this->Input.columns(), this->Options.MapDuplicates, this->Options.Neighbors);
    const std::size_t words = this->Prepared.Rows.Words;
    this->planMemory(words);
    requireElevation(this->Options.Duplicates, this->Input.columns());
    if (survey.Points == survey.Rejected)
    {
      throw IOError("There is no point with finite coordinates in the input, so nothing to write.");
    }
    this->requireSpace(0);
    this->Prepared.Plan =
      std::make_unique<PiecePlan>(survey, this->Options, *this->Memory, words, this->Threads);
    std::vector<SampledPoint>().swap(survey.Sample); // = {} would keep the memory
    if (this->Prepared.Plan->HasLargeRim)
    {
      // Each piece is sent nearly all points of those before it.
      constexpr std::uint64_t sent = 32 / 2;
      constexpr std::uint64_t border = 64;
      this->requireSpace(sent * std::uint64_t(this->Prepared.Plan->pieces()) + border);
    }
    this->Prepared.describeMesh();
    this->describePlan();
    this->endPhase("survey");
  }

  PassOptions passOptions(const std::function<void(std::int64_t)>& progress) const
  {
    return { this->Memory->BlockPoints, this->Memory->SamplePoints, this->Threads, progress };
  }

  void describePlan()
  {
    this->Statistics.Points = this->Prepared.Survey.Points;
    this->Statistics.Rejected = this->Prepared.Survey.Rejected;
    this->Statistics.Pieces = this->Prepared.Plan->pieces();
    this->Statistics.Partitions = this->Prepared.Plan->Partitions.size();
  }

  /// With so many bytes a point more than usual in the scratch folder.
  void requireSpace(std::uint64_t more) const
  {
    const auto points =
      std::uint64_t(this->Prepared.Survey.Points - this->Prepared.Survey.Rejected);
    const std::uint64_t cell = 12 + 4 + 1 + 8 + (this->Options.Neighbors ? 24 : 0);
    // Borders and ids of cells included; two triangles a point at most.
    const std::uint64_t stored =
      points * (24 + 8 + 1 + 8 * this->Prepared.Rows.Attributes.size() + 2 * cell) / 50 * 51;
    constexpr std::uint64_t results = 4; // of pieces of 30,000 points
    this->Scratch.requireSpace(this->Path, this->Options.CountOnly ? 0 : stored,
      points * (8 * this->Prepared.Rows.Words + results + more) + this->Prepared.takenBytes());
  }

  void spill()
  {
    const InputSurvey& survey = this->Prepared.Survey;
    const auto progress = [&](std::int64_t done)
    { this->tell(0.2 * double(done) / double(survey.Points)); };
    this->Prepared.Spilled =
      InputPasses(this->Input, this->Ranks, this->passOptions(progress))
        .spill(survey, *this->Prepared.Plan, this->Prepared.Rows, this->Scratch.points());
    this->Statistics.SpilledBytes = this->Prepared.Spilled->bytes();
    this->requireMemory();
    this->savePlan();
    this->endPhase("spill");
  }

  /// Pieces are of equal size but where very many points share a place.
  void requireMemory() const
  {
    std::int64_t most = 0;
    for (PartitionIndex piece = 0; piece < this->Prepared.Plan->pieces(); ++piece)
    {
      most = std::max(most, this->Prepared.Spilled->count(piece));
    }
    constexpr std::uint64_t always = std::uint64_t(64) << 20;
    const std::uint64_t bytes = MemoryPlan::pieceBytes(most, this->Prepared.Rows.Words);
    if (bytes > std::max(this->Options.MemoryLimit, always))
    {
      throw IOError(this->Path,
        "would have a piece of " + std::to_string(most) + " points, which takes " +
          std::to_string(bytes / 1000000 + 1) + " MB; allow more memory.");
    }
  }

  void triangulate()
  {
    if (this->Prepared.Survey.Collinear || this->Prepared.Plan->IsAlone)
    {
      this->triangulateAlone();
      this->endPhase("triangulate");
      return;
    }
    const PieceWork work = this->Prepared.work();
    const std::vector<char> isDone = verifyResults(
      work, this->Threads, [this](double) { return this->proceed(0.2); },
      [this](const std::string& sentence) { this->warn(sentence); });
    if (isDone.empty())
    {
      throw Aborted();
    }
    if (this->Ranks)
    {
      sharePrepared(*this->Ranks, this->Prepared, this->Scratch.points(), isDone);
    }
    const double all = double(this->Prepared.Survey.Points);
    PieceRun pieces(
      work, *this->Memory, this->Threads,
      [&](std::int64_t done) { return this->proceed(0.2 + 0.65 * double(done) / all); },
      this->Ranks);
    if (!pieces.run(isDone))
    {
      throw Aborted();
    }
    this->Finished = finishPieces(
      work, this->Threads, [this](double done) { return this->proceed(0.85 + 0.05 * done); },
      this->Statistics);
    if (this->Finished.empty())
    {
      throw Aborted();
    }
    this->endPhase("triangulate");
  }

  bool proceed(double fraction) const
  {
    return !this->Options.Progress || this->Options.Progress(fraction);
  }

  /// Pieces that have no borders with others.
  void triangulateAlone()
  {
    const PieceWork work = this->Prepared.work();
    const double all = double(this->Prepared.Survey.Points);
    const auto tellPoints = [&](std::int64_t done)
    { return this->proceed(0.2 + 0.7 * double(done) / all); };
    std::int64_t done = 0;
    bool isGoingOn = true;
    this->Finished.resize(std::size_t(work.Plan.pieces()));
    for (PartitionIndex piece = 0; isGoingOn && piece < work.Plan.pieces(); ++piece)
    {
      LoadedPiece loaded(work, piece);
      FinishedPiece& finished = this->Finished[work.Plan.number(piece)];
      if (!this->Prepared.Survey.Collinear)
      {
        isGoingOn = loaded.triangulateAlone([&](std::size_t inserted)
          { return tellPoints(std::int64_t(inserted)); },
          this->Statistics, finished);
        continue;
      }
      finished = loaded.writePointsAlone(this->Statistics);
      isGoingOn = tellPoints(done += work.Points.count(piece));
    }
    if (!isGoingOn)
    {
      throw Aborted();
    }
  }

  void endTaking()
  {
    if (this->Options.Taker &&
      !this->Options.Taker->end([this](double done) { return this->proceed(0.9 + 0.1 * done); }))
    {
      throw Aborted();
    }
    this->Options.Taker ? this->endPhase("raster") : void();
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

  void numberCells()
  {
    PartitionedMesh& mesh = this->Prepared.Mesh;
    for (std::size_t number = 0; number < this->Finished.size(); ++number)
    {
      FinishedPiece& piece = this->Finished[number];
      writeCellIds(mesh, number, mesh.Cells, piece);
      mesh.Cells += piece.Summary.Cells;
      this->report(0.9 + 0.02 * double(number) / double(this->Finished.size()));
    }
    this->Statistics.Triangles = mesh.Cells;
  }

  /// By as many threads as there is memory for.
  void linkCells()
  {
    std::uint64_t most = 1;
    for (const FinishedPiece& piece : this->Finished)
    {
      most = std::max(most, NeighborWriter::bytesFor(piece));
    }
    const auto threads = int(
      std::clamp<std::uint64_t>(this->Memory->LoadedBytes / most, 1, std::uint64_t(this->Threads)));
    NeighborWriter neighbors(this->Prepared.Mesh, this->Finished);
    forChunks(
      std::int64_t(this->Finished.size()), 1, threads,
      [this](double done)
      {
        this->report(0.92 + 0.06 * done);
        return true;
      },
      [&](std::int64_t number, std::int64_t, int) { neighbors.add(std::size_t(number)); });
    neighbors.finish();
  }

  void publish()
  {
    PartitionedMesh& mesh = this->Prepared.Mesh;
    this->numberCells();
    if (this->Options.Neighbors)
    {
      this->linkCells();
      this->endPhase("link");
    }
    for (std::size_t number = 0; number < this->Finished.size(); ++number)
    {
      syncToDisk(mesh.piecePath(number));
      this->report(0.98 + 0.02 * double(number) / double(this->Finished.size()));
    }
    const PublishedMesh published = publishPieces(mesh, this->Finished);
    this->Statistics.MeshBytes = published.Bytes;
    this->Fingerprint = published.Fingerprint;
    this->recordWhole();
  }

  /// Takes the plan's place: from now on neither the plan nor anything else in the work folder but
  /// the mesh is needed, and whatever ends the process, another has only to put it in place.
  void recordWhole()
  {
    this->IsWhole = true;
    writeCheckpoint(this->Scratch.plan(),
      [this](SaveArchive& archive)
      {
        archive(this->identity());
        archive(std::uint8_t(this->IsWhole));
        exchangeFigures(archive, this->Statistics);
        archive(this->Fingerprint);
      });
    syncToDisk(this->Scratch.plan());
    syncToDisk(this->Pending.workPath());
  }

  void putInPlace()
  {
    if (this->Options.Progress)
    {
      this->Options.Progress(1); // too late to end it
    }
    if (this->hasMeshToPublish())
    {
      this->Pending.commit();
    }
    this->Prepared.Spilled.reset();
    this->keep(false);
    this->endPhase("publish");
  }

  PointStream& Input;
  Communicator* const Ranks; ///< null: this process alone
  const std::string Path;
  const OutOfCoreOptions& Options;
  const int Threads;
  PendingFolder Pending;
  ScratchFolder Scratch;
  OutOfCoreStatistics Statistics;
  std::unique_ptr<MemoryPlan> Memory;
  PreparedRun Prepared;
  std::vector<FinishedPiece> Finished;
  bool IsWhole = false;          ///< all files of the mesh are there, or all triangles are counted
  bool IsInPlace = false;        ///< where it belongs
  std::uint64_t Fingerprint = 0; ///< of the whole mesh, where there is one
  Stopwatch Watch;
};

} // namespace

OutOfCoreStatistics triangulateOutOfCore(PointStream& points, const std::string& path,
  const OutOfCoreOptions& options, Communicator* ranks)
{
  return Run(points, path, options, ranks && ranks->size() > 1 ? ranks : nullptr).run();
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/OutOfCoreTriangulation.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/TemporaryPaths.h"
#include "Files/TextFile.h"
#include "OutOfCore/DescribeMesh.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/LoadedPiece.h"
#include "OutOfCore/OutOfCoreMessages.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/OutOfCoreRun.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/RunRecord.h"
#include "OutOfCore/RunSetup.h"
#include "OutOfCore/ScratchFiles.h"
#include "OutOfCore/SpilledSegments.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Points/Longitudes.h"
#include "Triangulation/InputSurvey.h"

#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <optional>
#include <random>
#include <stdexcept>

namespace tipp
{

/// The statistics of the whole mesh, without those of this process.
template <typename Archive>
void serialize(Archive& archive, OutOfCoreStatistics& statistics)
{
  archive(statistics.Points, statistics.Triangles, statistics.TriangleSum, statistics.Rejected,
    statistics.WithoutElevation, statistics.Pieces, statistics.Partitions,
    static_cast<PieceFigures&>(statistics), statistics.SpilledBytes, statistics.MeshBytes);
}

namespace
{

std::string firstLine(const std::string& path)
{
  std::string line;
  std::getline(std::ifstream(path), line);
  return line;
}

/// Returns a text that is equal for runs that make the same mesh from the same input with the same
/// options.
std::string identityOf(const PointStream& input, const OutOfCoreOptions& options)
{
  return "TIPP out of core 15\n" + input.identity() + std::to_string(options.Columns) + "x" +
    std::to_string(options.Rows) + " " + std::to_string(options.PiecePoints) + " " +
    std::to_string(options.PartitionPoints) + (options.MapDuplicates ? " mapped" : "") +
    (options.Neighbors ? " linked" : "") + (options.MarkConstraints ? " marked" : "") +
    (options.CountOnly ? " counted" : "") +
    (options.MaximumEdge > 0 ? " edges " + exactText(options.MaximumEdge) : "") +
    (options.Duplicates != DuplicateRule::First
        ? " duplicates " + std::to_string(int(options.Duplicates))
        : "") +
    "\n" + (options.Consumer ? options.Consumer->identity() : "") + "\n" + options.Scratch;
}

class TriangulationRun : OutOfCoreRun<OutOfCoreOptions, OutOfCoreStatistics>
{
public:
  TriangulationRun(PointStream& points, const std::string& path, const OutOfCoreOptions& options,
    Communicator* ranks)
    : OutOfCoreRun(points, path, options, identityOf(points, options), ranks)
    , Setup(options)
  {
    if (!options.CountOnly)
    {
      requireFolderName(path);
    }
    this->Setup.Mesh.Path = options.CountOnly ? "" : this->Pending.temporaryPath();
    this->Setup.Results = this->Scratch.results();
  }

  OutOfCoreStatistics run()
  {
    return this->perform(
      [this]
      {
        if (this->Ranks)
        {
          requireSharedFolder(*this->Ranks, this->Pending.workPath());
          requireSharedFolder(*this->Ranks, this->Scratch.folder());
        }
        if (!this->resume([this](LoadArchive& archive) { this->load(archive); }))
        {
          this->survey();
          this->spill();
        }
        if (!this->Record.isWhole())
        {
          this->Setup.beginTaking();
          this->triangulate();
          this->endTaking();
          this->Options.CountOnly ? this->count() : this->publish();
        }
        this->Setup.Spilled.reset();
        this->putInPlace();
      });
  }

private:
  void load(LoadArchive& archive)
  {
    this->Setup.load(archive, this->Scratch.points());
    this->Memory = std::make_unique<MemoryPlan>(
      this->Options, this->Setup.Rows.Words, this->Setup.Constraints != nullptr);
    this->describePlan();
  }

  void survey()
  {
    this->Record.keep(false);
    this->Scratch.clear();
    this->Setup.describeColumns(this->Input.columns(), this->Options);
    auto* const segments = dynamic_cast<ConstrainedStream*>(&this->Input);
    this->Memory = std::make_unique<MemoryPlan>(
      this->Options, 3 + this->Input.columns().size(), segments != nullptr);
    if (segments)
    {
      segments->begin(this->Scratch.points() + ".constraints", this->Options.MemoryLimit);
    }
    InputSurvey& survey = this->Setup.Survey;
    survey = InputPasses(this->Input, this->Ranks,
      this->passOptions(
        [this](std::int64_t) {
          this->require(this->proceed(0));
        })).survey();
    this->Setup.InputBounds =
      segments ? segments->inputBounds() : scaled(survey.Bounds, 1 / survey.Factor);
    this->Statistics.LeftOut = this->Input.leftOut();
    this->Statistics.ThinnedOut = this->Input.thinnedOut();
    const std::size_t words = this->Setup.Rows.Words;
    requireElevation(this->Options.Duplicates, this->Input.columns());
    if (survey.Points == survey.Rejected)
    {
      throw IOError(
        "The input has no point with finite coordinates, so there is nothing to write.");
    }
    this->requireSpace(0, segments ? SpilledSegments::fileBytes(segments->count()) : 0);
    this->Setup.Plan =
      std::make_unique<PiecePlan>(survey, this->Options, *this->Memory, words, this->Threads);
    if (segments)
    {
      this->Statistics.Constraints = segments->figures();
      this->Setup.setConstraints(this->Scratch.points(), *segments, this->Threads);
    }
    this->warnOfLongitudes(survey);
    std::vector<SampledPoint>().swap(survey.Sample); // assigning {} would keep the memory
    if (this->Setup.Plan->HasLargeInterface)
    {
      // Each piece gets messages with nearly all points of the pieces before it.
      constexpr std::uint64_t sent = 32 / 2;
      constexpr std::uint64_t border = 64;
      this->requireSpace(sent * std::uint64_t(this->Setup.Plan->pieces()) + border, 0);
    }
    this->Setup.describeMesh();
    this->describePlan();
    this->endPhase("survey");
  }

  /// Warns of points on both sides of 180 degrees, judged by the sample.
  void warnOfLongitudes(const InputSurvey& survey) const
  {
    const Box2& bounds = survey.Bounds;
    LongitudeSpan span;
    span.add(bounds.Min.x, bounds.Min.y);
    span.add(bounds.Max.x, bounds.Max.y);
    for (const SampledPoint& sampled : survey.Sample)
    {
      span.add(sampled.Position.x, sampled.Position.y);
    }
    const std::string warning = span.warning();
    if (!warning.empty() && this->Options.Warn)
    {
      this->Options.Warn(warning);
    }
  }

  PassOptions passOptions(const std::function<void(std::int64_t)>& progress) const
  {
    return { this->Memory->BlockPoints, this->Memory->SamplePoints, this->Threads, progress };
  }

  void describePlan()
  {
    this->Statistics.Points = this->Setup.Survey.Points;
    this->Statistics.Rejected = this->Setup.Survey.Rejected;
    this->Statistics.WithoutElevation = this->Setup.Survey.WithoutElevation;
    this->Statistics.Pieces = this->Setup.Plan->pieces();
    this->Statistics.Partitions = this->Setup.Plan->Partitions.size();
  }

  /// `more`: bytes per point in the scratch folder beyond the usual ones; `others`: additional
  /// bytes there.
  void requireSpace(std::uint64_t more, std::uint64_t others) const
  {
    const auto points = std::uint64_t(this->Setup.Survey.Points - this->Setup.Survey.Rejected);
    const std::uint64_t cell =
      12 + 4 + 1 + 8 + (this->Options.Neighbors ? 24 : 0) + (this->Options.MarkConstraints ? 3 : 0);
    // Includes borders and ids of cells. There are at most two triangles per point.
    const std::uint64_t stored =
      points * (24 + 8 + 1 + 8 * this->Setup.Rows.Attributes.size() + 2 * cell) / 50 * 51;
    constexpr std::uint64_t results = 4; // bytes per point for pieces of 30,000 points
    this->Scratch.requireSpace(this->Path, this->Options.CountOnly ? 0 : stored,
      points * (8 * this->Setup.Rows.Words + results + more) + others + this->Setup.takenBytes());
  }

  void spill()
  {
    const InputSurvey& survey = this->Setup.Survey;
    const auto progress = [&](std::int64_t done)
    { this->require(this->proceed(0.2 * double(done) / double(survey.Points))); };
    this->Setup.Spilled = InputPasses(this->Input, this->Ranks, this->passOptions(progress))
                            .spill(survey, *this->Setup.Plan, this->Scratch.points());
    this->Statistics.SpilledBytes = this->Setup.Spilled->bytes();
    this->Setup.requireMemory(this->Path, this->Options.MemoryLimit);
    this->Record.save(
      RunRecord::Stage::Begun, [this](SaveArchive& archive) { this->Setup.save(archive); });
    this->endPhase("spill");
  }

  void triangulate()
  {
    if (this->Setup.Survey.Collinear || this->Setup.Plan->IsAlone)
    {
      const double all = double(this->Setup.Survey.Points);
      this->Finished = triangulateAlone(
        this->Setup.work(), this->Setup.Survey.Collinear,
        [&](std::int64_t done) { return this->proceed(0.2 + 0.7 * double(done) / all); },
        this->Statistics);
      this->require(!this->Finished.empty());
      this->endPhase("triangulate");
      return;
    }
    const PieceWork work = this->Setup.work();
    const std::vector<char> isDone =
      verifyResults(work, this->Threads, this->reportPart(0.2, 0), this->Options.Warn);
    if (this->Ranks)
    {
      this->shareSetup(isDone);
    }
    Communicator alone(nullptr);
    const std::function<bool(double)> progress = [this](double done)
    { return this->proceed(0.2 + 0.65 * done); };
    triangulatePieces(
      work, *this->Memory, this->Threads, progress, this->Ranks ? *this->Ranks : alone, isDone);
    this->Finished =
      finishPieces(work, this->Threads, this->reportPart(0.85, 0.05), this->Statistics);
    this->endPhase("triangulate");
  }

  /// Sends the other ranks, which wait in help(), the data that they need to work on pieces.
  void shareSetup(const std::vector<char>& isDone)
  {
    for (int to = 1; to < this->Ranks->size(); ++to)
    {
      SaveArchive archive;
      archive(this->Scratch.points(), this->Setup.Mesh.Path, this->Setup.Results, isDone);
      this->Setup.save(archive);
      this->Ranks->post(to, SetUpMessage, archive.take());
      this->Ranks->flush(); // send one copy at a time, to save memory
    }
  }

  void endTaking()
  {
    if (this->Options.Consumer)
    {
      this->require(this->Options.Consumer->end(
        [this](double done) { return this->proceed(0.9 + 0.1 * done); }));
      this->endPhase("raster");
    }
  }

  void count()
  {
    for (const FinishedPiece& piece : this->Finished)
    {
      this->Statistics.Triangles += piece.Summary.Cells;
      this->Statistics.TriangleSum += piece.TriangleSum;
    }
    this->Record.save(
      RunRecord::Stage::Counted, [this](SaveArchive& archive) { archive(this->Statistics); });
  }

  void publish()
  {
    PartitionedMesh& mesh = this->Setup.Mesh;
    this->numberAndLink(mesh, this->Memory->LoadedBytes);
    this->Statistics.Triangles = mesh.Cells;
    if (this->Options.MarkConstraints)
    {
      markCells(mesh, this->Finished, this->Setup.Marks, this->Setup.Constraints.get(),
        this->Threads, this->reportPart(0.97, 0.01));
    }
    OutOfCoreRun::publish(mesh);
  }

  std::unique_ptr<MemoryPlan> Memory;
  RunSetup Setup;
};

/// Reports progress on a rank other than the first while there are no pieces to triangulate.
void report(const Communicator& ranks, const OutOfCoreOptions& options, double fraction)
{
  if (options.Progress && !options.Progress(fraction))
  {
    throw RankFailure(ranks.rank(), true, "The run was stopped.");
  }
}

Message waitForOrder(Communicator& ranks, const OutOfCoreOptions& options, double fraction)
{
  constexpr double moment = 0.1;
  Stopwatch sinceReport;
  Message message;
  while (!ranks.poll(message))
  {
    if (sinceReport.seconds() > moment)
    {
      sinceReport.restart();
      report(ranks, options, fraction);
    }
    ranks.pause();
  }
  return message;
}

/// Works on a rank other than the first: helps with the input, and triangulates this rank's pieces.
void help(Communicator& ranks, const OpenPoints& open, const OutOfCoreOptions& options)
{
  requireSharedFolder(ranks, "");
  requireSharedFolder(ranks, "");
  const int threads = threadCount(options.Threads);
  const auto progress = [&](std::int64_t)
  {
    Message none; // no message comes; poll() throws if a rank has failed
    ranks.poll(none);
    report(ranks, options, 0);
  };
  RunSetup setup(options);
  std::vector<char> isDone;
  { // the message, which may be large, is freed before the pieces are triangulated
    const Message message = helpWithInput(
      ranks, open, { 0, 0, threads, progress }, [&] { return waitForOrder(ranks, options, 0); });
    if (message.Kind == EndMessage)
    {
      return; // there are no pieces to triangulate
    }
    std::string points;
    LoadArchive archive(message.Content);
    archive(points, setup.Mesh.Path, setup.Results, isDone);
    setup.load(archive, points);
  }
  setup.beginTaking();
  const MemoryPlan memory(options, setup.Rows.Words, setup.Constraints != nullptr);
  triangulatePieces(setup.work(), memory, threads, options.Progress, ranks, isDone);
  while (waitForOrder(ranks, options, 1).Kind != EndMessage)
  {
    // A result of another rank, which this rank does not need.
  }
}

} // namespace

void requireSharedFolder(Communicator& ranks, const std::string& folder)
{
  const bool isFirst = ranks.rank() == 0;
  std::optional<TemporaryFile> mark;
  std::string path;
  std::string expected;
  if (isFirst)
  {
    path = folder + "/.ranks";
    mark.emplace(path);
    std::random_device random;
    expected = std::to_string(random()) + " " + std::to_string(random());
    std::ofstream(path) << expected << "\n";
    if (firstLine(path) != expected)
    {
      throw IOError(path, "cannot be written.");
    }
  }
  path = ranks.broadcast(path);
  expected = ranks.broadcast(expected);
  if (firstLine(path) != expected)
  {
    throw IOError(std::filesystem::path(path).parent_path().string(),
      "does not exist on this rank, but all ranks use it; name folders that all ranks share.");
  }
  ranks.barrier(); // all ranks have read the file, so it can be removed
}

OutOfCoreStatistics triangulateOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions& options)
{
  return TriangulationRun(points, path, options, nullptr).run();
}

OutOfCoreStatistics triangulateOutOfCoreOnRanks(Communicator& ranks, const OpenPoints& open,
  const std::string& path, const OutOfCoreOptions& options)
{
  OutOfCoreStatistics statistics;
  const auto work = [&]
  {
    if (ranks.rank() > 0)
    {
      help(ranks, open, options);
      return;
    }
    const std::unique_ptr<PointStream> points = open();
    statistics =
      TriangulationRun(*points, path, options, ranks.size() > 1 ? &ranks : nullptr).run();
    if (statistics.Aborted)
    {
      throw RankFailure(0, true, "The run was stopped.");
    }
    for (int to = 1; to < ranks.size(); ++to)
    {
      ranks.post(to, EndMessage, Bytes());
    }
  };
  try
  {
    ranks.together(
      [&]
      {
        try
        {
          work();
        }
        catch (const std::bad_alloc&)
        {
          throw std::runtime_error("There is not enough memory; lower the memory limit.");
        }
      });
  }
  catch (const RankFailure& failure)
  {
    statistics.Aborted = failure.Aborted;
    if (!failure.Aborted)
    {
      throw;
    }
  }
  return statistics;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/OutOfCoreTriangulation.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/LoadedPiece.h"
#include "OutOfCore/OutOfCoreRun.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/RunOnRanks.h"
#include "OutOfCore/RunRecord.h"
#include "OutOfCore/RunSetup.h"
#include "OutOfCore/SpilledSegments.h"
#include "Parallel/ParallelFor.h"
#include "Points/Longitudes.h"
#include "Triangulation/InputSurvey.h"

#include <memory>

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

/// Returns a text that is equal for runs that make the same mesh from the same input with the same
/// options.
std::string identityOf(const PointStream& input, const OutOfCoreOptions& options)
{
  return "TIPP out of core 16\n" + input.identity() + std::to_string(options.Columns) + "x" +
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

class TriangulationRun : OutOfCoreRun<RunSetup, OutOfCoreOptions, OutOfCoreStatistics>
{
public:
  TriangulationRun(PointStream& points, const std::string& path, const OutOfCoreOptions& options,
    Communicator* ranks)
    : OutOfCoreRun(points, path, options, identityOf(points, options), ranks)
  {
    if (!options.CountOnly)
    {
      requireFolderName(path);
    }
    this->Setup.Mesh.Path = options.CountOnly ? "" : this->Pending.temporaryPath();
  }

  OutOfCoreStatistics run()
  {
    return this->perform([this] { this->spillPoints(); },
      [this]
      {
        this->Setup.beginTaking();
        this->triangulate();
        this->endTaking();
        this->Options.CountOnly ? this->count() : this->publish();
      });
  }

private:
  void spillPoints()
  {
    auto* const segments = dynamic_cast<ConstrainedStream*>(&this->Input);
    const std::size_t words = this->Setup.Rows.Words;
    const MemoryPlan memory(this->Options, words, segments != nullptr);
    if (segments)
    {
      segments->begin(this->Scratch.points() + ".constraints", this->Options.MemoryLimit);
    }
    InputSurvey& survey = this->Setup.Survey;
    this->survey(memory);
    this->Setup.InputBounds =
      segments ? segments->inputBounds() : scaled(survey.Bounds, 1 / survey.Factor);
    requireElevation(this->Options.Duplicates, this->Input.columns());
    if (survey.Points == survey.Rejected)
    {
      throw IOError(
        "The input has no point with finite coordinates, so there is nothing to write.");
    }
    this->requireSpace(0, segments ? SpilledSegments::fileBytes(segments->count()) : 0);
    this->Setup.Plan =
      std::make_unique<PiecePlan>(survey, this->Options, memory, words, this->Threads);
    if (segments)
    {
      this->Statistics.Constraints = segments->figures();
      this->Setup.setConstraints(this->Scratch.points(), *segments, this->Threads);
    }
    this->warnOfLongitudes(survey);
    if (this->Setup.Plan->HasLargeInterface)
    {
      // Each piece gets messages with nearly all points of the pieces before it.
      constexpr std::uint64_t sent = 32 / 2;
      constexpr std::uint64_t border = 64;
      this->requireSpace(sent * std::uint64_t(this->Setup.Plan->pieces()) + border, 0);
    }
    this->spill(memory, 0.2);
    this->Setup.requireMemory(this->Path, this->Options.MemoryLimit);
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

  void triangulate()
  {
    const bool isFlat = this->Setup.Survey.dimension() < 2;
    if (isFlat || this->Setup.Plan->IsAlone)
    {
      const double all = double(this->Setup.Survey.Points);
      this->Finished = triangulateAlone(
        this->Setup.work(), isFlat,
        [&](std::int64_t done) { return this->proceed(0.2 + 0.7 * double(done) / all); },
        this->Statistics);
      this->require(!this->Finished.empty());
      this->endPhase("triangulate");
      return;
    }
    this->makePieces(0.2, 0.65);
    this->Finished = finishPieces(
      this->Setup.work(), this->Threads, this->reportPart(0.85, 0.05), this->Statistics);
    this->endPhase("triangulate");
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
    this->numberAndLink(mesh, this->Setup.memory(this->Options).LoadedBytes);
    this->Statistics.Triangles = mesh.Cells;
    if (this->Options.MarkConstraints)
    {
      markCells(mesh, this->Finished, this->Setup.Marks, this->Setup.Constraints.get(),
        this->Threads, this->reportPart(0.97, 0.01));
    }
    OutOfCoreRun::publish(mesh);
  }
};

} // namespace

OutOfCoreStatistics triangulateOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions& options)
{
  return TriangulationRun(points, path, options, nullptr).run();
}

OutOfCoreStatistics triangulateOutOfCoreOnRanks(Communicator& ranks, const OpenPoints& open,
  const std::string& path, const OutOfCoreOptions& options)
{
  return runWithHelp<TriangulationRun, RunSetup>(ranks, open, path, options);
}

} // namespace tipp

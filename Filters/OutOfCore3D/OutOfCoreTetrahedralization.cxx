// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore3D/OutOfCoreTetrahedralization.h"

#include "OutOfCore/DescribeMesh.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/OutOfCoreRun.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/RunRecord.h"
#include "OutOfCore3D/PieceRun3.h"

#include <memory>

namespace tipp
{

/// The statistics of the whole mesh, without those of this process.
template <typename Archive>
void serialize(Archive& archive, OutOfCoreStatistics3& statistics)
{
  archive(statistics.Points, statistics.Tetrahedra, statistics.Rejected, statistics.LeftOut,
    statistics.ThinnedOut, statistics.Pieces, static_cast<PieceFigures&>(statistics),
    statistics.SpilledBytes, statistics.MeshBytes);
}

namespace
{

/// Returns a text that is equal for runs that make the same mesh from the same input with the same
/// options.
std::string identityOf(const PointStream& input, const OutOfCoreOptions3& options)
{
  std::string text = "TIPP out of core in space 3\n" + input.identity();
  for (const std::string& column : input.columns())
  {
    text += column + "\n";
  }
  return text + std::to_string(options.PiecePoints) + (options.MapDuplicates ? " mapped" : "") +
    (options.Neighbors ? " linked" : "") + "\n" + options.Scratch;
}

class TetrahedralizationRun : OutOfCoreRun<OutOfCoreOptions3, OutOfCoreStatistics3>
{
public:
  TetrahedralizationRun(
    PointStream& points, const std::string& path, const OutOfCoreOptions3& options)
    : OutOfCoreRun(points, path, options, identityOf(points, options))
    , Memory(options.MemoryLimit, options.PiecePoints, 3 + points.columns().size())
  {
    requireFolderName(path);
  }

  OutOfCoreStatistics3 run()
  {
    return this->perform(
      [this]
      {
        if (!this->resume([this](LoadArchive& archive) { this->load(archive); }))
        {
          this->prepare();
        }
        if (!this->Record.isWhole())
        {
          this->triangulate();
          this->publish();
        }
        this->putInPlace();
      });
  }

private:
  void load(LoadArchive& archive)
  {
    this->Plan = std::make_unique<PiecePlan3>(
      archive, 3 + this->Input.columns().size(), this->Scratch.points());
    this->describeColumns();
    this->describePlan();
  }

  void prepare()
  {
    this->Record.keep(false);
    this->Scratch.clear();
    this->Plan = std::make_unique<PiecePlan3>(
      this->Input, this->Memory, [this](std::int64_t) { this->report(0); });
    this->describeColumns();
    this->requireSpace();
    this->Plan->divide(this->Memory, this->Rows.Words);
    this->endPhase("survey");
    const double all = double(this->Plan->survey().Points);
    this->Plan->spill(this->Input, this->Scratch.points(), this->Memory, this->Threads,
      [&](std::int64_t done) { this->report(0.1 * double(done) / all); });
    this->Record.save(
      RunRecord::Stage::Begun, [this](SaveArchive& archive) { this->Plan->save(archive); });
    this->describePlan();
    this->endPhase("spill");
  }

  /// Sets the statistics that are known once the points are spilled.
  void describePlan()
  {
    const InputSurvey3& survey = this->Plan->survey();
    this->Statistics.Points = survey.Points;
    this->Statistics.Rejected = survey.Rejected;
    this->Statistics.LeftOut = survey.LeftOut;
    this->Statistics.ThinnedOut = survey.ThinnedOut;
    this->Statistics.Pieces = this->Plan->pieces();
    this->Statistics.SpilledBytes = this->Plan->points().bytes();
    describePieces(*this->Plan, survey, this->Mesh);
  }

  void describeColumns()
  {
    this->Mesh.Path = this->Pending.temporaryPath();
    this->Mesh.CellSize = 4;
    tipp::describeColumns(
      this->Input.columns(), this->Plan->survey().Elevation, this->Options, this->Rows, this->Mesh);
  }

  void requireSpace() const
  {
    const auto points = std::uint64_t(this->Plan->survey().finite());
    // Uniform points give 6.77 tetrahedra per point.
    const std::uint64_t cells = 7 * (16 + 4 + 1 + 8 + (this->Options.Neighbors ? 32 : 0));
    // Bytes per point of results, for pieces of 250,000 points.
    constexpr std::uint64_t results = 100;
    this->Scratch.requireSpace(this->Path,
      points * (24 + 8 + 1 + 8 * this->Rows.Attributes.size() + cells),
      points * (8 * this->Rows.Words + results));
  }

  void triangulate()
  {
    const PieceWork3 work{ *this->Plan, this->Plan->points(), this->Rows, this->Mesh,
      this->Scratch.results() };
    const double all = double(this->Plan->survey().finite());
    const std::vector<char> isDone =
      verifyResults(work, this->Threads, this->reportPart(0.1, 0), this->Options.Warn);
    this->require(triangulatePieces(
      work, this->Memory, this->Threads,
      [&](std::int64_t done) { return this->proceed(0.1 + 0.75 * double(done) / all); }, isDone));
    this->endPhase("triangulate");
    this->Finished = finishPieces(
      work, this->Memory.PieceBytes, this->Threads, this->reportPart(0.85, 0.05), this->Statistics);
    this->endPhase("borders");
  }

  void publish()
  {
    this->numberAndLink(this->Mesh, this->Memory.PieceBytes);
    this->Statistics.Tetrahedra = this->Mesh.Cells;
    OutOfCoreRun::publish(this->Mesh);
  }

  const MemoryPlan3 Memory;
  std::unique_ptr<PiecePlan3> Plan;
  PointRowLayout Rows;
  PartitionedMesh Mesh;
};

} // namespace

OutOfCoreStatistics3 tetrahedralizeOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions3& options)
{
  return TetrahedralizationRun(points, path, options).run();
}

} // namespace tipp

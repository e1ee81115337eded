// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/OutOfCoreTetrahedralization.h"

#include "Files/IOError.h"
#include "OutOfCore/OutOfCoreRun.h"
#include "OutOfCore/PieceRun.h"
#include "OutOfCore/RunOnRanks.h"
#include "OutOfCore/RunSetup.h"

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

/// What RunSetup is in the plane.
class RunSetup3 : public RunSetupOf<PiecePlan3>
{
public:
  explicit RunSetup3(const OutOfCoreRunOptions& /*options*/ = {}) { this->Mesh.CellSize = 4; }

  /// See RunSetup. Throws IOError also if there is no column with the third coordinate.
  void describeColumns(const std::vector<std::string>& columns, const OutOfCoreRunOptions& options)
  {
    const std::size_t elevation = findElevation(columns);
    if (elevation == columns.size())
    {
      throw IOError("The input has no column z, Z or elevation, the third coordinate.");
    }
    tipp::describeColumns(columns, elevation, options, this->Rows, this->Mesh);
  }

  void save(SaveArchive& archive)
  {
    archive(this->Survey, this->Rows, this->Mesh.Arrays);
    this->Plan->save(archive);
    this->Spilled->save(archive);
  }
  void load(LoadArchive& archive, const std::string& points)
  {
    archive(this->Survey, this->Rows, this->Mesh.Arrays);
    this->Plan = std::make_unique<PiecePlan3>(archive);
    this->loadPoints(archive, points);
  }

  void beginTaking() const {} // tetrahedra are always written to a mesh

  MemoryPlan3 memory(const OutOfCoreRunOptions& options) const
  {
    return { options.MemoryLimit, options.PiecePoints, std::size_t(this->Rows.Words) };
  }

  PieceWork3 work() const
  {
    return { *this->Plan, *this->Spilled, this->Rows, this->Mesh, this->Results,
      this->Survey.Factor };
  }
};

/// Returns a text that is equal for runs that make the same mesh from the same input with the same
/// options.
std::string identityInSpace(const PointStream& input, const OutOfCoreOptions3& options)
{
  std::string text = "TIPP out of core in space 4\n" + input.identity();
  for (const std::string& column : input.columns())
  {
    text += column + "\n";
  }
  return text + std::to_string(options.PiecePoints) + (options.MapDuplicates ? " mapped" : "") +
    (options.Neighbors ? " linked" : "") + "\n" + options.Scratch;
}

class TetrahedralizationRun : OutOfCoreRun<RunSetup3, OutOfCoreOptions3, OutOfCoreStatistics3>
{
public:
  TetrahedralizationRun(PointStream& points, const std::string& path,
    const OutOfCoreOptions3& options, Communicator* ranks)
    : OutOfCoreRun(points, path, options, identityInSpace(points, options), ranks)
  {
    requireFolderName(path);
    this->Setup.Mesh.Path = this->Pending.temporaryPath();
  }

  OutOfCoreStatistics3 run()
  {
    return this->perform([this] { this->spillPoints(); }, [this] { this->makeMesh(); });
  }

private:
  void spillPoints()
  {
    const MemoryPlan3 memory = this->Setup.memory(this->Options);
    this->survey(memory);
    this->requireSpace();
    this->Setup.Plan =
      std::make_unique<PiecePlan3>(this->Setup.Survey, memory, this->Setup.Rows.Words);
    this->spill(memory, 0.1);
  }

  void requireSpace() const
  {
    const auto points = std::uint64_t(this->Setup.Survey.finite());
    // Uniform points give 6.77 tetrahedra per point.
    const std::uint64_t cells = 7 * (16 + 4 + 1 + 8 + (this->Options.Neighbors ? 32 : 0));
    // Bytes per point of results, for pieces of 250,000 points.
    constexpr std::uint64_t results = 100;
    this->Scratch.requireSpace(this->Path,
      points * (24 + 8 + 1 + 8 * this->Setup.Rows.Attributes.size() + cells),
      points * (8 * this->Setup.Rows.Words + results));
  }

  void makeMesh()
  {
    this->makePieces(0.1, 0.75);
    this->endPhase("triangulate");
    const std::uint64_t memory = this->Setup.memory(this->Options).PieceBytes;
    this->Finished = finishPieces(
      this->Setup.work(), memory, this->Threads, this->reportPart(0.85, 0.05), this->Statistics);
    this->endPhase("borders");
    this->numberAndLink(this->Setup.Mesh, memory);
    this->Statistics.Tetrahedra = this->Setup.Mesh.Cells;
    this->publish(this->Setup.Mesh);
  }
};

} // namespace

OutOfCoreStatistics3 tetrahedralizeOutOfCore(
  PointStream& points, const std::string& path, const OutOfCoreOptions3& options)
{
  return TetrahedralizationRun(points, path, options, nullptr).run();
}

OutOfCoreStatistics3 tetrahedralizeOutOfCoreOnRanks(Communicator& ranks, const OpenPoints& open,
  const std::string& path, const OutOfCoreOptions3& options)
{
  return runWithHelp<TetrahedralizationRun, RunSetup3>(ranks, open, path, options);
}

} // namespace tipp

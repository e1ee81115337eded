// SPDX-License-Identifier: BSD-3-Clause
#include "Statistics/RunStatistics.h"

#include "Parallel/Threads.h"

#include <cstdio>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

/// Returns a function that returns a column: the values of one member of all items. Integers are
/// widened to 64 bits.
template <typename Item>
auto columnsOf(const std::vector<Item>& items)
{
  return [&items](const char* key, const char* array, auto Item::*member) -> Figures
  {
    using Value = std::decay_t<decltype(std::declval<Item>().*member)>;
    std::vector<std::conditional_t<std::is_integral_v<Value>, std::int64_t, Value>> values;
    values.reserve(items.size());
    for (const Item& item : items)
    {
      values.push_back(item.*member);
    }
    return { key, array, std::move(values) };
  };
}

template <typename Phase>
FigureList phasesOf(
  const std::vector<Phase>& phases, bool isTable, const char* name, const char* seconds)
{
  const auto column = columnsOf(phases);
  return { "phases", isTable,
    { column("name", name, &Phase::Name), column("seconds", seconds, &Phase::Seconds) } };
}

/// `key` and `array` are the names under which the number of triangles or tetrahedra is stored.
FigureList ranksOf(const std::vector<RankStatistics>& ranks, const char* key, const char* array)
{
  using Rank = RankStatistics;
  const auto column = columnsOf(ranks);
  return { "ranks", false,
    { column("input_points", "", &Rank::InputPoints),
      column("owned_points", "RankOwnedPoints", &Rank::OwnedPoints),
      column(key, array, &Rank::Triangles), column("partitions", "", &Rank::Partitions),
      column("worker_vertices", "", &Rank::WorkerVertices),
      column("exchange_seconds", "", &Rank::ExchangeSeconds),
      column("compute_seconds", "RankComputeSeconds", &Rank::ComputeSeconds),
      column("wait_seconds", "RankWaitSeconds", &Rank::WaitSeconds),
      column("send_seconds", "RankSendSeconds", &Rank::SendSeconds),
      column("master_seconds", "RankMasterSeconds", &Rank::MasterSeconds),
      column("sub_master_seconds", "RankSubMasterSeconds", &Rank::SubMasterSeconds),
      column("collect_seconds", "", &Rank::CollectSeconds),
      column("total_seconds", "", &Rank::TotalSeconds) } };
}

FigureList mastersOf(const std::vector<MasterStatistics>& masters)
{
  using Master = MasterStatistics;
  const auto column = columnsOf(masters);
  return { "masters", false,
    { column("area", "", &Master::Area), column("rank", "", &Master::Rank),
      column("group_size", "", &Master::GroupSize),
      column("largest_mesh", "", &Master::LargestMesh), column("seconds", "", &Master::Seconds),
      column("path_seconds", "", &Master::PathSeconds) } };
}

FigureList trafficOf(const std::vector<TrafficStatistics>& traffic)
{
  using Traffic = TrafficStatistics;
  const auto column = columnsOf(traffic);
  return { "traffic", false,
    { column("kind", "MessageKind", &Traffic::Kind),
      column("messages", "MessageCount", &Traffic::Messages),
      column("bytes", "MessageBytes", &Traffic::Bytes) } };
}

std::string hexadecimal(std::uint64_t value)
{
  char text[17];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(value));
  return text;
}

/// Returns statistics with the counts of points and cells. `key` and `array` are the names under
/// which the number of cells is stored.
RunStatistics countsOf(std::int64_t points, const char* key, const char* array, std::int64_t cells,
  std::int64_t duplicates, std::int64_t rejected)
{
  RunStatistics run;
  run.add("points", "Points", points);
  run.add(key, array, cells);
  run.add("duplicates", "DuplicatePoints", duplicates);
  run.add("rejected", "RejectedPoints", rejected);
  return run;
}

/// Adds the number of threads, and that of a run for which none is requested. `key` is the name of
/// the first.
void addThreads(RunStatistics& run, const char* key, int threads)
{
  const ProcessorCount usual = defaultThreads();
  run.add(key, "Threads", threads);
  run.add("default_threads", "DefaultThreads", usual.Count);
  run.add("default_threads_from", "DefaultThreadsFrom", std::string(usual.From));
}

/// Returns the statistics of a run in memory.
template <typename Mesh>
RunStatistics inMemory(
  const Mesh& mesh, std::int64_t points, const char* key, const char* array, std::int64_t cells)
{
  const TriangulationStatistics& statistics = mesh.Statistics;
  RunStatistics run = countsOf(points, key, array, cells, std::int64_t(mesh.Duplicates.size()),
    std::int64_t(mesh.Rejected.size()));
  addThreads(run, "threads", statistics.Threads);
  run.add("partitions", "Partitions", statistics.Partitions);
  run.add("initial_points", "InitialPoints", statistics.InitialPoints);
  run.add("worker_vertices", "WorkerVertices", statistics.WorkerVertices);
  run.Lists = { phasesOf(statistics.Phases, false, "PhaseName", "PhaseSeconds") };
  return run;
}

/// Returns the totals of a run on several ranks.
template <typename Mesh>
RunStatistics onRanks(const Mesh& mine, const char* key, const char* array, std::int64_t cells)
{
  RunStatistics run =
    countsOf(mine.AllPoints, key, array, cells, mine.AllDuplicates, mine.AllRejected);
  run.add("seconds", "", mine.Statistics.Seconds);
  addThreads(run, "threads_per_rank", mine.Statistics.ThreadsPerRank);
  run.add("partitions", "Partitions", mine.Statistics.Partitions);
  return run;
}

/// Adds, for a run out of core, the statistics that follow the number of pieces.
void addOutOfCore(const OutOfCoreRunStatistics& statistics, RunStatistics& run)
{
  run.add("worker_vertices", "WorkerVertices", statistics.WorkerVertices);
  run.add("boundary_bytes", "BoundaryBytes", std::int64_t(statistics.BoundaryBytes));
  run.add("spilled_bytes", "SpilledBytes", std::int64_t(statistics.SpilledBytes));
  run.add("mesh_bytes", "MeshBytes", std::int64_t(statistics.MeshBytes));
  run.add("resumed", "Resumed", statistics.Resumed);
  addThreads(run, "threads", statistics.Threads);
  run.Lists = { phasesOf(statistics.Phases, true, "Phase", "Seconds") };
}

/// Returns a warning about rejected points, if there are any.
std::vector<std::string> warnOfRejected(
  std::int64_t rejected, std::int64_t points, const std::string& consequence)
{
  return rejected == 0
    ? std::vector<std::string>()
    : std::vector<std::string>{ std::to_string(rejected) + " of " + std::to_string(points) +
        " points have a NaN or infinite coordinate and are " + consequence + "." };
}

/// Returns the warnings about rejected points of a mesh in memory.
std::vector<std::string> warnOfRejected(
  const TriangulatedPoints& mesh, std::int64_t points, const std::string& consequence)
{
  return mesh.Rejected.empty()
    ? std::vector<std::string>()
    : warnOfRejected(std::int64_t(mesh.Rejected.size()), points,
        consequence + "; the first is point " + std::to_string(mesh.Rejected.front()));
}

/// Adds a warning if points have no tetrahedra because of their dimension.
std::vector<std::string> withDimension(std::vector<std::string> warnings, int dimension)
{
  if (dimension < 3)
  {
    warnings.push_back(describeDimension(dimension));
  }
  return warnings;
}

} // namespace

FigureList stagesOf(const std::vector<TriangulationStatistics::Stage>& stages)
{
  using Stage = TriangulationStatistics::Stage;
  std::vector<std::int64_t> numbers(stages.size());
  std::iota(numbers.begin(), numbers.end(), std::int64_t(0));
  const auto column = columnsOf(stages);
  return { "stages", true,
    { { "", "Stage", std::move(numbers) },
      column("active_partitions", "ActivePartitions", &Stage::ActivePartitions),
      column("mesh_triangles", "MeshTriangles", &Stage::MeshTriangles) } };
}

RunStatistics statisticsOf(
  const Triangulation& triangulation, std::int64_t points, std::int64_t triangles)
{
  RunStatistics run = inMemory(triangulation, points, "triangles", "Triangles", triangles);
  run.Lists.push_back(stagesOf(triangulation.Statistics.Stages));
  return run;
}

RunStatistics statisticsOf(
  const Tetrahedralization& mesh, std::int64_t points, std::int64_t tetrahedra)
{
  return inMemory(mesh, points, "tetrahedra", "Tetrahedra", tetrahedra);
}

RunStatistics statisticsOf(const OutOfCoreStatistics& statistics, bool isCounted)
{
  RunStatistics run;
  run.add("points", "Points", statistics.Points);
  run.add("triangles", "Triangles", statistics.Triangles);
  run.add("triangle_sum", "", hexadecimal(statistics.TriangleSum));
  if (isCounted)
  {
    run.add("", "TriangleSum", statistics.TriangleSum);
  }
  run.add("duplicates", "DuplicatePoints", statistics.Duplicates);
  run.add("disagreeing_places", "", statistics.DisagreeingPositions);
  run.add("rejected", "RejectedPoints", statistics.Rejected);
  run.add("pieces", "Pieces", statistics.Pieces);
  run.add("partitions", "Partitions", statistics.Partitions);
  addOutOfCore(statistics, run);
  if (statistics.Constraints.Constraints > 0)
  {
    addConstraintTotals(statistics.Constraints, run);
  }
  return run;
}

RunStatistics statisticsOf(const OutOfCoreStatistics3& statistics)
{
  RunStatistics run = countsOf(statistics.Points, "tetrahedra", "Tetrahedra", statistics.Tetrahedra,
    statistics.Duplicates, statistics.Rejected);
  run.add("pieces", "Pieces", statistics.Pieces);
  addOutOfCore(statistics, run);
  return run;
}

RunStatistics statisticsOf(const DistributedTriangulation& mine)
{
  const DistributedStatistics& statistics = mine.Statistics;
  // The table only has the figures of the first rank's master, which serves the whole domain.
  const bool hasMaster = !statistics.Masters.empty() && statistics.Masters.front().Area == 0;
  const MasterStatistics master = hasMaster ? statistics.Masters.front() : MasterStatistics();
  RunStatistics run = onRanks(mine, "triangles", "Triangles", mine.AllCells);
  run.add("major_partitions", "MajorPartitions", statistics.MajorPartitions);
  run.add("", "LargestMasterMesh", master.LargestMesh);
  run.add("", "MasterSeconds", master.Seconds);
  FigureList stages = stagesOf(master.Stages);
  stages.Key.clear(); // in JSON each master has its own stages
  run.Lists = { ranksOf(statistics.Ranks, "triangles", "RankTriangles"),
    mastersOf(statistics.Masters), trafficOf(statistics.Traffic), std::move(stages) };
  return run;
}

RunStatistics statisticsOf(const DistributedTetrahedralization& mine)
{
  const DistributedStatistics& statistics = mine.Statistics;
  const std::int64_t tetrahedra = mine.cellSize() == 4 ? mine.AllCells : 0;
  RunStatistics run = onRanks(mine, "tetrahedra", "Tetrahedra", tetrahedra);
  run.Lists = { ranksOf(statistics.Ranks, "tetrahedra", "RankTetrahedra"),
    trafficOf(statistics.Traffic) };
  return run;
}

void addConstraintTotals(const ConstraintFigures& figures, RunStatistics& statistics)
{
  figures.visit([&statistics](const char* key, const char* array, std::int64_t value)
    { statistics.add(key, array, value); });
}

namespace
{

/// Explains that there are no triangles; `distinct`: the number of finite and distinct points.
std::string describeNoTriangles(std::int64_t points, std::int64_t distinct, bool longEdgesLeftOut)
{
  return "No triangles: of " + std::to_string(points) + " points, " + std::to_string(distinct) +
    " are finite and distinct" +
    (distinct < 3          ? ", but a triangle needs three."
        : longEdgesLeftOut ? ", and all triangles have edges that are too long, or all points are "
                             "on one line."
                           : ", and all are on one line.");
}

} // namespace

std::vector<std::string> warningsOf(
  const Triangulation& triangulation, std::int64_t points, bool longEdgesLeftOut)
{
  const auto rejected = std::int64_t(triangulation.Rejected.size());
  std::vector<std::string> warnings = warnOfRejected(triangulation, points, "in no triangle");
  if (triangulation.triangleCount() == 0)
  {
    const std::int64_t distinct = points - std::int64_t(triangulation.Duplicates.size()) - rejected;
    warnings.push_back(describeNoTriangles(points, distinct, longEdgesLeftOut));
  }
  return warnings;
}

std::vector<std::string> warningsOf(const OutOfCoreStatistics& statistics)
{
  std::vector<std::string> warnings =
    warnOfRejected(statistics.Rejected, statistics.Points, "left out");
  if (statistics.Triangles == 0)
  {
    warnings.emplace_back(
      "No triangles: there are fewer than three distinct points, or all are on one line.");
  }
  return warnings;
}

std::vector<std::string> warningsOf(const OutOfCoreStatistics3& statistics)
{
  return warnOfRejected(statistics.Rejected, statistics.Points, "left out");
}

std::vector<std::string> warningsOf(const DistributedTriangulation& mine, bool longEdgesLeftOut)
{
  std::vector<std::string> warnings =
    warnOfRejected(mine.AllRejected, mine.AllPoints, "in no triangle");
  if (mine.AllCells == 0)
  {
    const std::int64_t distinct = mine.AllPoints - mine.AllDuplicates - mine.AllRejected;
    warnings.push_back(describeNoTriangles(mine.AllPoints, distinct, longEdgesLeftOut));
  }
  return warnings;
}

std::vector<std::string> warningsOf(const Tetrahedralization& mesh, std::int64_t points)
{
  return withDimension(warnOfRejected(mesh, points, "in no tetrahedron"), mesh.Dimension);
}

std::vector<std::string> warningsOf(const DistributedTetrahedralization& mine)
{
  return withDimension(
    warnOfRejected(mine.AllRejected, mine.AllPoints, "in no tetrahedron"), mine.Dimension);
}

} // namespace tipp

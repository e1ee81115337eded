// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/Tetrahedralize.h"

#include "Engine/PartitionSchedule.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Predicates/ExactPredicates3.h"
#include "Triangulation3D/Dataflow3.h"
#include "Triangulation3D/OrderCells.h"

#include <algorithm>
#include <array>
#include <limits>
#include <mutex>
#include <stdexcept>

namespace tipp
{
namespace
{

/// One partition whose mesh all threads share is fastest. There are several partitions if the
/// points exceed the indices of one mesh, or if there are many threads: each thread of a shared
/// mesh needs a table of all vertices.
int partitionsInSpace(std::size_t points, int threads)
{
  constexpr std::size_t largest = std::size_t(1) << 25;
  constexpr int mostSharing = 16;
  constexpr std::size_t smallest = 8192;
  constexpr std::size_t best = 65536;
  constexpr std::size_t perThread = 12;
  constexpr std::size_t most = 512;
  if (points < largest && (threads <= mostSharing || points < 4 * smallest))
  {
    return 1;
  }
  if (threads == 1)
  {
    return int(std::min(most, 1 + points / largest));
  }
  return int(std::min(
    most, std::max(points / best, std::min(points / smallest, perThread * std::size_t(threads)))));
}

/// Stores final tetrahedra in memory, by the points' ids.
struct FinalCells : public FinalCellConsumer3
{
  std::vector<CellIds> Cells;
  /// True corners of tetrahedra that have artificial corners; may contain a vertex several times.
  std::vector<Vertex3> HullVertices;

  void addInside(const std::array<std::int64_t, 4>& ids) override
  {
    this->Cells.push_back(
      { std::int32_t(ids[0]), std::int32_t(ids[1]), std::int32_t(ids[2]), std::int32_t(ids[3]) });
  }

  void add(const std::array<Vertex3, 4>& corners) override
  {
    if (!takeHullVertices(corners, this->HullVertices))
    {
      this->addInside(idsOf(corners));
    }
  }
};

class Tetrahedralizer
{
public:
  Tetrahedralizer(
    const PointsView3& points, const TetrahedralizationOptions& options, Tetrahedralization& result)
    : Points(points)
    , Options(options)
    , Result(result)
    , Threads(threadCount(options.Threads))
  {
    result.Statistics.Threads = this->Threads;
  }

  void run()
  {
    PointSurveyOf<3> survey = surveyPoints(this->Points, this->Threads);
    this->Result.Rejected = std::move(survey.Rejected);
    this->Points = withModerateMagnitude(this->Points, survey.Bounds);
    this->endPhase("survey");
    const int partitions = this->Options.Partitions > 0
      ? this->Options.Partitions
      : partitionsInSpace(this->Points.size(), this->Threads);
    const bool done = partitions > 1 && this->runPartitioned(partitions);
    if (!done)
    {
      this->runAlone();
    }
    if (!this->Result.Aborted)
    {
      this->finish();
    }
  }

private:
  bool report(double fraction)
  {
    return !this->Options.Progress || this->Options.Progress(fraction);
  }

  void endPhase(const char* name)
  {
    this->Result.Statistics.Phases.push_back({ name, this->Watch.restart() });
  }

  /// Triangulates all points at once.
  void runAlone()
  {
    this->Result.Statistics.Partitions = 1;
    PointBuckets3 copy;
    const bool areReady = this->Points.factor() == 1 && this->Result.Rejected.empty();
    if (!areReady)
    {
      copy = bucketPoints(this->Points, Tiling3({}, 1), this->Threads);
    }
    const std::size_t count = areReady ? this->Points.size() : copy.Points.size();
    const auto idOf = [&](std::uint32_t index)
    { return areReady ? static_cast<std::int32_t>(index) : copy.Ids[index]; };
    DelaunayKernel3 kernel;
    this->Result.Aborted = !kernel.triangulate(
      areReady ? this->Points.contiguous() : copy.Points.data(), count,
      [&](std::size_t inserted) { return this->report(double(inserted) / double(count)); },
      this->Threads);
    this->Result.Dimension = kernel.dimension();
    this->Result.Statistics.WorkerVertices = std::int64_t(count);
    for (const DelaunayKernel3::Duplicate& duplicate : kernel.duplicates())
    {
      this->Result.Duplicates.push_back(
        { idOf(duplicate.Point), idOf(kernel.pointIndex(duplicate.Vertex)) });
    }
    // Several parts for each thread: one that shares its processor with other programs does fewer.
    // Small parts would cost more for their memory.
    constexpr std::size_t pointsPerPart = 1 << 16;
    const auto threads = std::size_t(this->Threads);
    const std::size_t parts =
      threads > 1 ? std::clamp(count / pointsPerPart, threads, 8 * threads) : 1;
    this->Cells.resize(parts);
    parallelFor(std::int64_t(parts), this->Threads,
      [&](std::int64_t index)
      {
        const auto part = std::size_t(index);
        std::vector<CellIds>& made = this->Cells[part];
        made.reserve(kernel.numberEnd() / parts + 1); // a few too many: free and infinite ones
        kernel.forEach(part, parts,
          [&](DelaunayKernel3::Index t)
          {
            if (!kernel.isInfinite(t))
            {
              const auto [a, b, c, d] = kernel.corners(t);
              made.push_back({ idOf(kernel.pointIndex(a)), idOf(kernel.pointIndex(b)),
                idOf(kernel.pointIndex(c)), idOf(kernel.pointIndex(d)) });
            }
          });
      });
    this->endPhase("triangulation");
  }

  /// Returns false if partitions do not pay, or cannot be made.
  bool runPartitioned(int partitions)
  {
    constexpr std::size_t samplesPerPartition = 256;
    const std::size_t step = std::max<std::size_t>(
      1, this->Points.size() / (samplesPerPartition * std::size_t(partitions)));
    const Tiling3 tiling(sampleEvery(this->Points, double(step)), partitions);
    const PointBuckets3 buckets = bucketPoints(this->Points, tiling, this->Threads);
    this->endPhase("bucketing");
    const std::vector<Vertex3> artificial = makeArtificialPoints(buckets);
    if (tiling.size() == 1 || artificial.empty())
    {
      return false;
    }
    const BoundaryCells<3> initial = makeInitialMesh(tiling, buckets, artificial);
    if (this->Options.Partitions == 0 && !partitionsPay(initial))
    {
      return false;
    }
    this->Result.Statistics.Partitions = tiling.size();
    this->Result.Statistics.InitialPoints =
      std::int64_t(initial.Vertices.size() - artificial.size());
    const PartitionOrder order(buckets.areUsed(), initial);
    std::vector<Inbox3> inboxes(order.partitionCount());
    FinalCells boundary;
    for (auto& [to, message] : sendInitialMesh(initial, order))
    {
      inboxes[std::size_t(to)].put(std::move(message));
    }
    this->endPhase("initial mesh");
    this->work(buckets, order, inboxes, boundary);
    if (!this->Result.Aborted)
    {
      repairHull(std::move(boundary.HullVertices), artificial, boundary);
      this->Cells.push_back(std::move(boundary.Cells));
      this->endPhase("hull");
      const bool hasCells = std::any_of(this->Cells.begin(), this->Cells.end(),
        [](const std::vector<CellIds>& cells) { return !cells.empty(); });
      if (!hasCells)
      {
        // The points are coplanar, or too few: runAlone() reports the dimension.
        this->Cells.clear();
        this->Result.Duplicates.clear();
        return false;
      }
      this->Result.Dimension = 3;
    }
    return true;
  }

  void work(const PointBuckets3& buckets, const PartitionOrder& order, std::vector<Inbox3>& inboxes,
    FinalCells& boundary)
  {
    ReadyPartitions ready(order, ReadyPartitions::Waits::ForEarlier);
    std::vector<FinalCells> made(std::size_t(this->Threads));
    std::mutex mutex;
    std::size_t pointsDone = 0;
    runWorkers(ready, this->Threads,
      [&](int thread)
      {
        FinalCells& mine = made[std::size_t(thread)];
        Worker3 worker(buckets.Regions, order);
        for (PartitionIndex p = ready.take(); p != NoPartition; p = ready.take())
        {
          SentMessages3 sent =
            worker.triangulate(buckets.of(p), inboxes[std::size_t(p)].take(), mine);
          for (auto& [to, message] : sent)
          {
            inboxes[std::size_t(to)].put(std::move(message));
          }
          ready.finish(p);
          const std::lock_guard<std::mutex> lock(mutex);
          pointsDone += buckets.count(p);
          if (!this->report(double(pointsDone) / double(buckets.Points.size())))
          {
            ready.stop();
          }
        }
        const std::lock_guard<std::mutex> lock(mutex);
        this->Result.Statistics.WorkerVertices += std::int64_t(worker.vertexCount());
        this->Result.Duplicates.insert(
          this->Result.Duplicates.end(), worker.duplicates().begin(), worker.duplicates().end());
      });
    this->Result.Aborted = ready.isStopped();
    for (FinalCells& part : made)
    {
      this->Cells.push_back(std::move(part.Cells));
      boundary.HullVertices.insert(
        boundary.HullVertices.end(), part.HullVertices.begin(), part.HullVertices.end());
    }
    this->endPhase("workers");
  }

  /// Tetrahedra with vertices from other partitions may have ids of duplicates: replaces these by
  /// their representatives.
  void useRepresentatives()
  {
    if (this->Result.Duplicates.empty())
    {
      return;
    }
    const Buffer<std::int64_t> representatives =
      representativeIds(this->Result, std::int64_t(this->Points.size()));
    for (std::vector<CellIds>& cells : this->Cells)
    {
      for (CellIds& cell : cells)
      {
        for (std::int32_t& id : cell)
        {
          id = std::int32_t(representatives[std::size_t(id)]);
        }
      }
    }
  }

  void finish()
  {
    std::sort(this->Result.Duplicates.begin(), this->Result.Duplicates.end());
    this->useRepresentatives();
    this->Result.Ids = orderCells(std::move(this->Cells), this->Points.size(), this->Threads);
    this->endPhase("output");
    this->report(1);
  }

  PointsView3 Points;
  const TetrahedralizationOptions& Options;
  Tetrahedralization& Result;
  const int Threads;
  std::vector<std::vector<CellIds>> Cells;
  Stopwatch Watch;
};

/// Returns three of the points that are not collinear. Throws std::logic_error if there are none.
std::array<Point3, 3> findTriangle(const Point3* points, const std::vector<char>& isLeftOut)
{
  std::array<Point3, 3> found = {};
  std::size_t size = 0;
  for (std::size_t i = 0; i < isLeftOut.size() && size < found.size(); ++i)
  {
    const Point3& p = points[i];
    const bool isIndependent = isLeftOut[i] == 0 &&
      (size == 0 || (size == 1 && !(p == found[0])) ||
        (size == 2 && !areCollinear(found[0], found[1], p)));
    if (isIndependent)
    {
      found[size++] = p;
    }
  }
  if (size < found.size())
  {
    throw std::logic_error("the points are collinear");
  }
  return found;
}

} // namespace

void requireShortIds(std::size_t count)
{
  if (count > std::size_t(std::numeric_limits<std::int32_t>::max()))
  {
    throw std::length_error("more than 2,147,483,647 points in space are not supported in memory");
  }
}

Tetrahedralization tetrahedralize(
  const Point3* points, std::size_t count, const TetrahedralizationOptions& options)
{
  requireShortIds(count);
  Tetrahedralization result;
  Tetrahedralizer({ points, count }, options, result).run();
  return result;
}

Triangulation triangulateCoplanar(const Point3* points, std::size_t count,
  const TetrahedralizationOptions& options, Tetrahedralization& mesh)
{
  const std::vector<char> isLeftOut = findLeftOut(mesh, std::int64_t(count));
  const auto [a, b, c] = findTriangle(points, isLeftOut);
  const auto axis = std::size_t(normalAxis(a, b, c));
  constexpr std::array<double Point3::*, 3> axes = { &Point3::x, &Point3::y, &Point3::z };
  const auto u = axes[(axis + 1) % 3];
  const auto v = axes[(axis + 2) % 3];
  Buffer<double> projected(2 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    projected[2 * i] = isLeftOut[i] != 0 ? none : points[i].*u;
    projected[2 * i + 1] = isLeftOut[i] != 0 ? none : points[i].*v;
  }
  TriangulationOptions flat;
  flat.Threads = options.Threads;
  // Progress already stands at 1: only check whether to stop.
  flat.Progress = [&options](double) { return !options.Progress || options.Progress(1); };
  Triangulation triangles = triangulate(PointsView(projected.data(), count, 2), flat);
  orderTriangles(triangles.Ids32);
  triangles.Rejected = mesh.Rejected;
  if (!triangles.Duplicates.empty())
  {
    mesh.Duplicates = triangles.Duplicates;
  }
  triangles.Duplicates = mesh.Duplicates;
  return triangles;
}

std::string describeDimension(int dimension)
{
  constexpr const char* reasons[] = { "there is no finite point", "all finite points coincide",
    "all finite points are on one line",
    "all finite points are in one plane, so the cells are triangles" };
  return std::string("No tetrahedra: ") + reasons[dimension + 1] + ".";
}

} // namespace tipp

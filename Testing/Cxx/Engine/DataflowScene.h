// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataflowScene_h
#define tippDataflowScene_h

#include "ScheduleTesting.h"

#include "Engine/PartitionSchedule.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/InitialMesh.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <functional>
#include <random>

namespace tipp
{
namespace test
{

/// What a run has before its first worker: points in partitions, regions and the initial mesh.
struct DataflowScene
{
  DataflowScene(const Coordinates& xy, const Tiling& tiling)
    : XY(xy)
    , Tiles(tiling)
    , Buckets(bucketPoints<std::int32_t>(view(this->XY), this->Tiles, 1))
    , Boxes(this->Tiles, this->Buckets, 1)
    , Artificial(makeArtificialPoints(this->Tiles))
    , Initial(chooseInitialPoints(this->Tiles, this->Buckets, 8, 1))
  {
    this->Initial.insert(this->Initial.end(), this->Artificial.begin(), this->Artificial.end());
    this->Mesh = triangulateVertices<2>(this->Boxes, this->Initial, 1);
  }
  DataflowScene(const std::string& set, std::size_t count, int columns, int rows)
    : DataflowScene(
        makePointSet(set, count), Tiling::grid(boundsOf(makePointSet(set, count)), columns, rows))
  {
  }
  DataflowScene(const DataflowScene&) = delete;
  DataflowScene& operator=(const DataflowScene&) = delete;

  PartitionOrder order(const std::vector<std::int32_t>& windows = {}) const
  {
    PartitionOrder order(this->Boxes.areUsed(), this->Mesh);
    if (!windows.empty())
    {
      order.setWindows(windows);
    }
    return order;
  }

  Coordinates XY;
  Tiling Tiles;
  PointBuckets<std::int32_t> Buckets;
  Regions Boxes;
  std::vector<BoundaryVertex> Artificial;
  std::vector<BoundaryVertex> Initial; ///< the artificial points are last
  BoundaryTriangles Mesh;
};

/// A run on one thread, which takes ready partitions in random order and records the messages.
class DataflowRun
{
public:
  DataflowRun(DataflowScene& scene, const PartitionOrder& order)
    : Scene(scene)
    , Order(order)
    , Inboxes(order.partitionCount())
    , Awaited(order.partitionCount(), 0)
  {
    for (const PartitionIndex p : order.sequence())
    {
      for (const PartitionIndex q : order.later(p))
      {
        ++this->Awaited[std::size_t(q)];
      }
    }
    for (const PartitionIndex p : order.sequence())
    {
      if (this->Awaited[std::size_t(p)] == 0)
      {
        this->Ready.push_back(p);
      }
    }
    this->deliver(sendInitialMesh(scene.Mesh, order));
  }

  /// Returns the triangulation of all points.
  Triangles run(std::mt19937_64& random)
  {
    Worker<std::int32_t> worker(this->Scene.Tiles, this->Scene.Buckets);
    Routing<std::int32_t> routing(this->Order, this->Scene.Boxes);
    Triangles all;
    while (!this->Ready.empty())
    {
      const std::size_t at = std::size_t(random() % this->Ready.size());
      const PartitionIndex p = this->Ready[at];
      this->Ready.erase(this->Ready.begin() + std::ptrdiff_t(at));
      this->triangulate(p, worker, routing);
      const std::int32_t* ids = this->Scene.Buckets.triangles(p);
      for (std::size_t i = 0; i < worker.interiorCount(); ++i)
      {
        all.push_back(canonical(ids[3 * i], ids[3 * i + 1], ids[3 * i + 2]));
      }
    }
    this->addBoundary(all);
    this->nameByLowest(all);
    return sorted(std::move(all));
  }

  /// Called with each partition's inbox before the partition is triangulated.
  std::function<void(PartitionIndex, const std::vector<VertexMessage>&)> Look;
  std::size_t Done = 0;

private:
  void deliver(SentMessages&& sent)
  {
    for (auto& [to, message] : sent)
    {
      this->Inboxes[std::size_t(to)].put(std::move(message));
    }
  }

  void triangulate(PartitionIndex p, Worker<std::int32_t>& worker, Routing<std::int32_t>& routing)
  {
    const std::vector<VertexMessage> messages = this->Inboxes[std::size_t(p)].take();
    if (this->Look)
    {
      this->Look(p, messages);
    }
    routing.triangulate(worker, p, messages);
    this->deliver(routing.send(worker, this->Final));
    ++this->Done;
    for (const PartitionIndex q : this->Order.later(p))
    {
      if (--this->Awaited[std::size_t(q)] == 0)
      {
        this->Ready.push_back(q);
      }
    }
  }

  /// A worker may use a duplicate that is not the lowest as representative. This renames these
  /// points, as the sink does.
  void nameByLowest(Triangles& all) const
  {
    const Ids lowest = reference(this->Scene.XY).Representative;
    for (Triangle& t : all)
    {
      t =
        canonical(lowest[std::size_t(t[0])], lowest[std::size_t(t[1])], lowest[std::size_t(t[2])]);
    }
  }

  void addBoundary(Triangles& all)
  {
    repairHull(std::move(this->Final.HullVertices), this->Scene.Artificial, this->Final);
    for (const auto& triangle : this->Final.Triangles)
    {
      all.push_back(canonical(triangle.Ids[0], triangle.Ids[1], triangle.Ids[2]));
    }
  }

  DataflowScene& Scene;
  const PartitionOrder& Order;
  std::vector<Inbox> Inboxes;
  std::vector<int> Awaited;
  std::vector<PartitionIndex> Ready;
  FinalBoundary<std::int32_t> Final;
};

inline bool conflict(const PartitionOrder& order, PartitionIndex p, PartitionIndex q)
{
  const auto isLater = [&order](PartitionIndex a, PartitionIndex b)
  {
    const PartitionOrder::LaterPartitions later = order.later(a);
    return std::find(later.begin(), later.end(), b) != later.end();
  };
  return isLater(p, q) || isLater(q, p);
}

} // namespace test
} // namespace tipp

#endif

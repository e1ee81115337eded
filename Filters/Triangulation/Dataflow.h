// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataflow_h
#define tippDataflow_h

#include "Arrays/IndexMap.h"
#include "Engine/Inbox.h"
#include "Engine/PartitionSchedule.h"
#include "Kernel/DelaunayKernel.h"
#include "Triangulation/BoundaryCells.h"
#include "Triangulation/Duplicate.h"
#include "Triangulation/Hull.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Regions.h"
#include "Triangulation/Tiling.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// Modifies the interior triangles of a partition in the kernel's mesh before they are written.
/// Their number and their union must not change. Each thread has its own editor.
class PartitionEditor
{
public:
  /// An edge between an interior triangle and another one.
  struct BorderEdge
  {
    DelaunayKernel::Index Outside; ///< the triangle that is not interior
    DelaunayKernel::Index Corner;  ///< its corner opposite to the edge, 0 to 2
  };

  template <typename Id>
  struct Partition
  {
    PartitionIndex Bucket; ///< index of the worker's bucket that has the partition's points
    DelaunayKernel& Kernel;
    const Id* Ids; ///< by kernel vertex, from 1 on: the point's id; -1 for other partitions' points
    const char* IsBoundary; ///< by the kernel's triangle number: 1 if not interior, otherwise 0
    const std::vector<BorderEdge>& Border; ///< empty if all finite triangles are interior
  };

  virtual ~PartitionEditor() = default;
  virtual void edit(const Partition<std::int32_t>& partition) = 0;
  virtual void edit(const Partition<std::int64_t>& partition) = 0;
};

/// Makes the editors of a run's threads.
class PartitionEditors
{
public:
  virtual ~PartitionEditors() = default;
  /// Called once, before the first editor is made. Points and tiling have the coordinates that the
  /// kernels use.
  virtual void begin(PointsView points, const Tiling& tiling) = 0;
  virtual std::unique_ptr<PartitionEditor> makeEditor() = 0;
};

/// Receives a partition's boundary triangles: those whose circumdisk meets its region and that are
/// not interior.
class BoundaryConsumer
{
public:
  virtual ~BoundaryConsumer() = default;

  /// Called before the first triangle. The kernel's vertices are 0 to vertexEnd - 1.
  virtual void begin(DelaunayKernel::Index vertexEnd) = 0;
  /// Called for each triangle; `corners` are the kernel's vertices, counter-clockwise.
  virtual void add(const std::array<DelaunayKernel::Index, 3>& corners, const Circumdisk& disk) = 0;
};

/// Triangulates one partition at a time (Lemma 1): its own points and the vertices of the triangles
/// that meet it. Its memory is reused from one partition to the next.
template <typename Id>
class Worker
{
public:
  /// `firstId` is added to the buckets' ids in boundary vertices and duplicates, which other ranks
  /// see. `firstBucket`: the bucket of the tiling's partition 0; negative if the first bucket
  /// belongs to a later partition. `tiling` and `buckets` must outlive this object.
  Worker(const Tiling& tiling, PointBuckets<Id>& buckets, std::int64_t firstId = 0,
    PartitionIndex firstBucket = 0);

  /// Sets the editor of interior triangles, called before they are written; null: no editor.
  void setEditor(std::unique_ptr<PartitionEditor> editor) { this->Editor = std::move(editor); }

  /// Triangulates the partition's points and `vertices`, which are the vertices, each once, of the
  /// triangles that meet its region. Overwrites these points with the interior triangles, whose
  /// order and number depend only on the partition's points, and passes the boundary triangles to
  /// `boundary`.
  void triangulate(PartitionIndex partition, std::vector<BoundaryVertex>&& vertices,
    const Box2& region, BoundaryConsumer& boundary);

  /// @name The steps of triangulate()
  /// Two workers can insert their partitions' points in turn, which takes a twelfth less time than
  /// one after the other.
  ///@{
  void begin(PartitionIndex partition, std::vector<BoundaryVertex>&& vertices);
  void insertPoints();
  static void insertPoints(Worker& one, Worker& other);
  void finish(const Box2& region, BoundaryConsumer& boundary);
  ///@}

  /// A vertex of the kernel after the last triangulate().
  BoundaryVertex vertex(PartitionIndex partition, DelaunayKernel::Index v) const;

  /// Triangulates partition 0, the only one: all triangles are interior. Returns false if the
  /// monitor stopped it.
  bool triangulateAlone(const DelaunayKernel::Monitor& proceed);

  std::size_t interiorCount() const { return this->InteriorCount; }

  /// The partition's duplicates: points that coincide with another point. The representative is the
  /// one with the lowest id, unless it is an initial point, which other partitions know already.
  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }
  std::size_t vertexCount() const { return this->VertexCount; }

private:
  void separateGhosts(std::vector<BoundaryVertex>&& vertices);
  DelaunayKernel::Batch ownPoints() const;
  PartitionIndex bucket(PartitionIndex partition) const { return this->FirstBucket + partition; }
  void resolveDuplicates();
  void setVertexIds();
  void edit();
  void findBoundary(const Box2& box, const Box2& region, BoundaryConsumer& boundary);
  template <typename IsInterior>
  void writeTriangles(PartitionIndex bucket, const IsInterior& isInterior);

  const Tiling& Boxes;
  PointBuckets<Id>& Buckets;
  const std::int64_t FirstId;
  const PartitionIndex FirstBucket;
  std::unique_ptr<PartitionEditor> Editor;
  PooledKernel Pooled;
  DelaunayKernel& Kernel;
  PartitionIndex Partition = 0;
  std::vector<Id> Ids;                ///< ids of the partition's own points
  std::vector<Id> VertexIds;          ///< by kernel vertex: the point's id; -1 for ghosts
  std::vector<BoundaryVertex> Ghosts; ///< vertices from the inbox, except own points
  std::vector<Point2> GhostPoints;
  std::vector<std::int64_t> KnownIds; ///< ids of own points that other partitions know; sorted
  std::vector<char> IsBoundary;       ///< by the kernel's triangle number
  std::vector<PartitionEditor::BorderEdge> Border; ///< filled only for an editor
  std::vector<DelaunayKernel::Index> Stack;
  std::vector<Duplicate> Duplicates;
  std::size_t InteriorCount = 0;
  std::size_t VertexCount = 0;
};

using VertexMessage = VertexMessageOf<BoundaryVertex>;
using SentMessages = SentMessagesOf<BoundaryVertex>;
using Inbox = MessageInbox<VertexMessage>;

/// Collects the vertices of several messages, each once.
class UniqueVertices
{
public:
  std::vector<BoundaryVertex> collect(const std::vector<VertexMessage>& messages);

private:
  IndexMap Known; ///< ids; a member to reuse its memory
};

using FinalTriangleConsumer = FinalCellConsumer<2>;

/// Collects final boundary triangles: triangles without artificial corners as they are, and of the
/// others the true corners, which the hull repair needs.
template <typename Id>
struct FinalBoundary : public FinalTriangleConsumer
{
  std::vector<typename TriangleSink<Id>::FinalTriangle> Triangles;
  std::vector<BoundaryVertex> HullVertices; ///< may contain repetitions

  void add(const BoundaryTriangle& triangle) override
  {
    if (takeHullVertices(triangle, this->HullVertices))
    {
      return;
    }
    const auto lowest = std::min_element(triangle.begin(), triangle.end(),
      [](const BoundaryVertex& a, const BoundaryVertex& b) { return a.Id < b.Id; });
    this->Triangles.push_back(
      { TriangleSink<Id>::fromLowest({ static_cast<Id>(triangle[0].Id),
          static_cast<Id>(triangle[1].Id), static_cast<Id>(triangle[2].Id) }),
        lowest->Partition });
  }

  void append(FinalBoundary&& other)
  {
    this->Triangles.insert(this->Triangles.end(), other.Triangles.begin(), other.Triangles.end());
    this->HullVertices.insert(
      this->HullVertices.end(), other.HullVertices.begin(), other.HullVertices.end());
    other.Triangles.clear();
    other.HullVertices.clear();
  }
};

/// Routes the boundary triangles of a partition, one partition after another.
///
/// Lemma 6: the partitions that a triangle meets conflict pairwise, so the order is total on them.
/// The triangle is sent to the next of them only, and is final if there is none. (Proof. By Lemma
/// 5, two partitions conflict if a triangle of any later mesh meets both. At any time the inbox of
/// q holds each triangle of the mesh before q that meets q exactly once, sent by the last earlier
/// partition that it meets, or by the initial mesh. It exists there, because its vertices are
/// initial or lie in partitions that it meets. Partitions in between do not meet it, so it survives
/// them. When q is done, its triangles that still exist are among the output of q's worker.)
template <typename Id>
class Routing : public BoundaryConsumer
{
public:
  using Corners = std::array<DelaunayKernel::Index, 3>;

  Routing(const PartitionOrder& order, const Regions& regions)
    : Order(order)
    , Boxes(regions)
  {
  }

  /// Triangulates partition p: the worker's points and the vertices in `inbox`. Keeps the boundary
  /// triangles for send(). Returns the number of triangles whose vertices are in `inbox`.
  std::int64_t triangulate(
    Worker<Id>& worker, PartitionIndex p, const std::vector<VertexMessage>& inbox)
  {
    const std::int64_t handed = this->prepare(worker, p, inbox);
    worker.insertPoints();
    this->finish(worker);
    return handed;
  }

  ///@{
  /// The first and the last step of triangulate(). In between, the worker's points are inserted.
  std::int64_t prepare(
    Worker<Id>& worker, PartitionIndex p, const std::vector<VertexMessage>& inbox)
  {
    this->Sender = p;
    this->Later = this->Order.later(p);
    worker.begin(p, this->Unique.collect(inbox));
    return cellsOf(inbox);
  }
  void finish(Worker<Id>& worker) { worker.finish(this->Boxes[this->Sender], *this); }
  ///@}

  void begin(DelaunayKernel::Index vertexEnd) override
  {
    this->VertexEnd = std::size_t(vertexEnd);
    this->Outgoing.assign(this->Later.size(), {});
    this->Final.clear();
  }

  void add(const Corners& corners, const Circumdisk& disk) override
  {
    const auto next = std::find_if(this->Later.begin(), this->Later.end(),
      [&](PartitionIndex q) { return disk.meets(this->Boxes[q]); });
    std::vector<Corners>& triangles = next == this->Later.end()
      ? this->Final
      : this->Outgoing[std::size_t(next - this->Later.begin())];
    triangles.push_back(corners);
  }

  /// Returns the messages to later partitions, and passes the triangles that meet none to `final`.
  SentMessages send(const Worker<Id>& worker, FinalTriangleConsumer& final) const
  {
    const auto vertexAt = [&](DelaunayKernel::Index v) { return worker.vertex(this->Sender, v); };
    SentMessages sent = messagesWith(this->Sender, this->Outgoing, this->VertexEnd, vertexAt);
    for (auto& [to, message] : sent)
    {
      to = this->Later.begin()[to];
    }
    for (const Corners& v : this->Final)
    {
      final.add({ vertexAt(v[0]), vertexAt(v[1]), vertexAt(v[2]) });
    }
    return sent;
  }

private:
  const PartitionOrder& Order;
  const Regions& Boxes;
  UniqueVertices Unique;
  PartitionIndex Sender = 0;
  PartitionOrder::LaterPartitions Later{ nullptr, nullptr };
  std::size_t VertexEnd = 0;
  std::vector<std::vector<Corners>> Outgoing; ///< triangles by their recipient's index in Later
  std::vector<Corners> Final;                 ///< triangles without recipient
};

} // namespace tipp

#endif

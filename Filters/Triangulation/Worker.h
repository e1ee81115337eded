// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWorker_h
#define tippWorker_h

#include "Kernel/DelaunayKernel.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Tiling.h"
#include "Triangulation/Triangulate.h"

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
  /// see.
  Worker(const Tiling& tiling, PointBuckets<Id>& buckets, std::int64_t firstId = 0);

  /// From now on, partition indices are those of `tiling`; its partition 0 is bucket `firstBucket`.
  void setTiling(const Tiling& tiling, PartitionIndex firstBucket);

  /// Sets the editor of interior triangles, called before they are written; null: no editor.
  void setEditor(std::unique_ptr<PartitionEditor> editor) { this->Editor = std::move(editor); }

  /// Triangulates the partition's points and `vertices`, which are the vertices, each once, of the
  /// triangles that meet its region. Overwrites these points with the interior triangles, whose
  /// order and number depend only on the partition's points, and passes the boundary triangles to
  /// `boundary`.
  void triangulate(PartitionIndex partition, std::vector<BoundaryVertex>&& vertices,
    const Box2& region, BoundaryConsumer& boundary);

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
  void reserve();
  void separateGhosts(PartitionIndex partition, std::vector<BoundaryVertex>&& vertices);
  PartitionIndex bucket(PartitionIndex partition) const { return this->FirstBucket + partition; }
  void resolveDuplicates();
  void setVertexIds();
  void edit(PartitionIndex partition);
  void findBoundary(const Box2& box, const Box2& region, BoundaryConsumer& boundary);
  template <typename IsInterior>
  void writeTriangles(PartitionIndex bucket, const IsInterior& isInterior);

  const Tiling* Boxes;
  PointBuckets<Id>& Buckets;
  const std::int64_t FirstId;
  PartitionIndex FirstBucket = 0;
  std::unique_ptr<PartitionEditor> Editor;
  PooledKernel Pooled;
  DelaunayKernel& Kernel;
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

} // namespace tipp

#endif

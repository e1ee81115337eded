// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWorker_h
#define tippWorker_h

#include "Kernel/KernelPool.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/SeamMesh.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// Triangulates one partition at a time (Lemma 1): its points, and the vertices of the triangles
/// that belong to it. Keeps its memory from one partition to the next.
template <typename Id>
class Worker
{
public:
  /// The buckets' ids are counted from a first id on: seams and duplicates have it added.
  Worker(const Tiling& tiling, PointBuckets<Id>& buckets, std::int64_t firstId = 0);

  /// From now on partitions are those of another tiling, the first of which has this bucket.
  void setTiling(const Tiling& tiling, PartitionIndex firstBucket);

  /// Writes the partition's interior triangles, whose order and number depend on its own points
  /// alone, over its points, and keeps the others whose circumdisk meets the partition.
  void triangulate(PartitionIndex partition, const std::vector<SeamTriangle>& belonging);

  /// The same, of the vertices of the triangles that belong to it, each once.
  void triangulate(PartitionIndex partition, std::vector<SeamVertex>&& vertices);

  /// The only partition, number 0: all triangles are interior. False if the monitor ended it.
  bool triangulateAlone(const DelaunayKernel::Monitor& proceed);

  std::size_t interiorCount() const { return this->InteriorCount; }
  const SeamTriangles& seams() const { return this->Seams; }
  SeamTriangles takeSeams() { return std::move(this->Seams); }

  /// Points of the partition at the place of another. The representative is the lowest id, unless
  /// it is an initial point, which other partitions know already.
  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }
  std::size_t vertexCount() const { return this->VertexCount; }

private:
  void reserve();
  void collectVertices(const SeamVertex* vertices, std::size_t count);
  void separateOwnVertices(PartitionIndex partition);
  void triangulateCollected(PartitionIndex partition);
  PartitionIndex bucket(PartitionIndex partition) const { return this->FirstBucket + partition; }
  void takeIds(PartitionIndex bucket);
  void resolveDuplicates();
  void findSeams(PartitionIndex partition);
  template <typename IsInterior>
  void writeTriangles(PartitionIndex bucket, const IsInterior& isInterior);
  void nameSeamVertices(PartitionIndex partition);
  SeamVertex vertex(PartitionIndex partition, DelaunayKernel::Index v) const;
  std::uint32_t seamPlace(DelaunayKernel::Index v);

  const Tiling* Boxes;
  PointBuckets<Id>& Buckets;
  const std::int64_t FirstId;
  PartitionIndex FirstBucket = 0;
  PooledKernel Pooled;
  DelaunayKernel& Kernel;
  std::vector<Id> Ids; ///< of the partition's own points
  std::vector<Id> VertexIds;
  std::vector<SeamVertex> Foreign; ///< vertices that came with the triangles, but for own ones
  std::vector<Point2> ForeignPoints;
  std::vector<std::int64_t> KnownIds; ///< of own points that other partitions know; sorted
  std::vector<std::uint32_t> HashTable;
  std::vector<char> IsSeam; ///< of each triangle of the kernel: not interior
  std::vector<DelaunayKernel::Index> Stack;
  SeamTriangles Seams;
  std::vector<std::uint32_t> SeamPlaces; ///< of the kernel's vertices among those of the seams
  std::vector<DelaunayKernel::Index> SeamVertices; ///< those of the seams
  std::vector<Duplicate> Duplicates;
  std::size_t InteriorCount = 0;
  std::size_t VertexCount = 0;
};

extern template class Worker<std::int32_t>;
extern template class Worker<std::int64_t>;

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInitialMesh3_h
#define tippInitialMesh3_h

#include "Engine/PartitionOrder.h"
#include "Triangulation3D/Tiling3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A vertex with the data that a worker of any partition needs.
struct Vertex3
{
  Point3 Position;
  std::int64_t Id;          ///< of the input point; negative for artificial points
  PartitionIndex Partition; ///< the partition that has the point; -1 for artificial points

  bool isArtificial() const { return this->Id < 0; }
};

/// Returns the indices of about `wanted` points, ascending: the first points with the smallest and
/// largest coordinates, and others at equal steps in the input's order.
std::vector<std::size_t> chooseInitialPoints(
  const Point3* points, std::size_t count, std::size_t wanted);

/// Returns artificial points on the sides of a box around the domain, its corners among them. Their
/// distance from the domain and from each other is about the width of a partition: its longest side
/// or, for slabs, half of its shortest one. Returns an empty list if doubles cannot enclose the
/// domain.
std::vector<Vertex3> makeArtificialPoints(const PointBuckets3& buckets, bool areSlabs = false);

/// The initial mesh: the Delaunay triangulation of some points of each partition and of the
/// artificial points. It also lists the partitions that each tetrahedron meets: those whose region
/// its closed circumball meets.
struct InitialMesh3
{
  static constexpr std::size_t PointsOfPartition = 48;

  /// `wanted`: about how many initial points a partition gets.
  InitialMesh3(const PointBuckets3& buckets, const std::vector<Vertex3>& artificial,
    std::size_t wanted = PointsOfPartition);

  /// Returns which partitions conflict (Lemma 5): one tetrahedron meets both, or of two tetrahedra
  /// with a common facet one meets the first partition and the other the second. The proof in
  /// PartitionOrder.h holds with 'facet' for 'edge'.
  ConflictGraph conflicts() const;

  /// Returns whether partitioning pays. If circumballs meet many partitions each, as for points on
  /// a surface, most vertices would be triangulated several times. `most`: so many on average;
  /// measured with many partitions 2.1 to 2.5 in a volume, 4 on a surface, 14 on a sphere.
  bool partitionsPay(double most = 3) const;

  std::vector<Vertex3> Vertices;
  std::vector<std::array<std::uint32_t, 4>> Cells; ///< indices into Vertices
  std::vector<std::size_t> MetEnds;                ///< by cell: the end of its entries in Met
  /// The partitions that the cells meet, cell by cell.
  std::vector<PartitionIndex> Met;
  std::vector<std::array<std::uint32_t, 2>> Neighbours; ///< pairs of cells with a common facet

  std::size_t metBegin(std::size_t cell) const { return cell == 0 ? 0 : this->MetEnds[cell - 1]; }
  std::size_t metEnd(std::size_t cell) const { return this->MetEnds[cell]; }

private:
  std::size_t Partitions;
};

} // namespace tipp

#endif

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

/// A vertex with the data that any worker needs.
struct Vertex3
{
  Point3 Position;
  std::int64_t Id;          ///< the input point's id; negative for artificial points
  PartitionIndex Partition; ///< the partition that contains it; -1 for artificial points

  bool isArtificial() const { return this->Id < 0; }
};

/// The first points with the smallest and largest coordinates, and others evenly spaced in the
/// input's order: their indices, ascending; about `wanted`.
std::vector<std::size_t> chooseInitialPoints(
  const Point3* points, std::size_t count, std::size_t wanted);

/// Artificial points on the sides of a box around the domain, its corners among them. Their
/// distance from the domain and from each other is about the width of a partition: of its longest
/// side or, for slabs, half of its shortest. Empty if doubles cannot enclose the domain.
std::vector<Vertex3> makeArtificialPoints(const PointBuckets3& buckets, bool areSlabs = false);

/// The Delaunay triangulation of some points of each partition and the artificial points, and which
/// partitions each tetrahedron meets: its closed circumball meets their region.
struct InitialMesh3
{
  static constexpr std::size_t PointsOfPartition = 48;

  /// `wanted`: about how many points of a partition.
  InitialMesh3(const PointBuckets3& buckets, const std::vector<Vertex3>& artificial,
    std::size_t wanted = PointsOfPartition);

  /// Which partitions conflict: if one tetrahedron meets both, or of two with a common facet one
  /// meets the first and the other the second (Lemma 5; the proof in PartitionOrder.h holds with
  /// 'facet' for 'edge').
  ConflictGraph conflicts() const;

  /// Whether partitioning pays. If circumballs meet many partitions each, as of points on a
  /// surface, workers would get most vertices several times.
  bool partitionsPay() const;

  std::vector<Vertex3> Vertices;
  std::vector<std::array<std::uint32_t, 4>> Cells; ///< indices into Vertices
  std::vector<std::size_t> MetEnds;                ///< by cell: one past its last entry in Met
  std::vector<PartitionIndex> Met;
  std::vector<std::array<std::uint32_t, 2>> Neighbours; ///< cells with a common facet

  std::size_t metBegin(std::size_t cell) const { return cell == 0 ? 0 : this->MetEnds[cell - 1]; }
  std::size_t metEnd(std::size_t cell) const { return this->MetEnds[cell]; }

private:
  std::size_t Partitions;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInitialMesh3_h
#define tippInitialMesh3_h

#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation3D/Tiling3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A vertex of a tetrahedron. Artificial points have the partition -1.
using Vertex3 = VertexOf<Point3>;

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
/// its closed circumball meets. The proof of Lemma 5 in PartitionOrder.h holds with 'facet' for
/// 'edge'.
struct InitialMesh3 : MetPartitions
{
  static constexpr std::size_t PointsOfPartition = 48;

  /// `wanted`: about how many initial points a partition gets.
  InitialMesh3(const PointBuckets3& buckets, const std::vector<Vertex3>& artificial,
    std::size_t wanted = PointsOfPartition);

  std::vector<Vertex3> Vertices;
  std::vector<std::array<std::uint32_t, 4>> Cells; ///< indices into Vertices
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInitialMesh_h
#define tippInitialMesh_h

#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/Tiling.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Returns artificial points at the corners and along the edges of a rectangle around the domain
/// (chapter 2.4.1). Their distance from the domain and from each other is the width of a partition.
/// Their ids are -1, -2 and so on. Empty if the domain is too large for doubles to enclose it.
std::vector<BoundaryVertex> makeArtificialPoints(const Tiling& tiling);

/// Chooses a partition's points for the initial mesh, and returns their indices in `points`: the
/// extreme ones in x and y, and others evenly spaced in the input's order. With the extreme points,
/// fewer disks over voids meet many partitions, which halves the chains of conflicting partitions
/// of clustered points. If `wanted` is small, only evenly spaced points are chosen.
std::vector<std::size_t> chooseInitialPoints(
  const Point2* points, std::size_t count, std::size_t wanted);

/// Chooses `perPartition` points of each partition; their ids are the buckets' ids.
template <typename Id>
std::vector<BoundaryVertex> chooseInitialPoints(
  const Tiling& tiling, const PointBuckets<Id>& buckets, int perPartition, int threads);

/// The Delaunay triangulation of the vertices, with the regions that each triangle meets, and the
/// pairs of sets that adjacent triangles meet.
BoundaryTriangles triangulateVertices(
  const Regions& regions, const std::vector<BoundaryVertex>& vertices, int threads);

/// Whether partitioning pays. If circumdisks meet many partitions each (points on a circle or a
/// parabola, or on a line with one beside it: 3.5 and more partitions each, by measurement), every
/// worker would get nearly all vertices. Ordinary points give 1.5 to 2.8. Triangles that meet no
/// partition do not count.
bool partitionsPay(const BoundaryTriangles& initialMesh);
/// The same by counts: triangles that meet partitions, and how many they meet, summed.
bool partitionsPay(std::int64_t triangles, std::int64_t met);

} // namespace tipp

#endif

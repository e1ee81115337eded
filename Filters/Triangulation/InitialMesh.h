// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInitialMesh_h
#define tippInitialMesh_h

#include "Engine/Regions.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/SeamTriangles.h"

#include <functional>
#include <vector>

namespace tipp
{

/// Artificial points at the corners of a rectangle around the domain and along its edges (chapter
/// 2.4.1), as far from the domain and from each other as partitions are wide. Their ids are -1, -2
/// and so on. Empty if the domain reaches too far for doubles to enclose it.
std::vector<SeamVertex> makeArtificialPoints(const Tiling& tiling);

/// Which of a partition's points the initial mesh takes: the outmost ones in x and y, and others
/// that are evenly spaced in the input's order. With the outmost ones fewer disks over voids reach
/// many partitions, so that chains of conflicting partitions are half as long where points are
/// clustered. If few are wanted, evenly spaced ones alone.
std::vector<std::size_t> chooseInitialPoints(
  const Point2* points, std::size_t count, std::size_t wanted);

/// So many of each partition's points.
template <typename Id>
std::vector<SeamVertex> chooseInitialPoints(
  const Tiling& tiling, const PointBuckets<Id>& buckets, int perPartition, int threads);

/// Which of the initial mesh's triangles to find the boxes of, where ranks share that out.
struct InitialMeshShare
{
  int Index = 0;
  int Count = 1;
  /// Of this share's triangles makes those of all shares, in order; needed for several.
  std::function<std::vector<SeamTriangles>(SeamTriangles&&)> Exchange;
};

/// The Delaunay triangulation of vertices, with the boxes (a Tiling's, or Regions) that each
/// triangle meets, and those that triangles with a common edge meet.
template <typename Boxes>
SeamTriangles triangulateVertices(const Boxes& boxes, const std::vector<SeamVertex>& vertices,
  int threads, const InitialMeshShare& share = {});

/// Circumdisks that meet many partitions each (points on a circle, a parabola, a line and one
/// beside it: 3.5 and more partitions each, by measurement) would bring nearly all vertices to
/// every worker. Ordinary points give 1.5 to 2.8.
bool partitionsPay(const SeamTriangles& initialMesh);

extern template SeamTriangles triangulateVertices(
  const Tiling&, const std::vector<SeamVertex>&, int, const InitialMeshShare&);
extern template SeamTriangles triangulateVertices(
  const Regions&, const std::vector<SeamVertex>&, int, const InitialMeshShare&);
extern template std::vector<SeamVertex> chooseInitialPoints(
  const Tiling&, const PointBuckets<std::int32_t>&, int, int);
extern template std::vector<SeamVertex> chooseInitialPoints(
  const Tiling&, const PointBuckets<std::int64_t>&, int, int);

} // namespace tipp

#endif

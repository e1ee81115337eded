// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRefine_h
#define tippRefine_h

#include "Arrays/Buffer.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Refinement/RefinementOptions.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

struct RefinementStatistics
{
  std::int64_t Levels = 0;
  std::int64_t Rounds = 0;   ///< of blocks in parallel
  std::int64_t Blocks = 0;   ///< in all rounds
  std::int64_t Splits = 0;   ///< points added on segments
  std::int64_t Inserted = 0; ///< points added in all
  std::int64_t GivenUp = 0;  ///< triangles that could not be refined, of which some vanished later
  std::int64_t Moves = 0;    ///< by smooth(): a point that moves in several rounds counts in each
};

/// A triangle that has an angle below the bound, or an area above its limit.
struct TriangleOutside
{
  enum class Reason
  {
    InputAngle,   ///< segments of the input meet at an angle below 60 degrees
    ShortestEdge, ///< refinement would make edges shorter than ShortestEdge, or than rounding
                  ///< allows
    KeptSegments, ///< KeepsBorder or KeepsSegments forbids the points
    MostPoints    ///< MostPoints was reached
  };
  std::int64_t Triangle; ///< index
  double Angle;          ///< its smallest, in degrees
  double Area;
  Reason Why;
};

/// A mesh made by refinement.
struct RefinedMesh
{
  /// x and y of the added points. Their ids follow those of the points given.
  Buffer<double> AddedXY;
  /// Three point ids each, counter-clockwise. Both arrays are in RefinementOptions::Memory.
  Buffer<std::int32_t> Triangles;
  /// By triangle: the index of its region among RefinementOptions::Regions, or -1. Empty if no
  /// regions are given.
  Buffer<std::int32_t> RegionOf;
  std::vector<char> IsUsed; ///< by point given: whether triangles have it
  /// The subsegments, by constraint; those of edges of the convex hull have the constraint -1.
  std::vector<IdSegment> Segments;
  std::vector<TriangleOutside> Outside; ///< those not as asked, ascending
  RefinementStatistics Statistics;
  bool Aborted = false; ///< Progress stopped the run; there are no triangles then

  std::size_t addedCount() const { return this->AddedXY.size() / 2; }
  std::size_t triangleCount() const { return this->Triangles.size() / 3; }
};

/// Refines a constrained Delaunay triangulation until its triangles have no angle below a bound and
/// no area above a limit, by inserting points: a mesh for finite elements, graded by its input. The
/// result is a constrained Delaunay triangulation in which every segment is a chain of edges.
///
/// `points` are those of the triangulation, with its crossings. Points of no triangle, such as
/// those in holes, stay unused. The result is the same for any number of threads. Throws
/// std::invalid_argument for options out of their range or a region's point in no triangle, and
/// std::length_error if the mesh is too large for the memory or for 2^29 triangles.
///
/// Delaunay refinement after Ruppert (1995) and Chew (1993) with the diametral lenses and
/// concentric shells of Shewchuk (2002) and Üngör's off-centers (2004).
VTKTIPPFILTERS_EXPORT RefinedMesh refine(PointsView points,
  const ConstrainedTriangulation& triangulation, const RefinementOptions& options);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshPoints_h
#define tippMeshPoints_h

#include "Arrays/Buffer.h"
#include "Constraints/ResolveCrossings.h"
#include "InMemory/TriangulatePoints.h"
#include "Refinement/Refine.h"
#include "Refinement/SurfaceLocator.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// A triangulated surface over the plane, whose height is the wanted length of edges. Not owned.
struct LengthSurface
{
  PointsView Points;
  const std::int32_t* Corners = nullptr; ///< three point ids per triangle
  std::int64_t Triangles = 0;
  const double* Lengths = nullptr; ///< by point, in the points' unit; above 0 and finite
};

/// How points in memory are meshed.
struct MeshRequest
{
  /// meshPoints() sets IsEnclosed, and adds the limits below to AreaAt. Without bounds of angles
  /// and areas, no points are added.
  RefinementOptions Refinement;
  const SourceConstraints* Source = nullptr; ///< null: none
  CrossingRule Crossings = CrossingRule::Split;
  /// The domain is the convex hull of the points, without the holes. Otherwise polygons define it
  /// as for triangulatePoints(); if there are only lines, it is what they enclose; and if there are
  /// no constraints, it is the hull.
  bool IsConvex = false;
  /// By point: the wanted length of edges, linear in the triangles of the points; null: no limit.
  /// Where the length is h, no triangle's area is above that of the equilateral triangle of side h.
  const double* Lengths = nullptr;
  /// As Lengths, on a surface of its own; outside of the surface there is no limit. Null: none.
  const LengthSurface* Surface = nullptr;
  /// The largest number of rounds of smooth(); 0: points that refinement added stay where they are.
  int SmoothingRounds = 0;
  /// Whether PointsMesh::Blends is wanted.
  bool HasValues = false;
};

/// The mesh of points. New points, the crossings and then those that refinement adds, follow the
/// points given.
struct PointsMesh
{
  RefinedMesh Mesh;
  Buffer<double> NewXY;       ///< of the new points
  std::int64_t Crossings = 0; ///< the number of those that are crossings
  /// By new point: the points before it that it lies between. In RefinementOptions::Memory, as
  /// NewXY.
  Buffer<PointBlend> Blends;
  bool Aborted = false; ///< Progress stopped the run; there are no triangles then
};

/// The values of arrays that mark triangles outside of the bounds: 0 for those within them, else
/// 1 (input angle), 2 (shortest edge), 3 (kept segments) or 4 (most points).
inline unsigned char codeOf(TriangleOutside::Reason reason)
{
  return (unsigned char)(1 + int(reason));
}

/// Meshes points in memory, for vtkTIPPRefine2D and for Python: computes their constrained Delaunay
/// triangulation, refines it, and smooths the result if that is requested. Values at added points
/// are interpolated along their segment or, inside the domain, in the triangulation before
/// refinement. `warnings` receives a sentence for each problem. Throws like triangulatePoints() and
/// refine(), and std::invalid_argument for a length that is not above 0 and finite or a negative
/// number of rounds.
VTKTIPPFILTERS_EXPORT PointsMesh meshPoints(
  PointsView points, const MeshRequest& request, std::vector<std::string>& warnings);

} // namespace tipp

#endif

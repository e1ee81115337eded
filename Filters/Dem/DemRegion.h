// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDemRegion_h
#define tippDemRegion_h

#include "Dem/TerrainSampler.h"
#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"
#include "Raster/RasterFile.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/Triangulation.h"
#include "vtkTIPPFiltersModule.h"

#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Chooses the points to read for a raster of a small part of the points' area: those in the box of
/// the raster and a margin around it. Read them, triangulate them, and ask isKnown(). If it is
/// false, call grow() and start again; in the end all points are read. Only points of LAS and LAZ
/// files are left out, because these state their bounds.
class VTKTIPPFILTERS_EXPORT DemRegion
{
public:
  /// `request` has the raster's grid or bounds, else all points are read; so they are if `options`
  /// thin or wrap the points. Reads the headers of the files. Throws IOError, and
  /// std::runtime_error as makeRasterGrid().
  DemRegion(const std::vector<std::string>& paths, const PointOptions& options,
    const RasterRequest& request);

  /// The box whose points are read; nullopt: all points are.
  const std::optional<Box2>& box() const { return this->Box; }

  /// Chooses a larger box, or all points if it would have many of them.
  void grow();

  /// Chooses the box of a raster of points about `spacing` apart, for which a few points around it
  /// are enough.
  static Box2 around(const RasterRequest& request, double spacing);

private:
  void choose();

  Box2 Raster{}; ///< the centres of the pixels
  Box2 All{};    ///< the bounds of the points
  double Margin = 0;
  std::optional<Box2> Box;
};

/// Returns whether the pixels of a raster are known from the triangulation of only the points in a
/// closed box: the triangles there are those of all points, and cover it. `mesh` has all triangles
/// of these points.
///
/// Proof. A triangle whose closed circumdisk lies in the box has no further point in it, so it is
/// also one of the Delaunay triangulation of all points; which of several on a circle are chosen
/// depends only on their coordinates. If all triangles that meet the raster's box are such, and its
/// corners are in triangles, then these triangles cover the box, which is convex as their union is,
/// and no others of the whole triangulation meet it.
VTKTIPPFILTERS_EXPORT bool isKnown(PointsView points, const Triangulation& mesh,
  const RasterGrid& grid, const Box2& region, int threads);

} // namespace tipp

#endif

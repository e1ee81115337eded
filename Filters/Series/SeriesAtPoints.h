// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeriesAtPoints_h
#define tippSeriesAtPoints_h

#include "Predicates/Geometry.h"
#include "Series/MeshSeries.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The triangles of a series' mesh that contain some points, such as stations, kept for all its
/// variables and time steps.
class VTKTIPPFILTERS_EXPORT SeriesAtPoints
{
public:
  /// Reads the mesh and locates the points, by the rule of CellLocator. `points`: with z ignored.
  /// `wraps`: x are longitudes, and points outside of the mesh are also looked for 360 degrees to
  /// the east and to the west. Throws IOError.
  SeriesAtPoints(MeshSeries& series, std::vector<Point3> points, bool wraps, int threads);

  /// The index of the triangle that contains each point; -1: none.
  const std::vector<std::int64_t>& triangles() const { return this->Triangles; }

  /// A variable's values at the points, from what MeshSeries::read() gives: interpolated in
  /// the triangle, or its value if the variable is on cells. NaN outside of the mesh and where a
  /// corner has no value.
  std::vector<double> valuesOf(
    const SeriesVariable& variable, const std::vector<double>& read) const;

private:
  std::vector<std::int64_t> Triangles;
  std::vector<std::array<std::int64_t, 3>> Nodes; ///< the corners of each point's triangle
  std::vector<std::array<double, 3>> Weights;
};

} // namespace tipp

#endif

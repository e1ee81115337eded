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

class ChosenTriangles;

/// The triangles of a series' mesh that contain some points, such as stations, kept for all its
/// variables and time steps.
class VTKTIPPFILTERS_EXPORT SeriesAtPoints
{
public:
  /// Reads the mesh, block by block, and locates the points, by the rule of CellLocator. `points`:
  /// with z ignored. `wraps`: x are longitudes, and points outside of the mesh are also looked for
  /// 360 degrees to the east and to the west. Throws IOError.
  SeriesAtPoints(MeshSeries& series, std::vector<Point3> points, bool wraps, int threads);

  /// The index of the triangle that contains each point; -1: none.
  const std::vector<std::int64_t>& triangles() const { return this->Triangles; }

  /// The bounding box of the mesh's triangles.
  const Box2& bounds() const { return this->Bounds; }

  /// The nodes or cells of the file with the points' values of a variable.
  const std::vector<std::int32_t>& stored(const SeriesVariable& variable) const
  {
    return variable.OnCells ? this->StoredCells : this->StoredNodes;
  }

  /// A variable's values at the points, from what MeshSeries::readAt() gives for stored():
  /// interpolated in the triangle, or its value if the variable is on cells. NaN outside of the
  /// mesh and where a corner has no value.
  std::vector<double> valuesOf(
    const SeriesVariable& variable, const std::vector<double>& read) const;

private:
  void store(const ChosenTriangles& triangles, const std::vector<std::int32_t>& found);

  Box2 Bounds = Box2::empty();
  std::vector<std::int64_t> Triangles;
  ///@{ What each point has the values of: the nodes of its triangle, as positions in StoredNodes,
  /// and their weights, or the position in StoredCells.
  std::vector<std::array<std::size_t, 3>> Nodes;
  std::vector<std::array<double, 3>> Weights;
  std::vector<std::size_t> Cells;
  ///@}
  std::vector<std::int32_t> StoredNodes;
  std::vector<std::int32_t> StoredCells;
};

} // namespace tipp

#endif

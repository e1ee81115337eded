// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/CellShape.h"

#include "OpenCL/AcceleratorError.h"

#include <string>

namespace tipp
{

CellShape::CellShape(const CellsView& cells, int dimension)
  : Cells(cells)
  , Dimension(dimension)
  , Stride(static_cast<std::size_t>(cells.Dimension) * static_cast<std::size_t>(cells.Corners))
{
  const bool triangles = cells.Corners == 3 && (cells.Dimension == 2 || cells.Dimension == 3);
  const bool tetrahedra = cells.Corners == 4 && cells.Dimension == 3;
  if (!triangles && !tetrahedra)
  {
    throw AcceleratorError("Cells are triangles, or tetrahedra in space; not cells of " +
      std::to_string(cells.Corners) + " corners in " + std::to_string(cells.Dimension) +
      " dimensions.");
  }
  if (dimension > cells.Dimension || (tetrahedra && dimension != 3))
  {
    throw AcceleratorError("Partitions of " + std::to_string(dimension) +
      " dimensions do not go with " + (tetrahedra ? "tetrahedra." : "triangles in the plane."));
  }
}

bool CellShape::meetsInPlane(const double* corner, const Box3& box) const
{
  const int step = this->Cells.Dimension;
  const double* b = corner + step;
  const double* c = b + step;
  return triangleMeetsBox({ corner[0], corner[1] }, { b[0], b[1] }, { c[0], c[1] }, box);
}

bool CellShape::meetsInSpace(const double* corner, const Box3& box) const
{
  const auto point = [corner](int i) {
    return Point3{ corner[3 * i], corner[3 * i + 1], corner[3 * i + 2] };
  };
  // A triangle in space is treated as a flat tetrahedron.
  return tetrahedronMeetsBox(point(0), point(1), point(2), point(this->Cells.Corners - 1), box);
}

} // namespace tipp

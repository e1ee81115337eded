// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellShape_h
#define tippCellShape_h

#include "Partition/ClassifyCells.h"
#include "Predicates/CellBox.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <cmath>

namespace tipp
{

/// Bounds of cells and exact tests of them against boxes, in the plane or in space.
class VTKTIPPACCELERATORS_EXPORT CellShape
{
public:
  /// Throws AcceleratorError if the tiling's and the cells' dimensions do not go together.
  CellShape(const CellsView& cells, int dimension);

  const double* cell(std::size_t index) const
  {
    return this->Cells.Coordinates + index * this->Stride;
  }

  /// The cell's bounding box; false if a coordinate is not finite.
  bool bounds(const double* corner, Box3& box) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.Min[axis] = 0.0;
      box.Max[axis] = 0.0;
    }
    const auto components = static_cast<std::size_t>(this->Cells.Dimension);
    double check = 0.0;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(this->Dimension); ++axis)
    {
      double low = corner[axis];
      double high = corner[axis];
      for (std::size_t i = axis; i < this->Stride; i += components)
      {
        low = std::min(low, corner[i]);
        high = std::max(high, corner[i]);
        // Zero, or NaN from the first value that is not finite on.
        check += corner[i] * 0.0;
      }
      box.Min[axis] = low;
      box.Max[axis] = high;
    }
    return check == 0.0;
  }

  /// Whether the cell and the box share a point. Exact.
  bool meets(const double* corner, const Box3& box) const
  {
    return this->Dimension == 2 ? this->meetsInPlane(corner, box) : this->meetsInSpace(corner, box);
  }

private:
  bool meetsInPlane(const double* corner, const Box3& box) const;
  bool meetsInSpace(const double* corner, const Box3& box) const;

  CellsView Cells;
  int Dimension;
  std::size_t Stride; // doubles a cell
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellShape_h
#define tippCellShape_h

#include "OpenCL/Devices.h"
#include "Partition/ClassifyCells.h"
#include "Predicates/CellBox.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace tipp
{

/// Bounds of cells, and exact tests of cells against boxes, in 2D or 3D.
class VTKTIPPACCELERATORS_EXPORT CellShape
{
public:
  /// Throws AcceleratorError if the dimensions of tiling and cells do not match.
  CellShape(const CellsView& cells, int dimension);

  const double* cell(std::size_t index) const
  {
    return this->Cells.Coordinates + index * this->Stride;
  }

  /// Computes the cell's bounding box; returns false if a coordinate is not finite.
  bool bounds(const double* corner, Box3& box) const
  {
    if (this->Dimension == 3)
    {
      return this->Cells.Corners == 4 ? boundsOf<3, 3, 4>(corner, box)
                                      : boundsOf<3, 3, 3>(corner, box);
    }
    return this->Cells.Dimension == 2 ? boundsOf<2, 2, 3>(corner, box)
                                      : boundsOf<2, 3, 3>(corner, box);
  }

  /// Whether the cell and the box share a point, decided exactly.
  bool meets(const double* corner, const Box3& box) const
  {
    return this->Dimension == 2 ? this->meetsInPlane(corner, box) : this->meetsInSpace(corner, box);
  }

private:
  template <std::size_t Dimension, std::size_t Components, std::size_t Corners>
  static bool boundsOf(const double* corner, Box3& box)
  {
    box.Min[2] = 0.0;
    box.Max[2] = 0.0;
    double check = 0.0;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
    {
      double low = corner[axis];
      double high = corner[axis];
      for (std::size_t i = 0; i < Corners; ++i)
      {
        const double value = corner[i * Components + axis];
        low = value < low ? value : low;
        high = value > high ? value : high;
        // Zero, or NaN if any value is not finite.
        check += value * 0.0;
      }
      box.Min[axis] = low;
      box.Max[axis] = high;
    }
    return check == 0.0;
  }

  bool meetsInPlane(const double* corner, const Box3& box) const;
  bool meetsInSpace(const double* corner, const Box3& box) const;

  CellsView Cells;
  int Dimension;
  std::size_t Stride; // doubles per cell
};

/// Throws the error for the first invalid cell: a coordinate is not finite, or the cell lies
/// outside the domain.
[[noreturn]] void failForCell(const CellShape& shape, std::size_t cell);

/// classifyCells() on OpenMP threads.
Membership classifyOnThreads(
  const CellsView& cells, const BoxTiling& tiling, const CellShape& shape, int threads);

/// classifyCells() on an OpenCL device, in pieces that need at most `memory` bytes of it besides
/// the tiling (0: half of its memory). What the device leaves undecided is decided on the CPU.
/// Returns nullopt if the choice is OpenMP. Throws AcceleratorError.
std::optional<Membership> classifyOnDevice(const DeviceChoice& choice, const CellsView& cells,
  const BoxTiling& tiling, const CellShape& shape, std::uint64_t memory);

} // namespace tipp

#endif

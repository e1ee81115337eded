// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClassifyCells_h
#define tippClassifyCells_h

#include "OpenCL/Devices.h"
#include "Partition/BoxTiling.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// A view of cells as their corners' coordinates, cell after cell and corner after corner. Not
/// owned.
struct CellsView
{
  int Dimension;             ///< coordinates per corner: 2 or 3
  int Corners;               ///< per cell: 3 for triangles, 4 for tetrahedra (only in 3D)
  const double* Coordinates; ///< Dimension numbers per corner, Corners per cell
  std::size_t Cells;         ///< number of cells
};

/// For each cell the partitions that it shares a point with: the one of lowest index owns it, the
/// others borrow it.
struct Membership
{
  std::vector<std::int32_t> Owner; ///< per cell
  /// per cell, and the end: start of its range in Borrowers
  std::vector<std::int64_t> BorrowerStart;
  std::vector<std::int32_t> Borrowers; ///< ascending for each cell
};

/// Options of classifyCells().
struct ClassifyOptions
{
  DeviceChoice Device;
  /// OpenMP threads; 0 for defaultThreads().
  int Threads = 0;
  /// The limit of device memory in bytes; 0 for half of the device's memory. Larger inputs are
  /// processed in batches.
  std::uint64_t DeviceMemory = 0;
};

/// Finds each cell's partitions (Algorithm 5 of the dissertation). Partitions and cells are closed
/// sets: touching counts as meeting. Decided exactly, so the result does not depend on the device,
/// the number of threads or the memory. A 2D tiling uses only x and y of triangles in space.
///
/// Throws AcceleratorError if a coordinate is not finite, a cell lies outside the tiling's domain,
/// or the device is missing or fails.
VTKTIPPACCELERATORS_EXPORT Membership classifyCells(
  const CellsView& cells, const BoxTiling& tiling, const ClassifyOptions& options = {});

/// Bounds of cells, and exact tests of cells against boxes, in 2D or 3D.
class VTKTIPPACCELERATORS_EXPORT CellShape
{
public:
  /// Throws AcceleratorError if the dimensions of tiling and cells do not match.
  CellShape(const CellsView& cells, int dimension);

  const CellsView& cells() const { return this->Cells; }
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
  bool meets(const double* corner, const Box3& box) const;

private:
  template <std::size_t Dimension, std::size_t Components, std::size_t Corners>
  static bool boundsOf(const double* corner, Box3& box)
  {
    box.Min.z = 0.0;
    box.Max.z = 0.0;
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

  CellsView Cells;
  int Dimension;
  std::size_t Stride; // doubles per cell
};

/// Throws the error for the first invalid cell: a coordinate is not finite, or the cell lies
/// outside the domain.
[[noreturn]] void failForCell(const CellShape& shape, std::size_t cell);

/// Adds a partition of a cell, in ascending order. The first becomes its owner; `owner` must start
/// at -1.
inline void addPartition(std::int32_t id, std::int32_t& owner, std::vector<std::int32_t>& borrowers)
{
  if (owner < 0)
  {
    owner = id;
  }
  else
  {
    borrowers.push_back(id);
  }
}

/// classifyCells() on an OpenCL device, in pieces that need at most options.DeviceMemory besides
/// the tiling. What the device leaves undecided is decided on the CPU. Returns nullopt if the
/// choice is OpenMP. Throws AcceleratorError.
std::optional<Membership> classifyOnDevice(
  const CellShape& shape, const BoxTiling& tiling, const ClassifyOptions& options);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClassifyCells_h
#define tippClassifyCells_h

#include "OpenCL/Devices.h"
#include "Partition/BoxTiling.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A view of cells as their corners' coordinates, cell after cell and corner after corner. Not
/// owned.
struct CellsView
{
  int Dimension; ///< coordinates per corner: 2 or 3
  int Corners;   ///< per cell: 3 for triangles, 4 for tetrahedra (only in 3D)
  const double* Coordinates;
  std::size_t Cells;
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

struct ClassifyOptions
{
  DeviceChoice Device;
  /// OpenMP threads; 0 for OpenMP's default.
  int Threads = 0;
  /// Maximum number of bytes of device memory; 0 for half of it. Larger inputs are processed in
  /// pieces.
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

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClassifyCells_h
#define tippClassifyCells_h

#include "OpenCL/DeviceChoice.h"
#include "Partition/BoxTiling.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Cells with their corners' coordinates, cell after cell and corner after corner.
struct CellsView
{
  int Dimension; ///< coordinates of a corner: 2 or 3
  int Corners;   ///< of a cell: 3 for triangles, 4 for tetrahedra (these in 3 dimensions)
  const double* Coordinates;
  std::size_t Cells;
};

/// For each cell the partitions that it shares a point with: the lowest one owns it, the others
/// borrow it.
struct Membership
{
  std::vector<std::int32_t> Owner;         ///< by cell
  std::vector<std::int64_t> BorrowerStart; ///< by cell, and the end: its part of Borrowers
  std::vector<std::int32_t> Borrowers;     ///< rising within a cell
};

struct ClassifyOptions
{
  DeviceChoice Device;
  /// OpenMP threads; 0 for as many as OpenMP would take.
  int Threads = 0;
  /// Bytes of the device's memory to use at most; 0 for half of it. Larger inputs are cut.
  std::uint64_t DeviceMemory = 0;
};

/// Finds each cell's partitions (algorithm 5 of the dissertation). A partition is a closed box, and
/// so is a cell a closed set: touching counts. Decided exactly, so that the result does not depend
/// on the device, the number of threads or the memory. A tiling of the plane takes triangles in
/// space by their x and y.
///
/// Throws AcceleratorError if a coordinate is not finite, a cell lies outside the tiling's domain,
/// or the device is missing or fails.
VTKTIPPACCELERATORS_EXPORT Membership classifyCells(
  const CellsView& cells, const BoxTiling& tiling, const ClassifyOptions& options = {});

} // namespace tipp

#endif

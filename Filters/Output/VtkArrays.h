// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtkArrays_h
#define tippVtkArrays_h

#include "Arrays/Buffer.h"
#include "Output/RunStatistics.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <limits>
#include <string>

class vtkCellArray;
class vtkIdTypeArray;
class vtkPolyData;
class vtkTable;
class vtkUnsignedCharArray;

namespace tipp
{

/// Returns cells of `cellSize` point ids each that take over the memory of `ids`. 32-bit ids give
/// 32-bit cells unless the last offset exceeds `largestOffset32`: VTK stores ids and offsets in one
/// type, so they are then copied to 64 bits.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int32_t> ids,
  int cellSize, std::int64_t largestOffset32 = std::numeric_limits<std::int32_t>::max());
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(
  Buffer<std::int64_t> ids, int cellSize);

///@{
/// Returns a named array of tuples that takes over the memory of its values.
vtkSmartPointer<vtkIdTypeArray> takeArray(
  const std::string& name, Buffer<std::int64_t> values, int components);
vtkSmartPointer<vtkUnsignedCharArray> takeArray(
  const std::string& name, Buffer<unsigned char> values, int components);
///@}

/// Fills the empty table: the rows of the statistics' table, and all else as field data. The
/// documentation of vtkTIPPDelaunay2D and vtkTIPPOutOfCoreDelaunay2D lists the arrays.
void fillStatisticsTable(const RunStatistics& statistics, vtkTable* table);

/// Adds the duplicates and rejected points found on this rank as field data, by global ids.
void addAccounts(const DistributedTriangulation& mine, vtkPolyData* output);

} // namespace tipp

#endif

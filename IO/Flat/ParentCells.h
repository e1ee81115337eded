// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParentCells_h
#define tippParentCells_h

#include "Flat/FlattenDataSet.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Sets the cell data of a flattened data set. `arrays`: those of the data set. `parents`: the cell
/// of each simplex in the data set, which become the array "vtkOriginalCellIds" unless the data set
/// has one from an earlier cut; not used if the cells are unchanged.
void setCellData(
  Flattened& flattened, std::vector<FlatArray> arrays, std::vector<std::int64_t> parents);

} // namespace tipp

#endif

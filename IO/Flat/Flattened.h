// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattened_h
#define tippFlattened_h

#include "Flat/FlatMesh.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tipp
{

/// A data set as a flat mesh: the result of flattenDataSet() and flattenImage().
struct Flattened
{
  FlatContent Content; ///< refers to the data set, which must outlive it
  /// Number of cells that were cut into several, by VTK's class name.
  std::map<std::string, std::int64_t> Cut;
  /// Number of cells left out, by VTK's class name: cells of a lower dimension than others (points,
  /// lines, and triangles if there are tetrahedra), and empty cells.
  std::map<std::string, std::int64_t> LeftOut;
  std::int64_t GhostCells = 0; ///< number of ghost cells left out, which another piece owns
  std::vector<std::string> ArraysLeftOut; ///< arrays that are not numeric

  bool areCellsChanged() const
  {
    return !this->Cut.empty() || !this->LeftOut.empty() || this->GhostCells > 0;
  }
};

/// Sets the cell data of a flattened data set. `arrays`: the data set's arrays. `parents`: the cell
/// of each simplex in the data set, which become the array "vtkOriginalCellIds" unless the data set
/// has one from an earlier cut; not used if the cells are unchanged.
void setCellData(
  Flattened& flattened, std::vector<FlatArray> arrays, std::vector<std::int64_t> parents);

} // namespace tipp

#endif

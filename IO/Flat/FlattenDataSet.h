// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattenDataSet_h
#define tippFlattenDataSet_h

#include "Flat/WriteFlatMesh.h"
#include "vtkTIPPIOModule.h"

#include <map>
#include <string>
#include <vector>

class vtkDataSet;

namespace tipp
{

/// The result of flattenDataSet().
struct Flattened
{
  FlatContent Content;                         ///< refers to the data set, which must outlive it
  std::map<std::string, std::int64_t> Cut;     ///< as in Simplices
  std::map<std::string, std::int64_t> LeftOut; ///< as in Simplices
  std::vector<std::string> ArraysLeftOut;      ///< arrays that are not numeric
};

/// Converts a data set's simplices, points (float32 if the input's are, else float64) and numeric
/// arrays. Ghost cells and vtkGhostType are left out. If cells are cut or left out, the cell data
/// "vtkOriginalCellIds" hold the index of each simplex's cell in `data`. Throws IOError as
/// simplicesOf does.
VTKTIPPIO_EXPORT Flattened flattenDataSet(vtkDataSet* data, const std::string& path);

} // namespace tipp

#endif

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

/// What flattening a data set has made of it.
struct Flattened
{
  FlatContent Content;                         ///< refers to the data set, which must outlive it
  std::map<std::string, std::int64_t> Cut;     ///< as in Simplices
  std::map<std::string, std::int64_t> LeftOut; ///< as in Simplices
  std::vector<std::string> ArraysLeftOut;      ///< those that hold no numbers
};

/// The data set's simplices, points (float32 where they are, else float64) and arrays of numbers
/// but for vtkGhostType, for ghost cells are left out.
/// Where cells are cut or left out, the cell data "vtkOriginalCellIds" tell the cell that each
/// simplex comes from. Throws IOError as simplicesOf does.
VTKTIPPIO_EXPORT Flattened flattenDataSet(vtkDataSet* data, const std::string& path);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleShare_h
#define tippResampleShare_h

#include "Partitioning/Ranks.h"

#include <string>
#include <vector>

class vtkDataSet;

namespace tipp
{

/// If every rank has read the whole mesh: hides the cells of the other ranks' shares.
void hideOtherShares(vtkDataSet* mesh, const Ranks& ranks);

/// For each name what it is in the mesh of all ranks: 'p' for a point array, 'c' for a cell array,
/// ' ' for neither. Ranks without a cell may lack arrays that others have. Collective.
std::string associationsOf(
  const std::vector<std::string>& arrays, vtkDataSet* mesh, const Ranks& ranks);

} // namespace tipp

#endif

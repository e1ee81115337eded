// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleShare_h
#define tippResampleShare_h

#include "Partitioning/Ranks.h"

#include <string>
#include <vector>

class vtkDataSet;

namespace tipp
{

/// Of a mesh that every rank has read as a whole, hides the cells of the other ranks' shares.
void hideOtherShares(vtkDataSet* mesh, const Ranks& ranks);

/// What each name is in the mesh of all ranks: 'p' for an array of the points, 'c' of the cells, '
/// ' for none. Ranks without a cell may lack arrays that others have. A call of all ranks.
std::string associationsOf(
  const std::vector<std::string>& arrays, vtkDataSet* mesh, const Ranks& ranks);

} // namespace tipp

#endif

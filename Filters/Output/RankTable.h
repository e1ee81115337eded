// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankTable_h
#define tippRankTable_h

#include "Distributed/DistributedTriangulation.h"

class vtkPolyData;
class vtkTable;

namespace tipp
{

/// Fills the empty table; vtkTIPPDelaunay2D's documentation lists the columns and arrays.
void fillRankTable(const DistributedTriangulation& mine, vtkTable* table);

/// Adds the duplicates and rejected points found on this rank as field data, by global ids.
void addAccounts(const DistributedTriangulation& mine, vtkPolyData* output);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStatisticsTable_h
#define tippStatisticsTable_h

#include "Output/RunStatistics.h"

class vtkPolyData;
class vtkTable;

namespace tipp
{

/// Fills the empty table: the rows of the statistics' table, and all else as field data. The
/// documentation of vtkTIPPDelaunay2D and vtkTIPPOutOfCoreDelaunay2D lists the arrays.
void fillStatisticsTable(const RunStatistics& statistics, vtkTable* table);

/// Adds the duplicates and rejected points found on this rank as field data, by global ids.
void addAccounts(const DistributedTriangulation& mine, vtkPolyData* output);

} // namespace tipp

#endif

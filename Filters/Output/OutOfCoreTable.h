// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTable_h
#define tippOutOfCoreTable_h

#include "OutOfCore/OutOfCoreTriangulation.h"

class vtkTable;

namespace tipp
{

/// Fills the empty table: a row for each phase, and the run's totals as field data.
/// vtkTIPPOutOfCoreDelaunay2D's documentation lists the columns and arrays.
void fillOutOfCoreTable(const OutOfCoreStatistics& statistics, bool isCounted, vtkTable* table);

} // namespace tipp

#endif

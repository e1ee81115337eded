// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStatisticsTable_h
#define tippStatisticsTable_h

#include "Triangulation/Triangulate.h"

class vtkTable;

namespace tipp
{

/// Fills the empty table: a row for each stage, and the run's totals and phases as field data.
/// vtkTIPPDelaunay2D's documentation lists the columns and arrays.
void fillStatisticsTable(
  const Triangulation& triangulation, std::int64_t points, std::int64_t triangles, vtkTable* table);

} // namespace tipp

#endif

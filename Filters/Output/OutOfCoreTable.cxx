// SPDX-License-Identifier: BSD-3-Clause
#include "Output/OutOfCoreTable.h"

#include "Output/TableArrays.h"

#include "vtkDoubleArray.h"
#include "vtkStringArray.h"
#include "vtkTypeUInt64Array.h"

namespace tipp
{

void fillOutOfCoreTable(const OutOfCoreStatistics& statistics, bool isCounted, vtkTable* table)
{
  using Phase = OutOfCoreStatistics::Phase;
  table->AddColumn(arrayOf<vtkStringArray>(
    "Phase", statistics.Phases, [](const Phase& phase) { return phase.Name; }));
  table->AddColumn(arrayOf<vtkDoubleArray>(
    "Seconds", statistics.Phases, [](const Phase& phase) { return phase.Seconds; }));
  vtkFieldData* const totals = table->GetFieldData();
  addTotal("Points", statistics.Points, totals);
  addTotal("Triangles", statistics.Triangles, totals);
  addTotal("DuplicatePoints", statistics.Duplicates, totals);
  addTotal("RejectedPoints", statistics.Rejected, totals);
  addTotal("Pieces", statistics.Pieces, totals);
  addTotal("Partitions", statistics.Partitions, totals);
  addTotal("WorkerVertices", statistics.WorkerVertices, totals);
  addTotal("BoundaryBytes", std::int64_t(statistics.BoundaryBytes), totals);
  addTotal("SpilledBytes", std::int64_t(statistics.SpilledBytes), totals);
  addTotal("MeshBytes", std::int64_t(statistics.MeshBytes), totals);
  addTotal("Threads", statistics.Threads, totals);
  addTotal("Resumed", statistics.Resumed ? 1 : 0, totals);
  if (isCounted)
  {
    totals->AddArray(arrayOf<vtkTypeUInt64Array>("TriangleSum",
      std::vector<std::uint64_t>{ statistics.TriangleSum },
      [](std::uint64_t sum) { return vtkTypeUInt64(sum); }));
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Output/StatisticsTable.h"

#include "Output/TableArrays.h"

#include "vtkDoubleArray.h"
#include "vtkStringArray.h"

namespace tipp
{

namespace
{

void addPhases(const std::vector<TriangulationStatistics::Phase>& phases, vtkFieldData* totals)
{
  using Phase = TriangulationStatistics::Phase;
  totals->AddArray(
    arrayOf<vtkStringArray>("PhaseName", phases, [](const Phase& p) { return p.Name; }));
  totals->AddArray(
    arrayOf<vtkDoubleArray>("PhaseSeconds", phases, [](const Phase& p) { return p.Seconds; }));
}

} // namespace

void fillStatisticsTable(
  const Triangulation& triangulation, std::int64_t points, std::int64_t triangles, vtkTable* table)
{
  const TriangulationStatistics& statistics = triangulation.Statistics;
  addStages(statistics.Stages, table);
  vtkFieldData* totals = table->GetFieldData();
  addTotal("Points", points, totals);
  addTotal("Triangles", triangles, totals);
  addTotal("DuplicatePoints", std::int64_t(triangulation.Duplicates.size()), totals);
  addTotal("RejectedPoints", std::int64_t(triangulation.Rejected.size()), totals);
  addTotal("Partitions", statistics.Partitions, totals);
  addTotal("InitialPoints", statistics.InitialPoints, totals);
  addTotal("WorkerVertices", statistics.WorkerVertices, totals);
  addTotal("Threads", statistics.Threads, totals);
  addPhases(statistics.Phases, totals);
}

} // namespace tipp

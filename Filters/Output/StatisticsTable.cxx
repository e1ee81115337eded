// SPDX-License-Identifier: BSD-3-Clause
#include "Output/StatisticsTable.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

namespace tipp
{

namespace
{

void addStages(const std::vector<TriangulationStatistics::Stage>& stages, vtkTable* table)
{
  vtkNew<vtkIdTypeArray> stage;
  vtkNew<vtkIdTypeArray> active;
  vtkNew<vtkIdTypeArray> triangles;
  stage->SetName("Stage");
  active->SetName("ActivePartitions");
  triangles->SetName("MeshTriangles");
  for (std::size_t i = 0; i < stages.size(); ++i)
  {
    stage->InsertNextValue(vtkIdType(i));
    active->InsertNextValue(stages[i].ActivePartitions);
    triangles->InsertNextValue(stages[i].MeshTriangles);
  }
  table->AddColumn(stage);
  table->AddColumn(active);
  table->AddColumn(triangles);
}

void addTotal(const char* name, std::int64_t value, vtkFieldData* totals)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  totals->AddArray(array);
}

void addPhases(const std::vector<TriangulationStatistics::Phase>& phases, vtkFieldData* totals)
{
  vtkNew<vtkStringArray> names;
  vtkNew<vtkDoubleArray> seconds;
  names->SetName("PhaseName");
  seconds->SetName("PhaseSeconds");
  for (const TriangulationStatistics::Phase& phase : phases)
  {
    names->InsertNextValue(phase.Name);
    seconds->InsertNextValue(phase.Seconds);
  }
  totals->AddArray(names);
  totals->AddArray(seconds);
}

} // namespace

void fillStatisticsTable(const Triangulation& triangulation,
  std::int64_t points,
  std::int64_t triangles,
  vtkTable* table)
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

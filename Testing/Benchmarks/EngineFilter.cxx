// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"
#include "VtkData.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTIPPDelaunay2D.h>

#include <chrono>

namespace tipp
{
namespace benchmark
{

Run runFilter(const std::vector<double>& xy, const TriangulationOptions& options)
{
  const vtkSmartPointer<vtkPolyData> input = toPolyData(xy);
  vtkNew<vtkTIPPDelaunay2D> filter;
  filter->SetInputData(input);
  filter->SetNumberOfPartitions(options.Columns, options.Rows);
  filter->SetInitialPointsPerPartition(options.InitialPointsPerPartition);
  filter->SetSchedule(
    options.Order == Schedule::Stages ? vtkTIPPDelaunay2D::STAGES : vtkTIPPDelaunay2D::DYNAMIC);
  filter->SetNumberOfThreads(options.Threads);
  Run run;
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  sumUp(filter->GetOutput(), run);
  return run;
}

} // namespace benchmark
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"
#include "VtkData.h"

#include <vtkDelaunay2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <chrono>

namespace tipp
{
namespace benchmark
{

Run runVtk(const std::vector<double>& xy)
{
  const vtkSmartPointer<vtkPolyData> input = toPolyData(xy);
  vtkNew<vtkDelaunay2D> filter;
  filter->SetInputData(input);
  Run run;
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  sumUp(filter->GetOutput(), run);
  return run;
}

} // namespace benchmark
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"

#include <vtkCellArray.h>
#include <vtkDelaunay2D.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <chrono>

namespace tipp
{
namespace benchmark
{
namespace
{

void fill(vtkPoints* points, const std::vector<double>& xy)
{
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vtkIdType(xy.size() / 2));
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    points->SetPoint(vtkIdType(i / 2), xy[i], xy[i + 1], 0);
  }
}

void sumUp(vtkPolyData* mesh, Run& run)
{
  TriangleSum sum;
  vtkIdType count;
  const vtkIdType* ids;
  for (vtkIdType t = 0; t < mesh->GetNumberOfPolys(); ++t)
  {
    mesh->GetPolys()->GetCellAtId(t, count, ids);
    double p[3][3];
    for (int i = 0; i < 3; ++i)
    {
      mesh->GetPoint(ids[i], p[i]);
    }
    sum.add(p[0], p[1], p[2]);
  }
  run.Triangles = mesh->GetNumberOfPolys();
  run.Checksum = sum.value();
}

} // namespace

Run runVtk(const std::vector<double>& xy)
{
  vtkNew<vtkPoints> points;
  fill(points, xy);
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
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

// SPDX-License-Identifier: BSD-3-Clause
#include "VtkData.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace tipp
{
namespace benchmark
{

vtkSmartPointer<vtkPolyData> toPolyData(const std::vector<double>& xy)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vtkIdType(xy.size() / 2));
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    points->SetPoint(vtkIdType(i / 2), xy[i], xy[i + 1], 0);
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

void sumUp(vtkPolyData* mesh, Run& run)
{
  TriangleSum sum;
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < mesh->GetNumberOfPolys(); ++t)
  {
    mesh->GetPolys()->GetCellAtId(t, ids);
    double p[3][3];
    for (int i = 0; i < 3; ++i)
    {
      mesh->GetPoint(ids->GetId(i), p[i]);
    }
    sum.add(p[0], p[1], p[2]);
  }
  run.Triangles = mesh->GetNumberOfPolys();
  run.Checksum = sum.value();
}

} // namespace benchmark
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
// Triangulates random points and counts the triangles.
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTIPPDelaunay2D.h>

#include <cstdlib>
#include <iostream>

int main()
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < 100000; ++i)
  {
    const double x = random->GetNextValue();
    const double y = random->GetNextValue();
    points->InsertNextPoint(x, y, 0.0);
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);

  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->Update();

  const vtkIdType triangles = delaunay->GetOutput()->GetNumberOfPolys();
  std::cout << triangles << " triangles\n";
  return triangles > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

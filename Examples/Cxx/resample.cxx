// SPDX-License-Identifier: BSD-3-Clause
// Samples a surface of scattered points on a grid and checks its middle.
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMinimalStandardRandomSequence.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRangeResampleFilter.h>
#include <vtkTIPPDelaunay2D.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

int main()
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> height;
  height->SetName("height");
  for (int i = 0; i < 10000; ++i)
  {
    const double x = random->GetNextValue();
    const double y = random->GetNextValue();
    points->InsertNextPoint(x, y, 0.0);
    height->InsertNextValue(3 * x - y);
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  input->GetPointData()->AddArray(height);

  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  vtkNew<vtkRangeResampleFilter> resample;
  resample->SetInputConnection(delaunay->GetOutputPort());
  resample->UseInputBoundsOff();
  resample->SetSamplingBounds(0.25, 0.75, 0.25, 0.75, 0, 0);
  resample->SetSamplingDimensions(101, 101, 1);
  resample->Update();

  vtkImageData* image = resample->GetOutput();
  double middle[3] = { 0.5, 0.5, 0 };
  const double value =
    image->GetPointData()->GetArray("height")->GetTuple1(image->FindPoint(middle));
  std::cout << "height " << value << " in the middle of " << image->GetNumberOfPoints()
            << " samples\n";
  return std::fabs(value - 1) < 1e-12 ? EXIT_SUCCESS : EXIT_FAILURE;
}

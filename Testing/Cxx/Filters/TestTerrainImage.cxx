// SPDX-License-Identifier: BSD-3-Clause
// Renders a triangulated terrain from above with light, or with --raster its shaded raster, and
// compares the picture with a baseline. Arguments: [--raster] [FILE] -V BASELINE -T FOLDER. FILE
// has the number of points and then lines 'x y z'. Without it, the terrain is a formula at
// scattered points. If FILE does not exist, the exit code is 125.
#include "vtkTIPPDelaunay2D.h"
#include "vtkTIPPPointsToImage.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkElevationFilter.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkImageSliceMapper.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTesting.h"

#include <cmath>
#include <fstream>
#include <iostream>
#include <string>

namespace
{

constexpr int skipped = 125;

/// The digits of i in the given base, mirrored at the decimal point: evenly scattered numbers in
/// [0, 1).
double radicalInverse(int i, int base)
{
  double result = 0;
  for (double digit = 1.0 / base; i > 0; i /= base, digit /= base)
  {
    result += digit * (i % base);
  }
  return result;
}

void analyticTerrain(vtkPoints* points)
{
  constexpr int count = 1500;
  for (int i = 1; i <= count; ++i)
  {
    const double x = radicalInverse(i, 2);
    const double y = radicalInverse(i, 3);
    const double hill = 0.3 * std::exp(-20 * (std::pow(x - 0.35, 2) + std::pow(y - 0.6, 2)));
    points->InsertNextPoint(x, y, hill + 0.04 * std::sin(9 * x) * std::cos(7 * y));
  }
}

bool readTerrain(const char* path, vtkPoints* points)
{
  std::ifstream file(path);
  int count = 0;
  file >> count;
  double x, y, z;
  while (file >> x >> y >> z)
  {
    points->InsertNextPoint(x, y, z);
  }
  return count > 0 && points->GetNumberOfPoints() == count;
}

vtkSmartPointer<vtkActor> terrainActor(vtkPoints* points)
{
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  vtkNew<vtkElevationFilter> elevation;
  elevation->SetInputConnection(delaunay->GetOutputPort());
  elevation->SetLowPoint(0, 0, points->GetBounds()[4]);
  elevation->SetHighPoint(0, 0, points->GetBounds()[5]);
  vtkNew<vtkLookupTable> blueToRed;
  blueToRed->SetHueRange(0.667, 0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetLookupTable(blueToRed);
  mapper->SetInputConnection(elevation->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->BackfaceCullingOn(); // so a clockwise triangle is a hole
  constexpr vtkIdType mostWithEdges = 5000;  // with more, the picture would show only edges
  actor->GetProperty()->SetEdgeVisibility(points->GetNumberOfPoints() <= mostWithEdges);
  return actor;
}

vtkSmartPointer<vtkProp> rasterActor(vtkPoints* points)
{
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  vtkNew<vtkTIPPPointsToImage> raster;
  raster->SetInputData(input);
  raster->ClearBands();
  raster->AddBand("hillshade");
  raster->UseInputBoundsOff();
  raster->SetSamplingBounds(0.05, 0.95, 0.05, 0.95);
  raster->SetResolution(0.005);
  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputConnection(raster->GetOutputPort());
  auto slice = vtkSmartPointer<vtkImageSlice>::New();
  slice->SetMapper(mapper);
  slice->GetProperty()->SetColorWindow(255);
  slice->GetProperty()->SetColorLevel(127.5);
  slice->GetProperty()->SetInterpolationTypeToNearest();
  return slice;
}

} // namespace

int main(int argc, char* argv[])
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const bool isRaster = argc > 1 && std::string(argv[1]) == "--raster";
  if (argc < 2 || argv[1][0] == '-')
  {
    analyticTerrain(points);
  }
  else if (!std::ifstream(argv[1]))
  {
    std::cout << "Skipped: there is no file " << argv[1] << "\n";
    return skipped;
  }
  else if (!readTerrain(argv[1], points))
  {
    std::cerr << argv[1] << ": not a count and as many lines of x, y and z\n";
    return 1;
  }

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  isRaster ? renderer->AddViewProp(rasterActor(points)) : renderer->AddActor(terrainActor(points));
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(300, 300);
  window->AddRenderer(renderer);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Elevation(isRaster ? 0 : -35);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.3);
  renderer->ResetCameraClippingRange();
  window->Render();

  vtkNew<vtkTesting> test;
  test->AddArguments(argc, argv);
  test->SetRenderWindow(window);
  constexpr double largestDifference = 10;
  return test->RegressionTest(largestDifference) == vtkTesting::PASSED ? 0 : 1;
}

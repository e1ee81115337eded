// SPDX-License-Identifier: BSD-3-Clause
// Samples the maximum water level of an ADCIRC run on a grid, renders it from above, and compares
// the picture with a baseline. Arguments: MESH MAXIMUM -V BASELINE -T FOLDER. If a file does not
// exist, the exit code is 125.
#include "AdcircWater.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataSetMapper.h"
#include "vtkLookupTable.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTesting.h"

#include <exception>
#include <iostream>
#include <limits>

namespace
{

constexpr int skipped = 125;

vtkSmartPointer<vtkActor> waterActor(vtkUnstructuredGrid* mesh)
{
  vtkNew<vtkRangeResampleFilter> resample;
  resample->SetInputData(mesh);
  resample->SetSamplingDimensions(500, 500, 1);
  resample->SetNullValue(std::numeric_limits<double>::quiet_NaN());
  resample->Update();
  resample->GetOutput()->GetPointData()->SetActiveScalars("maxele");
  vtkNew<vtkLookupTable> blueToRed;
  blueToRed->SetHueRange(0.667, 0);
  blueToRed->SetNanColor(0.8, 0.8, 0.8, 1);
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputData(resample->GetOutput());
  mapper->SetLookupTable(blueToRed);
  mapper->SetScalarRange(0, 2);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

} // namespace

int main(int argc, char* argv[])
{
  for (int i = 1; i < 3; ++i)
  {
    if (argc < 3 || !std::ifstream(argv[i]))
    {
      std::cout << "Skipped: there is no file " << (argc > i ? argv[i] : "MESH or MAXIMUM") << "\n";
      return skipped;
    }
  }
  vtkSmartPointer<vtkUnstructuredGrid> mesh;
  try
  {
    mesh = gridOfAdcirc(argv[1]);
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
  const auto maximum = readMaximum(argv[2], mesh->GetNumberOfPoints());
  if (maximum->GetNumberOfValues() != mesh->GetNumberOfPoints())
  {
    std::cerr << argv[2] << ": not a value for each node of " << argv[1] << "\n";
    return 1;
  }
  mesh->GetPointData()->AddArray(maximum);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(waterActor(mesh));
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(400, 400);
  window->AddRenderer(renderer);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.4);
  window->Render();

  vtkNew<vtkTesting> test;
  test->AddArguments(argc, argv);
  test->SetRenderWindow(window);
  constexpr double largestDifference = 10;
  return test->RegressionTest(largestDifference) == vtkTesting::PASSED ? 0 : 1;
}

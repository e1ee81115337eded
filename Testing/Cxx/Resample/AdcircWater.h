// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAdcircWater_h
#define tippAdcircWater_h

#include "RangeResampleTesting.h"
#include "RealData.h"

#include <fstream>
#include <string>

/// Reads an ADCIRC file of node values with one time step for this number of nodes.
inline vtkSmartPointer<vtkDoubleArray> readMaximum(const std::string& path, vtkIdType nodes)
{
  const auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("maxele");
  std::ifstream file(path);
  std::string line;
  for (int i = 0; i < 3; ++i)
  {
    std::getline(file, line);
  }
  vtkIdType node;
  double value;
  while (array->GetNumberOfValues() < nodes && file >> node >> value)
  {
    array->InsertNextValue(value);
  }
  return array;
}

/// The ADCIRC mesh as a grid. Throws std::runtime_error if the file is not an ADCIRC mesh.
inline vtkSmartPointer<vtkUnstructuredGrid> gridOfAdcirc(const std::string& path)
{
  const tipp::test::AdcircMesh mesh = tipp::test::readAdcirc(path);
  Scene scene;
  for (std::size_t i = 0; i < mesh.Nodes.size(); i += 2)
  {
    scene.Points.insert(scene.Points.end(), { mesh.Nodes[i], mesh.Nodes[i + 1], 0 });
  }
  for (const auto& element : mesh.Elements)
  {
    scene.Ids.insert(scene.Ids.end(), element.begin(), element.end());
  }
  return gridOf(scene);
}

#endif

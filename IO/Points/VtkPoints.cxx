// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TextFile.h"
#include "Points/ReadPoints.h"
#include "Vtk/DataSets.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

void addArray(vtkDataArray* array, std::size_t points, PointTable& table)
{
  const int components = array->GetNumberOfComponents();
  const std::string name = array->GetName() ? array->GetName() : "array";
  for (int component = 0; component < components; ++component)
  {
    PointTable::Column column;
    column.Name = components == 1 ? name : name + "_" + std::to_string(component);
    column.Values.resize(points);
    for (std::size_t i = 0; i < points; ++i)
    {
      column.Values[i] = array->GetComponent(vtkIdType(i), component);
    }
    table.Columns.push_back(std::move(column));
  }
}

} // namespace

PointTable pointsOf(vtkDataSet* data)
{
  const auto count = std::size_t(data->GetNumberOfPoints());
  PointTable table;
  table.XY.resize(2 * count);
  table.Columns.push_back({ "z", std::vector<double>(count) });
  for (std::size_t i = 0; i < count; ++i)
  {
    double p[3];
    data->GetPoint(vtkIdType(i), p);
    table.XY[2 * i] = p[0];
    table.XY[2 * i + 1] = p[1];
    table.Columns[0].Values[i] = p[2];
  }
  vtkPointData* const attributes = data->GetPointData();
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    // A string array is not a vtkDataArray.
    if (vtkDataArray* const array = attributes->GetArray(i))
    {
      addArray(array, count, table);
    }
  }
  std::vector<std::string> names = table.names();
  makeDifferent(names); // an array may be called z, like the coordinate
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    table.Columns[i].Name = utf8Of(names[i]);
  }
  return table;
}

PointTable readVtkPoints(const std::string& path)
{
  return pointsOf(readDataSet(path));
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"

#include "Vtk/ReadDataSet.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

namespace tipp
{
namespace
{

using Edges = std::vector<std::array<std::int64_t, 2>>;

bool isLine(int cellType)
{
  return cellType == VTK_LINE || cellType == VTK_POLY_LINE;
}

bool isPolygon(int cellType)
{
  return cellType == VTK_POLYGON || cellType == VTK_TRIANGLE || cellType == VTK_QUAD;
}

} // namespace

ConstraintTable readVtkConstraints(const std::string& path)
{
  const auto data = readDataSet(path);
  ConstraintTable table;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    table.XY.insert(table.XY.end(), { p[0], p[1] });
    table.Height.push_back(p[2]);
  }
  Edges polygonEdges;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    const int type = data->GetCellType(c);
    if (!isLine(type) && !isPolygon(type))
    {
      continue;
    }
    data->GetCellPoints(c, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    Edges& edges = isLine(type) ? table.Edges : polygonEdges;
    for (vtkIdType i = 0; i + (isLine(type) ? 1 : 0) < count; ++i)
    {
      edges.push_back({ ids->GetId(i), ids->GetId((i + 1) % count) });
    }
  }
  table.PolygonBegin = table.Edges.size();
  table.Edges.insert(table.Edges.end(), polygonEdges.begin(), polygonEdges.end());
  return table;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"
#include "Vtk/DataSets.h"

#include "vtkCellType.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

ConstraintTable constraintsOf(vtkDataSet* data)
{
  ConstraintTable table;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    table.XY.insert(table.XY.end(), { p[0], p[1] });
    table.Height.push_back(p[2]);
  }
  std::vector<std::array<std::int64_t, 2>> polygonEdges;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    const int type = data->GetCellType(c);
    const bool isLine = type == VTK_LINE || type == VTK_POLY_LINE;
    if (!isLine && type != VTK_POLYGON && type != VTK_TRIANGLE && type != VTK_QUAD)
    {
      continue;
    }
    data->GetCellPoints(c, ids);
    const vtkIdType count = ids->GetNumberOfIds();
    auto& edges = isLine ? table.Edges : polygonEdges;
    for (vtkIdType i = 0; i + (isLine ? 1 : 0) < count; ++i)
    {
      edges.push_back({ ids->GetId(i), ids->GetId((i + 1) % count) });
    }
  }
  table.PolygonBegin = table.Edges.size();
  table.Edges.insert(table.Edges.end(), polygonEdges.begin(), polygonEdges.end());
  return table;
}

ConstraintTable readVtkConstraints(const std::string& path)
{
  return constraintsOf(readDataSet(path));
}

} // namespace tipp

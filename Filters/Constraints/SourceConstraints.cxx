// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/SourceConstraints.h"

#include "Constraints/MatchPositions.h"
#include "Projection/ProjectedPoints.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <utility>

namespace tipp
{
namespace
{

/// Appends the edges of all cells; polygons are closed.
void appendEdges(vtkCellArray* cells, vtkIdType firstCell, bool isClosed,
  const std::vector<PointId>& ids, SourceConstraints& result)
{
  const auto id = [&ids](vtkIdType point)
  { return ids.empty() ? PointId(point) : ids[std::size_t(point)]; };
  const auto iterator = vtk::TakeSmartPointer(cells->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    iterator->GetCurrentCell(count, points);
    const vtkIdType edges = isClosed ? count : count - 1;
    for (vtkIdType i = 0; i < edges; ++i)
    {
      result.Constraints.push_back({ id(points[i]), id(points[(i + 1) % count]) });
      result.Cells.push_back(firstCell + iterator->GetCurrentCellId());
    }
  }
}

/// The new points' values, if the source has any.
void appendValues(vtkPointData* from, vtkPointData* source,
  const std::vector<std::size_t>& newPoints, vtkIdType inputPoints, vtkPointData* to,
  std::size_t& lost)
{
  const vtkIdType total = inputPoints + vtkIdType(newPoints.size());
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = from->GetAbstractArray(i);
    vtkAbstractArray* const its =
      array->GetName() ? source->GetAbstractArray(array->GetName()) : nullptr;
    if (!its || its->GetNumberOfComponents() != array->GetNumberOfComponents() ||
      its->GetDataType() != array->GetDataType())
    {
      ++lost;
      continue;
    }
    const auto joined = vtk::TakeSmartPointer(array->NewInstance());
    joined->SetName(array->GetName());
    joined->SetNumberOfComponents(array->GetNumberOfComponents());
    joined->SetNumberOfTuples(total);
    joined->InsertTuples(0, inputPoints, 0, array);
    for (std::size_t p = 0; p < newPoints.size(); ++p)
    {
      joined->SetTuple(inputPoints + vtkIdType(p), vtkIdType(newPoints[p]), its);
    }
    to->AddArray(joined);
  }
}

} // namespace

SourceConstraints readConstraints(vtkPolyData* source, const std::vector<PointId>& ids)
{
  SourceConstraints result;
  const vtkIdType verts = source->GetNumberOfVerts();
  appendEdges(source->GetLines(), verts, false, ids, result);
  result.PolygonBegin = result.Constraints.size();
  appendEdges(source->GetPolys(), verts + source->GetNumberOfLines(), true, ids, result);
  return result;
}

JoinedPoints joinPoints(vtkPointSet* input, vtkPolyData* source, vtkAbstractTransform* toPlane)
{
  const ProjectedPoints inputPlane(input->GetPoints(), toPlane);
  const ProjectedPoints sourcePlane(source->GetPoints(), toPlane);
  MatchedPositions matched = matchPositions(inputPlane.view(), sourcePlane.view());
  JoinedPoints result;
  result.Ids = std::move(matched.Ids);
  const std::vector<std::size_t>& newPoints = matched.New;
  result.NewPoints = newPoints.size();
  result.Data = input;
  if (newPoints.empty())
  {
    return result;
  }
  const vtkIdType count = input->GetNumberOfPoints();
  vtkNew<vtkPoints> all;
  const bool areBothFloat = source->GetPoints()->GetDataType() == VTK_FLOAT &&
    (count == 0 || input->GetPoints()->GetDataType() == VTK_FLOAT);
  all->SetDataType(areBothFloat ? VTK_FLOAT : VTK_DOUBLE);
  all->SetNumberOfPoints(count + vtkIdType(newPoints.size()));
  if (count > 0)
  {
    all->GetData()->InsertTuples(0, count, 0, input->GetPoints()->GetData());
  }
  for (std::size_t p = 0; p < newPoints.size(); ++p)
  {
    all->SetPoint(count + vtkIdType(p), source->GetPoint(vtkIdType(newPoints[p])));
  }
  vtkNew<vtkPolyData> joined;
  joined->SetPoints(all);
  appendValues(input->GetPointData(), source->GetPointData(), newPoints, count,
    joined->GetPointData(), result.LostArrays);
  result.Data = joined;
  return result;
}

} // namespace tipp

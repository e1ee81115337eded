// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/SourceData.h"

#include "Constraints/ConstraintEdges.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/SurfaceValues.h"
#include "Pipeline/InputPoints.h"
#include "Pipeline/MeshOutput.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tipp
{

namespace
{

/// Appends the edges of all cells. Polygons are closed.
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

/// Appends the values of new points, if the source has values.
void appendValues(vtkPointData* from, vtkPointData* source,
  const std::vector<std::size_t>& newPoints, vtkIdType inputPoints, vtkPointData* to,
  std::size_t& lost)
{
  const vtkIdType total = inputPoints + vtkIdType(newPoints.size());
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = from->GetAbstractArray(i);
    vtkAbstractArray* const added =
      array->GetName() ? source->GetAbstractArray(array->GetName()) : nullptr;
    if (!added || added->GetNumberOfComponents() != array->GetNumberOfComponents() ||
      added->GetDataType() != array->GetDataType())
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
      joined->SetTuple(inputPoints + vtkIdType(p), vtkIdType(newPoints[p]), added);
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

vtkSmartPointer<vtkPoints> appendCrossings(
  vtkPoints* points, const std::vector<CrossingPoint>& crossings, bool isPlaneXY)
{
  const vtkIdType count = points->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfComponents(3);
  scalars->SetNumberOfTuples(count + vtkIdType(crossings.size()));
  scalars->InsertTuples(0, count, 0, points->GetData());
  double* const positions = scalars->GetPointer(0);
  interpolateTuples(crossings, std::size_t(count), Scalar::Float64, 3, positions);
  double* to = positions + 3 * count;
  for (const CrossingPoint& crossing : crossings)
  {
    if (isPlaneXY)
    {
      to[0] = crossing.Position.x;
      to[1] = crossing.Position.y;
    }
    to += 3;
  }
  auto extended = vtkSmartPointer<vtkPoints>::New();
  extended->SetData(scalars);
  return extended;
}

void interpolateCrossings(vtkPointData* from, vtkIdType points,
  const std::vector<CrossingPoint>& crossings, vtkPointData* to)
{
  const vtkIdType total = points + vtkIdType(crossings.size());
  to->InterpolateAllocate(from, total);
  to->SetNumberOfTuples(total);
  to->CopyData(from, 0, points, 0);
  vtkIdType next = points;
  for (const CrossingPoint& crossing : crossings)
  {
    for (int i = 0; i < to->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* const array = to->GetAbstractArray(i);
      array->InterpolateTuple(next, crossing.A, array, crossing.B, array, crossing.Fraction);
    }
    ++next;
  }
}

void addConstraintLines(const ResolvedConstraints& constraints,
  const std::vector<std::int64_t>& sourceCells, vtkPolyData* output)
{
  const std::size_t edges = constraints.Segments.size();
  Buffer<std::int64_t> ids(2 * edges);
  vtkNew<vtkIdTypeArray> numbers;
  numbers->SetName("ConstraintId");
  numbers->SetNumberOfTuples(vtkIdType(edges) + output->GetNumberOfPolys());
  numbers->FillValue(-1);
  for (std::size_t i = 0; i < edges; ++i)
  {
    const IdSegment& segment = constraints.Segments[i];
    ids[2 * i] = segment.A;
    ids[2 * i + 1] = segment.B;
    numbers->SetValue(vtkIdType(i), sourceCells[std::size_t(segment.Constraint)]);
  }
  output->SetLines(takeCells(std::move(ids), 2));
  output->GetCellData()->AddArray(numbers);
}

Bytes packDataSet(vtkPolyData* data)
{
  vtkNew<vtkCharArray> buffer;
  if (!vtkCommunicator::MarshalDataObject(data, buffer))
  {
    throw std::runtime_error("The source cannot be sent to other ranks.");
  }
  const char* const begin = buffer->GetPointer(0);
  Bytes bytes(std::size_t(buffer->GetNumberOfValues()));
  std::copy_n(begin, bytes.size(), bytes.data());
  return bytes;
}

vtkSmartPointer<vtkPolyData> unpackDataSet(const Bytes& bytes)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkCharArray> buffer;
  buffer->SetNumberOfValues(vtkIdType(bytes.size()));
  std::copy_n(bytes.data(), bytes.size(), buffer->GetPointer(0));
  if (!vtkCommunicator::UnMarshalDataObject(buffer, data))
  {
    throw std::runtime_error("A part of the source that another rank has sent cannot be read.");
  }
  return data;
}

vtkSmartPointer<vtkPolyData> copyRows(
  const std::vector<vtkSmartPointer<vtkPointSet>>& from, const std::vector<DataSetRow>& rows)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(vtkIdType(rows.size()));
  vtkPointData* const data = result->GetPointData();
  std::vector<int> indices(from.size(), -1); // in the list of arrays; -1: the set has no rows here
  for (const DataSetRow& row : rows)
  {
    indices[row.Set] = 0;
  }
  vtkDataSetAttributes::FieldList fields;
  int sets = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    if (indices[i] == 0)
    {
      fields.IntersectFieldList(from[i]->GetPointData());
      indices[i] = sets++;
    }
  }
  data->CopyGlobalIdsOff();
  if (sets > 0)
  {
    fields.CopyAllocate(data, vtkDataSetAttributes::COPYTUPLE, vtkIdType(rows.size()), 0);
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    vtkPointSet* const set = from[rows[i].Set];
    points->SetPoint(vtkIdType(i), set->GetPoint(rows[i].Row));
    fields.CopyData(indices[rows[i].Set], set->GetPointData(), rows[i].Row, data, vtkIdType(i));
  }
  result->SetPoints(points);
  return result;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/InputPoints.h"

#include "Parallel/ParallelFor.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkAbstractTransform.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkTransform.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>

namespace tipp
{
namespace
{

template <typename Coordinate>
bool viewInPlace(vtkDataArray* array, PointsView& view)
{
  auto typed = vtkAOSDataArrayTemplate<Coordinate>::FastDownCast(array);
  if (typed)
  {
    view = PointsView(typed->GetPointer(0), std::size_t(typed->GetNumberOfTuples()), 3);
  }
  return typed != nullptr;
}

bool isFinite(const double p[3])
{
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

bool isFinite(vtkPoints* points)
{
  std::atomic<bool> finite{ true };
  forIndices(points->GetNumberOfPoints(),
    [&](vtkIdType i)
    {
      double p[3];
      points->GetPoint(i, p);
      if (!isFinite(p))
      {
        finite = false;
      }
    });
  return finite;
}

vtkSmartPointer<vtkPoints> finitePoints(vtkPoints* points)
{
  auto finite = vtkSmartPointer<vtkPoints>::New();
  finite->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    if (isFinite(p))
    {
      finite->InsertNextPoint(p);
    }
  }
  return finite;
}

} // namespace

ProjectedPoints::ProjectedPoints(vtkPoints* points, vtkAbstractTransform* toPlane)
{
  if (!points || points->GetNumberOfPoints() == 0)
  {
    return;
  }
  this->Scalars = points->GetData();
  if (toPlane)
  {
    vtkNew<vtkPoints> inPlane;
    inPlane->SetDataTypeToDouble();
    toPlane->TransformPoints(points, inPlane);
    this->Scalars = inPlane->GetData();
  }
  if (viewInPlace<double>(this->Scalars, this->View) ||
    viewInPlace<float>(this->Scalars, this->View))
  {
    return;
  }
  vtkNew<vtkDoubleArray> converted;
  converted->DeepCopy(this->Scalars);
  this->Scalars = converted;
  viewInPlace<double>(this->Scalars, this->View);
}

vtkSmartPointer<vtkTransform> bestFittingPlane(vtkPoints* points)
{
  vtkSmartPointer<vtkPoints> finite = points;
  if (points && !isFinite(points))
  {
    finite = finitePoints(points);
  }
  if (!finite || finite->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  double origin[3];
  double normal[3];
  vtkPlane::ComputeBestFittingPlane(finite, origin, normal);

  const double up[3] = { 0, 0, 1 };
  double axis[3];
  vtkMath::Cross(normal, up, axis);
  const double angle = std::acos(std::clamp(vtkMath::Dot(up, normal), -1.0, 1.0));

  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->RotateWXYZ(vtkMath::DegreesFromRadians(angle), axis);
  transform->Translate(-origin[0], -origin[1], -origin[2]);
  return transform;
}

Box3 finiteBounds(vtkPoints* points)
{
  std::mutex mutex;
  Box3 bounds = Box3::empty();
  forChunks(points ? points->GetNumberOfPoints() : 0, 1 << 13, threadCount(0), {},
    [&](vtkIdType begin, vtkIdType end, int)
    {
      Box3 part = Box3::empty();
      for (vtkIdType i = begin; i < end; ++i)
      {
        double p[3];
        points->GetPoint(i, p);
        if (isFinite(p))
        {
          part.extend(Point3{ p[0], p[1], p[2] });
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      bounds.extend(part);
    });
  return bounds.isEmpty() ? Box3{} : bounds;
}

double diagonalOf(const Box3& box)
{
  return std::hypot(box.width(0), box.width(1), box.width(2));
}

vtkSmartPointer<vtkPoints> appendPoints(vtkPoints* points, const std::vector<Point3>& added)
{
  const vtkIdType count = points->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfComponents(3);
  scalars->SetNumberOfTuples(count + vtkIdType(added.size()));
  scalars->InsertTuples(0, count, 0, points->GetData());
  for (std::size_t i = 0; i < added.size(); ++i)
  {
    scalars->SetTuple(count + vtkIdType(i), &added[i].x);
  }
  auto extended = vtkSmartPointer<vtkPoints>::New();
  extended->SetData(scalars);
  return extended;
}

vtkSmartPointer<vtkPoints> appendBoundingPoints(vtkPoints* points, double offset)
{
  const Box3 bounds = finiteBounds(points);
  const Point3 center = bounds.center();
  const double radius = offset * diagonalOf(bounds);
  std::vector<Point3> circle(8);
  for (std::size_t i = 0; i < circle.size(); ++i)
  {
    const double angle = 2 * vtkMath::Pi() * double(i) / double(circle.size());
    circle[i] = { center.x + radius * std::cos(angle), center.y + radius * std::sin(angle),
      center.z };
  }
  return appendPoints(points, circle);
}

const Point3* coordinatesOf(vtkPoints* points, std::vector<Point3>& copy)
{
  if (auto* const doubles = vtkDoubleArray::SafeDownCast(points->GetData()))
  {
    return reinterpret_cast<const Point3*>(doubles->GetPointer(0));
  }
  copy.resize(std::size_t(points->GetNumberOfPoints()));
  for (std::size_t i = 0; i < copy.size(); ++i)
  {
    points->GetPoint(vtkIdType(i), &copy[i].x);
  }
  return copy.data();
}

template <typename Archive>
void serialize(Archive& archive, PointRows::Column& column)
{
  archive(column.Name, column.Type, column.Components, column.Size);
}

namespace
{

std::vector<PointRows::Column> columnsOf(vtkPointSet* input)
{
  std::vector<PointRows::Column> columns;
  vtkPointData* data = input->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const bool isOwn = array && array != data->GetGlobalIds() && array->GetName() &&
      std::string(array->GetName()) != vtkDataSetAttributes::GhostArrayName();
    if (isOwn && array->GetDataTypeSize() > 0)
    {
      const int components = array->GetNumberOfComponents();
      columns.push_back({ array->GetName(), array->GetDataType(), components,
        std::size_t(components) * std::size_t(array->GetDataTypeSize()) });
    }
  }
  return columns;
}

/// The point type and arrays of one rank, or those that all ranks with points have in common.
struct PointColumns
{
  bool HasPoints = false;
  bool HasIds = false;
  bool HasDoubles = false;
  std::vector<PointRows::Column> Columns;
};

template <typename Archive>
void serialize(Archive& archive, PointColumns& kinds)
{
  archive(kinds.HasPoints, kinds.HasIds, kinds.HasDoubles, kinds.Columns);
}

bool same(const PointRows::Column& a, const PointRows::Column& b)
{
  return a.Name == b.Name && a.Type == b.Type && a.Components == b.Components;
}

} // namespace

PointRows::PointRows(Communicator& ranks, vtkPointSet* input)
{
  const bool hasPoints = input->GetNumberOfPoints() > 0;
  vtkDataArray* ids = hasPoints ? input->GetPointData()->GetGlobalIds() : nullptr;
  PointColumns mine;
  mine.HasPoints = hasPoints;
  mine.HasIds = ids != nullptr;
  mine.HasDoubles = hasPoints && input->GetPoints()->GetDataType() != VTK_FLOAT;
  mine.Columns = hasPoints ? columnsOf(input) : std::vector<Column>();
  PointColumns agreed;
  for (const PointColumns& other : ranks.gather(mine))
  {
    if (!other.HasPoints)
    {
      continue;
    }
    std::vector<Column>& common = agreed.Columns;
    common.erase(std::remove_if(common.begin(), common.end(),
                   [&](const Column& column)
                   {
                     return std::none_of(other.Columns.begin(), other.Columns.end(),
                       [&](const Column& of) { return same(column, of); });
                   }),
      common.end());
    common = agreed.HasPoints ? common : other.Columns;
    agreed.HasIds = other.HasIds && (agreed.HasIds || !agreed.HasPoints);
    agreed.HasDoubles = other.HasDoubles || agreed.HasDoubles;
    agreed.HasPoints = true;
  }
  agreed = ranks.broadcast(agreed);
  this->Doubles = agreed.HasDoubles;
  this->Columns = agreed.Columns;
  if (!hasPoints)
  {
    return;
  }
  this->Coordinates = input->GetPoints()->GetData();
  for (const Column& column : this->Columns)
  {
    this->Arrays.push_back(input->GetPointData()->GetArray(column.Name.c_str()));
    this->Values.push_back(static_cast<const char*>(this->Arrays.back()->GetVoidPointer(0)));
  }
  if (agreed.HasIds)
  {
    vtkNew<vtkIdTypeArray> exact; // doubles would round ids beyond 2^53
    exact->DeepCopy(ids);
    const vtkIdType* values = exact->GetPointer(0);
    this->GlobalIds.assign(values, values + exact->GetNumberOfTuples());
  }
}

void PointRows::describe(RankPointData& points) const
{
  points.GlobalIds = this->GlobalIds.empty() ? nullptr : this->GlobalIds.data();
  points.RowSize = 3 * sizeof(double);
  for (const Column& column : this->Columns)
  {
    points.RowSize += column.Size;
  }
  points.PackRow = [this](std::size_t i, char* to)
  {
    double position[3];
    this->Coordinates->GetTuple(vtkIdType(i), position);
    std::memcpy(to, position, sizeof(position));
    to += sizeof(position);
    for (std::size_t c = 0; c < this->Columns.size(); ++c)
    {
      const std::size_t size = this->Columns[c].Size;
      std::memcpy(to, this->Values[c] + i * size, size);
      to += size;
    }
  };
}

} // namespace tipp

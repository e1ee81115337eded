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
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTransform.h"

#include <algorithm>
#include <array>
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

namespace
{

/// Passes a sum from rank to rank, each of which adds its part: add(sum). Returns it on all ranks.
/// The order of additions is that of the ranks' points, so the result does not depend on how these
/// are divided. `ranks`: null: only this process.
template <std::size_t N, typename Add>
std::array<double, N> sumInOrder(Communicator* ranks, const Add& add)
{
  constexpr MessageKind sumMessage = kindAfter(9); // follows those of runs out of core
  using Sum = std::array<double, N>;
  const bool areSeveral = ranks && ranks->size() > 1;
  Sum sum{};
  if (areSeveral && ranks->rank() > 0)
  {
    sum = unpacked<Sum>(ranks->wait(sumMessage, ranks->rank() - 1).Content);
  }
  add(sum);
  if (areSeveral && ranks->rank() + 1 < ranks->size())
  {
    ranks->post(ranks->rank() + 1, sumMessage, packed(sum));
  }
  return areSeveral ? ranks->allGather(sum).back() : sum;
}

/// Calls visit(point) for the points whose coordinates are finite.
template <typename Visit>
void forFinite(vtkPoints* points, const Visit& visit)
{
  for (vtkIdType i = 0; points && i < points->GetNumberOfPoints(); ++i)
  {
    Point3 p;
    points->GetPoint(i, &p.x);
    if (isFinite(p))
    {
      visit(p);
    }
  }
}

/// Returns the unit normal of the plane that fits points with these sums of products of deviations
/// from their centroid: xx, xy, xz, yy, yz and zz. Returns the z axis if there is no such plane.
///
/// Each row of the sums' adjugate matrix is the normal of a regression along one axis. Its diagonal
/// entry is larger the better the points determine that regression, so it is the row's weight.
Point3 normalOf(const std::array<double, 6>& sums)
{
  const auto [xx, xy, xz, yy, yz, zz] = sums;
  const double a = yy * zz - yz * yz;
  const double b = xx * zz - xz * xz;
  const double c = xx * yy - xy * xy;
  const double ab = xz * yz - xy * zz;
  const double ac = xy * yz - xz * yy;
  const double bc = xy * xz - yz * xx;
  const std::array<Point3, 3> rows = { { { a, ab, ac }, { ab, b, bc }, { ac, bc, c } } };
  Point3 normal{ 0, 0, 0 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Point3& row = rows[axis];
    const double weight = row[axis] * row[axis] * (vtkMath::Dot(&normal.x, &row.x) < 0 ? -1 : 1);
    normal = { normal.x + weight * row.x, normal.y + weight * row.y, normal.z + weight * row.z };
  }
  const double length = vtkMath::Normalize(&normal.x);
  return std::isfinite(length) && length > 0 ? normal : Point3{ 0, 0, 1 };
}

} // namespace

vtkSmartPointer<vtkTransform> bestFittingPlane(vtkPoints* points, Communicator* ranks)
{
  const std::array<double, 4> sum = sumInOrder<4>(ranks,
    [points](std::array<double, 4>& all)
    {
      forFinite(points,
        [&all](const Point3& p) {
          all = { all[0] + p.x, all[1] + p.y, all[2] + p.z, all[3] + 1 };
        });
    });
  const double count = sum[3];
  if (count == 0)
  {
    return nullptr;
  }
  constexpr double fewest = 3; // fewer points determine no plane
  const Point3 origin =
    count < fewest ? Point3{ 0, 0, 0 } : Point3{ sum[0] / count, sum[1] / count, sum[2] / count };
  std::array<double, 6> products = sumInOrder<6>(ranks,
    [&](std::array<double, 6>& all)
    {
      forFinite(points,
        [&](const Point3& p)
        {
          const Point3 r = { p.x - origin.x, p.y - origin.y, p.z - origin.z };
          all = { all[0] + r.x * r.x, all[1] + r.x * r.y, all[2] + r.x * r.z, all[3] + r.y * r.y,
            all[4] + r.y * r.z, all[5] + r.z * r.z };
        });
    });
  std::for_each(products.begin(), products.end(), [count](double& of) { of /= count; });
  const Point3 normal = count < fewest ? Point3{ 0, 0, 1 } : normalOf(products);

  const double up[3] = { 0, 0, 1 };
  double axis[3];
  vtkMath::Cross(&normal.x, up, axis);
  const double angle = std::acos(std::clamp(vtkMath::Dot(up, &normal.x), -1.0, 1.0));

  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->RotateWXYZ(vtkMath::DegreesFromRadians(angle), axis);
  transform->Translate(-origin.x, -origin.y, -origin.z);
  return transform;
}

Box3 finiteBounds(vtkPoints* points, Communicator* ranks)
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
  bounds = ranks ? ranks->boundsOfAll(bounds) : bounds;
  return bounds.isEmpty() ? Box3{} : bounds;
}

double diagonalOf(const Box3& box)
{
  return std::hypot(box.width(0), box.width(1), box.width(2));
}

double toleratedDistance(double tolerance, vtkPoints* points, Communicator* ranks)
{
  return tolerance > 0 ? tolerance * diagonalOf(finiteBounds(points, ranks)) : 0;
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

std::vector<Point3> boundingCircle(const Box3& bounds, double offset)
{
  const Point3 center = bounds.center();
  const double radius = offset * diagonalOf(bounds);
  std::vector<Point3> circle(8);
  for (std::size_t i = 0; i < circle.size(); ++i)
  {
    const double angle = 2 * vtkMath::Pi() * double(i) / double(circle.size());
    circle[i] = { center.x + radius * std::cos(angle), center.y + radius * std::sin(angle),
      center.z };
  }
  return circle;
}

vtkSmartPointer<vtkPointSet> withPointsOnLast(
  Communicator& ranks, vtkPointSet* input, const std::vector<Point3>& added)
{
  vtkSmartPointer<vtkPoints> points = input->GetPoints();
  if (ranks.rank() == ranks.size() - 1)
  {
    points = appendPoints(points ? points : vtkSmartPointer<vtkPoints>::New(), added);
  }
  auto set = vtkSmartPointer<vtkPolyData>::New();
  set->SetPoints(points);
  return set;
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

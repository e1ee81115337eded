// SPDX-License-Identifier: BSD-3-Clause
#include "ResampleSubjects.h"

#include "vtkTIPPDelaunay2D.h"

#include "Distributions/GeneratePoints.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <chrono>
#include <random>

namespace tipp
{
namespace benchmark
{

double seconds()
{
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

void addArrays(vtkPointSet* mesh)
{
  for (const char* name : { "height", "wave" })
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfValues(mesh->GetNumberOfPoints());
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      double p[3];
      mesh->GetPoint(i, p);
      array->SetValue(i, name[0] == 'h' ? p[0] - 2 * p[1] + p[2] : std::sin(30 * p[0]) * p[1]);
    }
    mesh->GetPointData()->AddArray(array);
  }
}

vtkSmartPointer<vtkPointSet> surface(const std::string& kind, vtkIdType count)
{
  std::vector<double> xy;
  if (kind == "local")
  {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    const vtkIdType side = vtkIdType(std::sqrt(double(count)));
    for (vtkIdType i = 0; i < count; ++i)
    {
      xy.push_back((double(i % side) + unit(random)) / double(side));
      xy.push_back((double(i / side) + unit(random)) / double(side));
    }
  }
  else
  {
    xy = tipp::generatePoints(
      kind == "clustered" ? tipp::Distribution::Clustered : tipp::Distribution::Uniform, count, 1);
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, xy[std::size_t(2 * i)], xy[std::size_t(2 * i + 1)], 0);
  }
  vtkNew<vtkPolyData> input;
  input->SetPoints(points);
  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(input);
  delaunay->Update();
  return delaunay->GetOutput();
}

vtkSmartPointer<vtkPointSet> volume(vtkIdType count)
{
  const int side = int(std::lround(std::cbrt(double(count))));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> offset(-0.15, 0.15);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int z = 0; z < side; ++z)
  {
    for (int y = 0; y < side; ++y)
    {
      for (int x = 0; x < side; ++x)
      {
        const auto moved = [&](int i)
        { return (i + (i == 0 || i == side - 1 ? 0 : offset(random))) / (side - 1); };
        const double px = moved(x);
        const double py = moved(y);
        points->InsertNextPoint(px, py, moved(z));
      }
    }
  }
  vtkNew<vtkIdTypeArray> ids;
  const vtkIdType strides[3] = { 1, side, vtkIdType(side) * side };
  for (vtkIdType cube = 0; cube < vtkIdType(side - 1) * (side - 1) * (side - 1); ++cube)
  {
    const vtkIdType x = cube % (side - 1);
    const vtkIdType y = cube / (side - 1) % (side - 1);
    const vtkIdType z = cube / (side - 1) / (side - 1);
    int axes[3] = { 0, 1, 2 };
    do
    {
      vtkIdType corner = x + y * strides[1] + z * strides[2];
      ids->InsertNextValue(corner);
      for (const int axis : axes)
      {
        corner += strides[axis];
        ids->InsertNextValue(corner);
      }
    } while (std::next_permutation(axes, axes + 3));
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(4, ids);
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(VTK_TETRA, cells);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> asGrid(vtkPointSet* surface)
{
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(surface->GetPoints());
  grid->SetCells(VTK_TRIANGLE, vtkPolyData::SafeDownCast(surface)->GetPolys());
  grid->GetPointData()->ShallowCopy(surface->GetPointData());
  return grid;
}

std::array<double, 6> middleOf(const double* bounds, double side)
{
  std::array<double, 6> range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double middle = (bounds[2 * axis] + bounds[2 * axis + 1]) / 2;
    const double half = (bounds[2 * axis + 1] - bounds[2 * axis]) / 2 * side;
    range[2 * axis] = middle - half;
    range[2 * axis + 1] = middle + half;
  }
  return range;
}

vtkIdType hitsOf(vtkDataSet* image)
{
  vtkDataArray* const mask = image->GetPointData()->GetArray("vtkValidPointMask");
  vtkIdType hits = 0;
  for (vtkIdType i = 0; i < mask->GetNumberOfTuples(); ++i)
  {
    hits += mask->GetComponent(i, 0) != 0;
  }
  return hits;
}

} // namespace benchmark
} // namespace tipp

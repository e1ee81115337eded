// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SamplingRange.h"

#include "Predicates/SensibleRange.h"
#include "Ranks/Communicator.h"
#include "Sampling/SimplexParts.h"
#include "Vtk/DataSets.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"

#include <stdexcept>

namespace tipp
{

namespace
{

/// The bounding box of the points that are finite along the axes.
Box3 boxOf(const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes)
{
  Box3 box = Box3::empty();
  for (vtkPointSet* mesh : meshes)
  {
    if (allPointsFinite(mesh))
    {
      // Without points VTK's bounds are from 1 to -1.
      if (mesh->GetNumberOfPoints() > 0)
      {
        box.extend(boxOfVtkBounds<3>(mesh->GetBounds()));
      }
      continue;
    }
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      Point3 p;
      mesh->GetPoint(i, &p.x);
      if (std::all_of(axes.begin(), axes.end(), [&](int axis) { return std::isfinite(p[axis]); }))
      {
        box.extend(p);
      }
    }
  }
  return box;
}

/// Whether no mesh of any rank has a three-dimensional cell. Collective.
bool areSurfaces(const std::vector<vtkPointSet*>& meshes, Communicator& ranks)
{
  return !isTrueOnAny(ranks, std::any_of(meshes.begin(), meshes.end(), hasVolumes));
}

} // namespace

void HeightRange::add(vtkPointSet* mesh)
{
  const Box3 box = boxOf({ mesh }, { 2 });
  if (box.Min.z <= box.Max.z)
  {
    this->Low = std::min(this->Low, box.Min.z);
    this->High = std::max(this->High, box.Max.z);
  }
  this->HasArray = this->HasArray || mesh->GetPointData()->HasArray(elevationName);
}

void HeightRange::gather(Communicator& ranks)
{
  std::vector<double> least = { this->Low, -this->High, this->HasArray ? 0.0 : 1.0 };
  ranks.minimum(least);
  this->Low = least[0];
  this->High = -least[1];
  this->HasArray = least[2] == 0;
}

bool haveElevation(const std::vector<vtkPointSet*>& meshes, Communicator& ranks)
{
  const bool surfaces = areSurfaces(meshes, ranks);
  HeightRange heights;
  for (vtkPointSet* mesh : meshes)
  {
    heights.add(mesh);
  }
  heights.gather(ranks);
  return surfaces && !heights.isFlat();
}

vtkSmartPointer<vtkPointSet> withElevation(vtkPointSet* mesh)
{
  if (!mesh->GetPoints() || mesh->GetPointData()->HasArray(elevationName))
  {
    return mesh;
  }
  auto copy = vtkSmartPointer<vtkPointSet>::Take(mesh->NewInstance());
  copy->ShallowCopy(mesh);
  vtkDataArray* const points = mesh->GetPoints()->GetData();
  const auto heights =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(points->GetDataType()));
  heights->SetName(elevationName);
  heights->SetNumberOfTuples(points->GetNumberOfTuples());
  heights->CopyComponent(0, points, 2);
  copy->GetPointData()->AddArray(heights);
  return copy;
}

std::vector<vtkPointSet*> meshesOf(vtkDataObject* data, int threads, const std::string& name)
{
  std::vector<vtkPointSet*> meshes;
  const auto add = [&](vtkDataObject* leaf)
  {
    vtkPointSet* const mesh = vtkPointSet::SafeDownCast(leaf);
    if (!mesh)
    {
      throw std::runtime_error(std::string("a ") + leaf->GetClassName() +
        " is no mesh with points and cells of its own: convert it to a vtkUnstructuredGrid.");
    }
    checkDataSet(mesh, name, threads);
    meshes.push_back(mesh);
  };
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    add(data);
    return meshes;
  }
  const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    add(iterator->GetCurrentDataObject());
  }
  return meshes;
}

std::array<int, 3> chosenDimensions(const Box3& bounds, const std::array<int, 3>& dimensions,
  const std::vector<vtkPointSet*>& meshes, Communicator& ranks)
{
  return std::count(dimensions.begin(), dimensions.end(), 0) > 0
    ? chosenDimensions(bounds, dimensions, areSurfaces(meshes, ranks))
    : dimensions;
}

Box3 boundsOf(const std::vector<vtkPointSet*>& meshes, Communicator& ranks)
{
  const Box3 bounds = ranks.boundsOfAll(boxOf(meshes, { 0, 1, 2 }));
  if (bounds.isEmpty())
  {
    throw std::runtime_error(
      "the input has no points with finite coordinates, so its bounds give no range: turn "
      "UseInputBounds off.");
  }
  return bounds;
}

void requireSensible(const Box3& range, const std::vector<vtkPointSet*>& meshes,
  const std::vector<int>& axes, Communicator& ranks)
{
  const bool surfaces = areSurfaces(meshes, ranks);
  const Box3 points = ranks.boundsOfAll(boxOf(meshes, surfaces ? axes : std::vector{ 0, 1, 2 }));
  requireSensible(range, points, surfaces ? axes : std::vector{ 0, 1, 2 });
}

Lattice cropped(
  const Lattice& lattice, const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes)
{
  const Box3 box = boxOf(meshes, axes);
  Lattice result = lattice;
  for (const int axis : axes)
  {
    int& first = result.Extent[2 * axis];
    int& last = result.Extent[2 * axis + 1];
    if (box.isEmpty())
    {
      last = first - 1;
      continue;
    }
    // One more step on either side covers rounding errors.
    const double delta = lattice.Delta[axis];
    const double low = std::floor((box.Min[axis] - lattice.Min[axis]) / delta) - 1;
    const double high = std::ceil((box.Max[axis] - lattice.Min[axis]) / delta) + 1;
    first = low > first ? int(std::min(low, double(last) + 1)) : first;
    last = high < last ? int(std::max(high, double(first) - 1)) : last;
  }
  return result;
}

} // namespace tipp

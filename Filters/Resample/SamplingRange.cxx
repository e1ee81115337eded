// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/SamplingRange.h"

#include "Messages/Postbox.h"
#include "Resample/SimplexParts.h"
#include "Vtk/CheckDataSet.h"

#include "vtkBoundingBox.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace tipp
{
namespace
{

/// Of the points that are finite along the axes.
vtkBoundingBox boxOf(const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes)
{
  vtkBoundingBox box;
  for (vtkPointSet* mesh : meshes)
  {
    if (allPointsFinite(mesh))
    {
      // Without points they are from 1 to -1.
      mesh->GetNumberOfPoints() > 0 ? box.AddBounds(mesh->GetBounds()) : void();
      continue;
    }
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      double p[3];
      mesh->GetPoint(i, p);
      if (std::all_of(axes.begin(), axes.end(), [&](int axis) { return std::isfinite(p[axis]); }))
      {
        box.AddPoint(p);
      }
    }
  }
  return box;
}

} // namespace

std::array<int, 3> chosenDimensions(
  const std::array<double, 6>& bounds, std::array<int, 3> dimensions, bool surfaces)
{
  const auto length = [&](std::size_t axis) { return bounds[2 * axis + 1] - bounds[2 * axis]; };
  std::optional<double> step;
  for (std::size_t axis = 0; axis < 3 && !step; ++axis)
  {
    if (dimensions[axis] > 0)
    {
      step = length(axis) / std::max(dimensions[axis] - 1, 1);
    }
  }
  if (!step)
  {
    throw std::runtime_error(
      "SamplingDimensions have no number above 0: give one along an axis at least.");
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (dimensions[axis] == 0)
    {
      const bool one =
        (axis == 2 && surfaces) || !(*step > 0); // bounds without sense are told of later
      const double steps = one ? 0 : std::max(std::round(length(axis) / *step), 0.0);
      if (!(steps < std::numeric_limits<int>::max()))
      {
        throw std::runtime_error("more than 2147483647 samples along " +
          std::string(1, "xyz"[axis]) + " would be as far apart as those of the first axis: give " +
          "the number of samples along it.");
      }
      dimensions[axis] = int(steps) + 1;
    }
  }
  return dimensions;
}

std::array<int, 3> rangeDimensions(const std::array<double, 6>& bounds,
  const std::array<int, 3>& dimensions, const std::array<double, 3>& delta)
{
  std::array<int, 3> result = dimensions;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name(1, "xyz"[axis]);
    const double low = bounds[2 * axis];
    const double high = bounds[2 * axis + 1];
    if (!std::isfinite(high - low) || low > high)
    {
      throw std::runtime_error("the range along " + name + " is from " + std::to_string(low) +
        " to " + std::to_string(high) + ": give finite bounds, the lower one first.");
    }
    if (!std::isfinite(delta[axis]) || delta[axis] < 0)
    {
      throw std::runtime_error("Delta along " + name + " is " + std::to_string(delta[axis]) +
        ": give a distance above 0, or 0 to use SamplingDimensions.");
    }
    if (delta[axis] > 0)
    {
      const double steps = std::floor((high - low) / delta[axis]);
      if (!(steps < std::numeric_limits<int>::max()))
      {
        throw std::runtime_error(
          "more than 2147483647 samples along " + name + ": give a larger Delta.");
      }
      result[axis] = int(steps) + 1;
    }
    if (result[axis] < 1)
    {
      throw std::runtime_error("SamplingDimensions along " + name + " is " +
        std::to_string(result[axis]) + ": give 1 or more.");
    }
  }
  return result;
}

Lattice rangeLattice(const std::array<double, 6>& bounds, const std::array<int, 3>& dimensions,
  const std::array<double, 3>& delta)
{
  const std::array<int, 3> counts = rangeDimensions(bounds, dimensions, delta);
  Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = bounds[2 * axis];
    const double high = bounds[2 * axis + 1];
    const double steps = counts[axis] - 1;
    lattice.Min[axis] = low;
    lattice.Extent[2 * axis + 1] = counts[axis] - 1;
    if (delta[axis] > 0)
    {
      lattice.Delta[axis] = delta[axis];
    }
    else if (counts[axis] > 1)
    {
      lattice.Delta[axis] = (high - low) / steps;
      // A rounding must not put the last sample out of the range.
      while (lattice.Delta[axis] > 0 && low + steps * lattice.Delta[axis] > high)
      {
        lattice.Delta[axis] = std::nextafter(lattice.Delta[axis], 0.0);
      }
    }
    else
    {
      lattice.Delta[axis] = high > low ? high - low : 1;
    }
  }
  return lattice;
}

std::vector<int> surfaceAxes(const std::array<int, 3>& dimensions)
{
  if (dimensions[2] == 1 || (dimensions[0] > 1 && dimensions[1] > 1))
  {
    return { 0, 1 };
  }
  return dimensions[1] == 1 ? std::vector<int>{ 0, 2 } : std::vector<int>{ 1, 2 };
}

std::vector<vtkPointSet*> meshesOf(vtkDataObject* data, int threads)
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
    checkCells(mesh, "the input", threads);
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

bool areSurfaces(const std::vector<vtkPointSet*>& meshes, Postbox& ranks)
{
  int volumes = 0;
  for (vtkPointSet* mesh : meshes)
  {
    volumes += int(hasVolumes(mesh));
  }
  std::vector<std::int64_t> all{ volumes };
  ranks.sum(all);
  return all.front() == 0;
}

std::array<double, 6> boundsOf(const std::vector<vtkPointSet*>& meshes, Postbox& ranks)
{
  vtkBoundingBox box = boxOf(meshes, { 0, 1, 2 });
  std::array<double, 6> bounds;
  box.GetBounds(bounds.data());
  ByteWriter writer;
  writer.value(bounds);
  for (const Bytes& other : ranks.gather(writer.take()))
  {
    bounds = ByteReader(other).value<std::array<double, 6>>();
    box.AddBounds(bounds.data());
  }
  box.GetBounds(bounds.data());
  writer.value(bounds);
  bounds = ByteReader(ranks.broadcast(writer.take())).value<std::array<double, 6>>();
  if (!(bounds[0] <= bounds[1]))
  {
    throw std::runtime_error(
      "the input has no points with finite coordinates, so its bounds give no range: turn "
      "UseInputBounds off.");
  }
  return bounds;
}

Lattice cropped(
  const Lattice& lattice, const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes)
{
  const vtkBoundingBox box = boxOf(meshes, axes);
  Lattice result = lattice;
  for (const int axis : axes)
  {
    int& first = result.Extent[2 * axis];
    int& last = result.Extent[2 * axis + 1];
    if (!box.IsValid())
    {
      last = first - 1;
      continue;
    }
    // A step more on either side makes up for the roundings.
    const double delta = lattice.Delta[axis];
    const double low = std::floor((box.GetBound(2 * axis) - lattice.Min[axis]) / delta) - 1;
    const double high = std::ceil((box.GetBound(2 * axis + 1) - lattice.Min[axis]) / delta) + 1;
    first = low > first ? int(std::min(low, double(last) + 1)) : first;
    last = high < last ? int(std::max(high, double(first) - 1)) : last;
  }
  return result;
}

} // namespace tipp

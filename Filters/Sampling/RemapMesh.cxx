// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/RemapMesh.h"

#include "Overlap/AddOverlaps.h"
#include "Ranks/Communicator.h"
#include "Sampling/PlainValues.h"
#include "Sampling/SampledImage.h"
#include "Vtk/CellArrays.h"
#include "Vtk/Compatibility.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// The triangles [first, last) of a mesh.
SimplexMesh partOf(const SimplexMesh& mesh, std::int64_t first, std::int64_t last)
{
  SimplexMesh part = mesh;
  part.Ids = static_cast<const char*>(mesh.Ids) +
    3 * std::size_t(first) * (mesh.Wide ? sizeof(std::int64_t) : sizeof(std::int32_t));
  part.Hidden = mesh.Hidden ? mesh.Hidden + first : nullptr;
  part.Cells = last - first;
  return part;
}

} // namespace
MeshRemapper::MeshRemapper(vtkPointSet* target, std::vector<std::string> names, int threads)
  : Target(target)
  , Names(std::move(names))
  , Threads(threads)
  , Parts(makeTriangles(target, "The target mesh", { 0, 1 }, threads))
  , Last(this->Parts.Triangles.Mesh.Cells)
{
  if (this->Parts.Triangles.Mesh.Cells == 0)
  {
    throw std::runtime_error("The target mesh has no cells with an area: give a surface.");
  }
}

MeshRemapper::~MeshRemapper() = default;

void MeshRemapper::share(const Communicator& ranks)
{
  std::tie(this->First, this->Last) = ranks.shareOf(this->Parts.Triangles.Mesh.Cells);
}

void MeshRemapper::gather(Communicator& ranks)
{
  if (!this->Sums) // no surface has an area, on no rank
  {
    return;
  }
  const std::vector<std::vector<RunningSum>> shares = ranks.gather(this->Sums->all());
  if (ranks.isFirst())
  {
    const int components = this->Sums->components();
    this->Sums = std::make_unique<OverlapSums>(this->Parts.Triangles.Mesh.Cells, components);
    std::int64_t first = 0;
    for (const std::vector<RunningSum>& share : shares)
    {
      this->Sums->set(first, share);
      first += std::int64_t(share.size()) / (components + 1);
    }
  }
}

/// Finds the arrays to average in the first part of the source.
void MeshRemapper::findArrays(vtkPointSet* source)
{
  const auto isKnown = [this](const std::string& name)
  {
    return std::any_of(this->Arrays.begin(), this->Arrays.end(),
      [&name](const Array& known) { return known.Name == name; });
  };
  const auto isWanted = [this](const std::string& name)
  {
    return this->Names.empty() ||
      std::find(this->Names.begin(), this->Names.end(), name) != this->Names.end();
  };
  for (const bool ofCells : { true, false })
  {
    vtkDataSetAttributes* const data =
      source->GetAttributes(ofCells ? vtkDataObject::CELL : vtkDataObject::POINT);
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* const array = data->GetArray(i);
      const std::string name = array && array->GetName() ? array->GetName() : "";
      if (!name.empty() && name != vtkDataSetAttributes::GhostArrayName() &&
        array != data->GetGlobalIds() && scalarOf(array->GetDataType()) && !isKnown(name) &&
        isWanted(name))
      {
        this->Arrays.push_back({ name, array->GetNumberOfComponents(), ofCells });
      }
    }
  }
  for (const std::string& name : this->Names)
  {
    if (!isKnown(name))
    {
      throw std::runtime_error(
        "The source mesh has no array of numbers '" + name + "'; name another.");
    }
  }
}

bool MeshRemapper::add(vtkPointSet* source, const Report& report)
{
  if (!this->Sums)
  {
    this->findArrays(source);
  }
  const SimplexParts parts = makeTriangles(source, "The source mesh", { 0, 1 }, this->Threads);
  if (parts.Triangles.Mesh.Cells == 0)
  {
    return true;
  }
  OverlapSource from;
  from.Mesh = parts.Triangles.Mesh;
  from.Parents = parts.Triangles.Parents.empty() ? nullptr : parts.Triangles.Parents.data();
  std::vector<PlainValues> values;
  values.reserve(this->Arrays.size()); // so that none moves, to which a field points
  for (const Array& array : this->Arrays)
  {
    vtkDataArray* const found =
      source->GetAttributes(array.OfCells ? vtkDataObject::CELL : vtkDataObject::POINT)
        ->GetArray(array.Name.c_str());
    if (!found || found->GetNumberOfComponents() != array.Components)
    {
      throw std::runtime_error("A part of the source mesh has no array '" + array.Name +
        "' with as many components as the others: leave it out.");
    }
    values.emplace_back(contiguous(found));
    from.Fields.push_back({ values.back().data(), array.Components, array.OfCells });
  }
  const SimplexMesh targets = partOf(this->Parts.Triangles.Mesh, this->First, this->Last);
  if (!this->Sums)
  {
    this->Sums = std::make_unique<OverlapSums>(targets.Cells, componentsOf(from.Fields));
  }
  return addOverlaps(targets, from, *this->Sums, this->Threads, report);
}

/// Adds the sums of each cell's triangles, and returns the covered share of each cell.
std::vector<double> MeshRemapper::sharesOfCells()
{
  const SimplexMesh& triangles = this->Parts.Triangles.Mesh;
  const std::vector<std::int64_t>& parents = this->Parts.Triangles.Parents;
  if (!this->Sums)
  {
    this->Sums = std::make_unique<OverlapSums>(triangles.Cells, 0);
  }
  if (parents.empty())
  {
    return sharesOfTriangles(triangles, *this->Sums, this->Threads);
  }
  const std::vector<double> areas = areasOfTriangles(triangles, this->Threads);
  auto sums =
    std::make_unique<OverlapSums>(this->Target->GetNumberOfCells(), this->Sums->components());
  std::vector<double> shares(std::size_t(this->Target->GetNumberOfCells()), 0);
  for (std::size_t i = 0; i < parents.size(); ++i)
  {
    for (int k = 0; k <= this->Sums->components(); ++k)
    {
      sums->of(parents[i])[k].add(this->Sums->of(std::int64_t(i))[k]);
    }
    shares[std::size_t(parents[i])] += areas[i];
  }
  this->Sums = std::move(sums);
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    shares[i] = coveredShare(this->Sums->areaOf(std::int64_t(i)), shares[i]);
  }
  return shares;
}

vtkSmartPointer<vtkPointSet> MeshRemapper::finish(double null)
{
  const std::vector<double> shares = this->sharesOfCells();
  const auto result = vtkSmartPointer<vtkPointSet>::Take(this->Target->NewInstance());
  result->CopyStructure(this->Target);
  const vtkIdType cells = this->Target->GetNumberOfCells();
  int first = 0;
  for (const Array& array : this->Arrays)
  {
    const vtkNew<vtkDoubleArray> means;
    means->SetName(array.Name.c_str());
    means->SetNumberOfComponents(array.Components);
    means->SetNumberOfTuples(cells);
    for (vtkIdType i = 0; i < cells; ++i)
    {
      for (int k = 0; k < array.Components; ++k)
      {
        means->SetTypedComponent(
          i, k, shares[std::size_t(i)] > 0 ? this->Sums->meanOf(i, first + k) : null);
      }
    }
    first += array.Components;
    result->GetCellData()->AddArray(means);
  }
  const vtkNew<vtkDoubleArray> covered;
  covered->SetName(coveredShareName);
  covered->SetNumberOfTuples(cells);
  std::copy(shares.begin(), shares.end(), covered->GetPointer(0));
  result->GetCellData()->AddArray(covered);
  this->CoveredTwice =
    std::count_if(shares.begin(), shares.end(), [](double share) { return share > 1; });
  this->Covered =
    std::count_if(shares.begin(), shares.end(), [](double share) { return share > 0; });
  return result;
}

} // namespace tipp

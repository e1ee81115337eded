// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/RemapSurface.h"

#include "Overlap/AddOverlaps.h"
#include "Ranks/Communicator.h"
#include "Sampling/SampleNames.h"

#include <algorithm>
#include <cstddef>
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

SurfaceRemapper::SurfaceRemapper(SurfacePart target, std::vector<std::string> names, int threads)
  : Target(std::move(target))
  , Names(std::move(names))
  , Threads(threads)
  , Last(this->Target.Mesh.Cells)
{
  if (this->Target.Mesh.Cells == 0)
  {
    throw std::runtime_error("The target mesh has no cells with an area: give a surface.");
  }
}

void SurfaceRemapper::share(const Communicator& ranks)
{
  std::tie(this->First, this->Last) = ranks.shareOf(this->Target.Mesh.Cells);
}

void SurfaceRemapper::gather(Communicator& ranks)
{
  if (!this->Sums) // no surface has an area, on no rank
  {
    return;
  }
  const std::vector<std::vector<RunningSum>> shares = ranks.gather(this->Sums->all());
  if (ranks.isFirst())
  {
    const int components = this->Sums->components();
    this->Sums = std::make_unique<OverlapSums>(this->Target.Mesh.Cells, components);
    std::int64_t first = 0;
    for (const std::vector<RunningSum>& share : shares)
    {
      this->Sums->set(first, share);
      first += std::int64_t(share.size()) / (components + 1);
    }
  }
}

/// Finds the arrays to average in the first part of the source.
void SurfaceRemapper::findArrays(const SurfacePart& source)
{
  this->Arrays.clear();
  const auto isKnown = [this](const std::string& name)
  {
    return std::any_of(this->Arrays.begin(), this->Arrays.end(),
      [&name](const SurfaceArray& known) { return known.Name == name; });
  };
  const auto isWanted = [this](const std::string& name)
  {
    return this->Names.empty() ||
      std::find(this->Names.begin(), this->Names.end(), name) != this->Names.end();
  };
  for (const SurfaceArray& array : source.Arrays)
  {
    if (!isKnown(array.Name) && isWanted(array.Name))
    {
      this->Arrays.push_back(array);
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

bool SurfaceRemapper::add(const SurfacePart& source, const Report& report)
{
  if (!this->Sums)
  {
    this->findArrays(source);
  }
  if (source.Mesh.Cells == 0)
  {
    return true;
  }
  OverlapSource from;
  from.Mesh = source.Mesh;
  from.Parents = source.Parents;
  for (const SurfaceArray& array : this->Arrays)
  {
    const bool isThere = std::any_of(source.Arrays.begin(), source.Arrays.end(),
      [&array](const SurfaceArray& other)
      {
        return other.Name == array.Name && other.OfCells == array.OfCells &&
          other.Components == array.Components;
      });
    if (!isThere)
    {
      throw std::runtime_error("A part of the source mesh has no array '" + array.Name +
        "' with as many components as the others: leave it out.");
    }
    from.Fields.push_back({ source.Values(array), array.Components, array.OfCells });
  }
  const SimplexMesh targets = partOf(this->Target.Mesh, this->First, this->Last);
  if (!this->Sums)
  {
    this->Sums = std::make_unique<OverlapSums>(targets.Cells, componentsOf(from.Fields));
  }
  return addOverlaps(targets, from, *this->Sums, this->Threads, report);
}

/// Adds the sums of each cell's triangles, and returns the covered share of each cell.
std::vector<double> SurfaceRemapper::sharesOfCells()
{
  const SimplexMesh& triangles = this->Target.Mesh;
  if (!this->Sums)
  {
    this->Sums = std::make_unique<OverlapSums>(triangles.Cells, 0);
  }
  if (!this->Target.Parents)
  {
    return sharesOfTriangles(triangles, *this->Sums, this->Threads);
  }
  const std::vector<double> areas = areasOfTriangles(triangles, this->Threads);
  auto sums = std::make_unique<OverlapSums>(this->Target.Cells, this->Sums->components());
  std::vector<double> shares(std::size_t(this->Target.Cells), 0);
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    const std::int64_t parent = this->Target.Parents[i];
    for (int k = 0; k <= this->Sums->components(); ++k)
    {
      sums->of(parent)[k].add(this->Sums->of(std::int64_t(i))[k]);
    }
    shares[std::size_t(parent)] += areas[i];
  }
  this->Sums = std::move(sums);
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    shares[i] = coveredShare(this->Sums->areaOf(std::int64_t(i)), shares[i]);
  }
  return shares;
}

std::vector<SurfaceMeans> SurfaceRemapper::finish(double null)
{
  std::vector<double> shares = this->sharesOfCells();
  std::vector<SurfaceMeans> all;
  int first = 0;
  for (const SurfaceArray& array : this->Arrays)
  {
    const auto components = std::size_t(array.Components);
    SurfaceMeans means{ array.Name, array.Components, {} };
    means.Values.resize(shares.size() * components);
    this->Sums->copyMeans(
      first, array.Components, shares, null, means.Values.data(), this->Threads);
    first += array.Components;
    all.push_back(std::move(means));
  }
  this->CoveredTwice =
    std::count_if(shares.begin(), shares.end(), [](double share) { return share > 1; });
  this->Covered =
    std::count_if(shares.begin(), shares.end(), [](double share) { return share > 0; });
  all.push_back({ coveredShareName, 1, std::move(shares) });
  return all;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/CompareSurfaces.h"

#include "Predicates/SensibleRange.h"

#include <cstddef>
#include <stdexcept>
#include <utility>

namespace tipp
{

SurfaceComparison::SurfaceComparison(SurfacePart first, std::array<std::string, 2> names,
  const std::optional<Box2>& bounds, int threads)
  : First(std::move(first))
  , Names(std::move(names))
  , Bounds(bounds)
  , Threads(threads)
  , Sums(this->First.Mesh, bounds, threads)
{
  if (this->First.Mesh.Cells == 0)
  {
    throw std::runtime_error(this->Names[0] + " has no cells with an area: give a surface.");
  }
  this->NotFinite[0] = this->First.NotFinite;
  this->Extents[0] = finiteBounds(this->First.Mesh, threads);
  if (bounds)
  {
    const Box3 range = { { bounds->Min.x, bounds->Min.y, 0 }, { bounds->Max.x, bounds->Max.y, 0 } };
    requireSensible(range, this->Extents[0]);
  }
}

bool SurfaceComparison::add(const SurfacePart& second, const Report& report)
{
  this->NotFinite[1] += second.NotFinite;
  if (second.Mesh.Cells == 0)
  {
    return true;
  }
  this->Extents[1].extend(finiteBounds(second.Mesh, this->Threads));
  return this->Sums.add(second.Mesh, report);
}

CutFill SurfaceComparison::result() const
{
  const CutFill result = this->Sums.result();
  if (!(result.Area > 0))
  {
    std::vector<std::string> leftOut;
    this->addLeftOut(leftOut);
    const std::string ofSecond =
      this->Extents[1].isEmpty() ? "no cells with an area" : inWords(this->Extents[1]);
    throw std::runtime_error("the surfaces have no area in common" +
      std::string(this->Bounds ? " within the bounds" : "") + ": " + this->Names[0] + " has " +
      inWords(this->Extents[0]) + ", and " + this->Names[1] + " has " + ofSecond +
      (leftOut.empty() ? "" : "; cells that are not finite are left out") +
      "; give surfaces of the same region and reference system.");
  }
  return result;
}

void SurfaceComparison::addLeftOut(std::vector<std::string>& sentences) const
{
  for (const std::size_t i : { 0, 1 })
  {
    if (this->NotFinite[i] > 0)
    {
      sentences.push_back(this->Names[i] +
        " has cells with a corner that is not finite, which are left out: " +
        std::to_string(this->NotFinite[i]) + ".");
    }
  }
}

std::vector<std::string> SurfaceComparison::warnings(const CutFill& result) const
{
  std::vector<std::string> sentences;
  this->addLeftOut(sentences);
  for (const std::size_t i : { 0, 1 })
  {
    if (result.CoveredTwice[i] > 0)
    {
      sentences.push_back(this->Names[1 - i] +
        " has cells that overlap, and each of them counts: triangles of " + this->Names[i] +
        " that they cover more than once: " + std::to_string(result.CoveredTwice[i]) + ".");
    }
  }
  return sentences;
}

} // namespace tipp

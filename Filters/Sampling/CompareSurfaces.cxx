// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/CompareSurfaces.h"

#include "Pipeline/InputPoints.h"
#include "Predicates/SensibleRange.h"

#include "vtkPointSet.h"

#include <stdexcept>

namespace tipp
{
namespace
{

SimplexParts trianglesWithHeights(vtkPointSet* mesh, const char* name, int threads)
{
  return makeTriangles(mesh, name, { 0, 1, 2 }, threads);
}

} // namespace

SurfaceComparison::SurfaceComparison(
  vtkPointSet* first, const std::optional<Box2>& bounds, int threads)
  : First(first)
  , Bounds(bounds)
  , Threads(threads)
  , Parts(trianglesWithHeights(first, "The first surface", threads))
  , Sums(this->Parts.Triangles.Mesh, bounds, threads)
{
  if (this->Parts.Triangles.Mesh.Cells == 0)
  {
    throw std::runtime_error("The first surface has no cells with an area: give a surface.");
  }
  this->NotFinite[0] = this->Parts.NotFinite;
  this->Extents[0] = finiteBounds(first->GetPoints());
  if (bounds)
  {
    const Box3 range = { { bounds->Min.x, bounds->Min.y, 0 }, { bounds->Max.x, bounds->Max.y, 0 } };
    requireSensible(range, this->Extents[0]);
  }
}

bool SurfaceComparison::add(vtkPointSet* second, const Report& report)
{
  const SimplexParts parts = trianglesWithHeights(second, "The second surface", this->Threads);
  this->NotFinite[1] += parts.NotFinite;
  if (parts.Triangles.Mesh.Cells == 0)
  {
    return true;
  }
  this->Extents[1].extend(finiteBounds(second->GetPoints()));
  return this->Sums.add(parts.Triangles.Mesh, report);
}

CutFill SurfaceComparison::result() const
{
  const CutFill result = this->Sums.result();
  if (!(result.Area > 0))
  {
    const std::string second =
      this->Extents[1].isEmpty() ? "has no cells with an area" : "has " + inWords(this->Extents[1]);
    throw std::runtime_error("The surfaces have no area in common" +
      std::string(this->Bounds ? " within the bounds" : "") + ": the first one has " +
      inWords(this->Extents[0]) + ", and the second one " + second +
      "; give surfaces of the same region and reference system.");
  }
  return result;
}

std::vector<std::string> SurfaceComparison::warnings(
  const CutFill& result, const std::string& first, const std::string& second) const
{
  std::vector<std::string> sentences;
  for (const int which : { 0, 1 })
  {
    const std::string& name = which == 0 ? first : second;
    if (this->NotFinite[which] > 0)
    {
      sentences.push_back(name +
        " has cells with a corner that is not finite, which are left out: " +
        std::to_string(this->NotFinite[which]) + ".");
    }
    if (result.CoveredTwice[which] > 0)
    {
      sentences.push_back((which == 0 ? second : first) +
        " has cells that overlap, and each of them counts: triangles of " + name +
        " that they cover more than once: " + std::to_string(result.CoveredTwice[which]) + ".");
    }
  }
  return sentences;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/SortUnique.h"
#include "Files/IOError.h"
#include "Predicates/ExactPredicates.h"
#include "Query/ForPieces.h"
#include "Query/RankAnswer.h"
#include "Query/Zones.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <type_traits>
#include <utility>

namespace tipp
{
namespace
{

/// Decides which points and cells are in a region.
class RegionTest
{
public:
  RegionTest(const ResidentMesh& mesh, const Region& region)
    : Dimension(mesh.mesh().CellSize - 1)
    , Box(region.Box)
    , IsBox(region.Polygons.empty())
    , Shape(region.Polygons, 0)
  {
    for (std::size_t axis = 0; axis < std::size_t(this->Dimension) && this->IsBox; ++axis)
    {
      if (!(this->Box[2 * axis] <= this->Box[2 * axis + 1]))
      {
        throw IOError("The box has a minimum above its maximum, or bounds that are no numbers.");
      }
    }
    if (!this->IsBox)
    {
      this->Box = boundsOf(this->Shape.bounds());
      this->Box[4] = -HUGE_VAL;
      this->Box[5] = HUGE_VAL;
    }
  }

  bool wants(const Bounds& box) const { return meets(box, this->Box, this->Dimension); }

  bool holds(const Point3& p) const
  {
    return tipp::holds(this->Box, p, this->Dimension) &&
      (this->IsBox || this->Shape.holds({ p.x, p.y }));
  }

  /// Whether a cell meets the region or, if `whole`, lies inside it. Cells without area or volume
  /// do not.
  bool has(const Point2 (&t)[3], bool whole) const
  {
    if (!this->IsBox)
    {
      const ZoneShape::Relation relation = this->Shape.relationTo(t);
      return relation == ZoneShape::Relation::Inside ||
        (!whole && relation != ZoneShape::Relation::Apart);
    }
    const bool isUsable = isFinite(t[0]) && isFinite(t[1]) && isFinite(t[2]);
    if (!isUsable || orientation(t[0], t[1], t[2]) == 0)
    {
      return false;
    }
    return whole ? std::all_of(t, t + 3,
                     [this](Point2 p) {
                       return this->holds({ p.x, p.y, 0 });
                     })
                 : triangleMeetsBox(t[0], t[1], t[2], this->box());
  }
  bool has(const Point3 (&t)[4], bool whole) const
  {
    const bool isUsable = std::all_of(t, t + 4,
      [](const Point3& p)
      { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
    if (!isUsable || orientation3(t[0], t[1], t[2], t[3]) == 0)
    {
      return false;
    }
    if (!this->IsBox)
    {
      return this->columnHas(t, whole);
    }
    return whole ? std::all_of(t, t + 4, [this](const Point3& p) { return this->holds(p); })
                 : tetrahedronMeetsBox(t[0], t[1], t[2], t[3], this->box());
  }

private:
  /// A tetrahedron's projection to x and y is the union of its faces' projections. Faces whose
  /// projections have no area add nothing.
  bool columnHas(const Point3 (&t)[4], bool whole) const
  {
    bool hasAny = false;
    bool hasAll = true;
    for (int i = 0; i < 4; ++i)
    {
      const Point3& a = t[i];
      const Point3& b = t[(i + 1) % 4];
      const Point3& c = t[(i + 2) % 4];
      const Point2 face[3] = { { a.x, a.y }, { b.x, b.y }, { c.x, c.y } };
      if (orientation(face[0], face[1], face[2]) != 0)
      {
        hasAny = hasAny || this->has(face, false);
        hasAll = hasAll && this->has(face, true);
      }
    }
    return whole ? hasAll : hasAny;
  }

  Box3 box() const
  {
    Box3 result;
    for (std::size_t axis = 0; axis < std::size_t(this->Dimension); ++axis)
    {
      result.Min[axis] = this->Box[2 * axis];
      result.Max[axis] = this->Box[2 * axis + 1];
    }
    return result;
  }

  const int Dimension;
  Bounds Box;
  const bool IsBox;
  const ZoneShape Shape;
};

} // namespace

std::vector<std::int64_t> cellsIn(
  const ResidentMesh& mesh, const Region& region, bool whole, Communicator* ranks)
{
  const RegionTest test(mesh, region);
  std::vector<std::int64_t> ids;
  std::mutex mutex;
  forCells(
    mesh, piecesOfRank(ranks, mesh), {}, [&](const Bounds& box) { return test.wants(box); },
    [&](const MeshPart& part, const Bounds*, std::int64_t begin, std::int64_t end)
    {
      std::vector<std::int64_t> own;
      withAccess(part.Mesh,
        [&](const auto& access)
        {
          std::conditional_t<std::decay_t<decltype(access)>::Dimension == 2, Point2, Point3>
            corners[std::decay_t<decltype(access)>::Corners];
          for (std::int64_t cell = begin; cell < end; ++cell)
          {
            access.corners(cell, corners);
            !part.isHidden(cell) && test.has(corners, whole) ? own.push_back(part.cellId(cell))
                                                             : void();
          }
        });
      const std::lock_guard<std::mutex> lock(mutex);
      ids.insert(ids.end(), own.begin(), own.end());
    });
  return sortedUnique(gathered(ranks, std::move(ids)));
}

std::vector<std::int64_t> pointsIn(
  const ResidentMesh& mesh, const Region& region, Communicator* ranks)
{
  const RegionTest test(mesh, region);
  std::vector<std::int64_t> ids;
  const auto [first, end] = piecesOfRank(ranks, mesh);
  for (std::size_t i = first; i < end; ++i)
  {
    if (mesh.isStored() && !test.wants(mesh.mesh().Pieces[i].Box))
    {
      continue;
    }
    poll();
    const ResidentPieces::Lease piece = mesh.pieces().get(i, {});
    const MeshPart& part = *piece->Part;
    for (std::int64_t point = 0; point < part.Mesh.PointCount; ++point)
    {
      test.holds(positionOf(part, point)) ? ids.push_back(part.pointId(point)) : void();
    }
  }
  return sortedUnique(gathered(ranks, std::move(ids)));
}

} // namespace tipp

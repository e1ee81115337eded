// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Zones.h"

#include "Files/IOError.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactSum.h"
#include "Query/ForPieces.h"
#include "Query/Lines.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

bool meets(const Bounds& a, const Bounds& b, int dimension)
{
  bool met = true;
  for (std::size_t axis = 0; axis < std::size_t(dimension); ++axis)
  {
    met = met && a[2 * axis] <= b[2 * axis + 1] && b[2 * axis] <= a[2 * axis + 1];
  }
  return met;
}

Bounds boundsOf(const ZoneShape& zone)
{
  const Box<2>& box = zone.bounds();
  return { box.Low[0], box.High[0], box.Low[1], box.High[1], 0, 0 };
}

/// Calls work(part, box, begin, end) on several threads for parts of the cells of each piece whose
/// box wants(box): those that it owns and those that it borrows. Each cell that meets a box is in
/// its piece, so cells may come several times. The box is null for a mesh in memory.
template <typename Wants, typename Work>
void forCells(
  const ResidentMesh& mesh, const PieceNeeds& needs, const Wants& wants, const Work& work)
{
  std::vector<std::int32_t> wanted;
  for (std::size_t i = 0; i < mesh.mesh().Pieces.size(); ++i)
  {
    !mesh.isStored() || wants(mesh.mesh().Pieces[i].Box) ? wanted.push_back(std::int32_t(i))
                                                         : void();
  }
  const int threads = threadCount(mesh.options().Threads);
  const bool manyPieces = std::int64_t(wanted.size()) >= 2 * threads;
  forChunks(std::int64_t(wanted.size()), 1, manyPieces ? threads : 1, {},
    [&](std::int64_t i, std::int64_t, int)
    {
      poll();
      const auto number = std::size_t(wanted[std::size_t(i)]);
      const Bounds* const box = mesh.isStored() ? &mesh.mesh().Pieces[number].Box : nullptr;
      const ResidentPieces::Lease piece = mesh.pieces().get(number, needs);
      forChunks(piece->Part->Mesh.Cells, 1 << 13, manyPieces ? 1 : threads, {},
        [&](std::int64_t begin, std::int64_t end, int) { work(*piece->Part, box, begin, end); });
    });
}

/// What a zone has of a cell.
struct Contribution
{
  std::int32_t Zone;
  std::int64_t Cell; ///< global id
  ZoneShape::Integral Part;
  double Above;

  bool operator<(const Contribution& other) const
  {
    return std::tie(this->Zone, this->Cell) < std::tie(other.Zone, other.Cell);
  }
  bool operator==(const Contribution& other) const
  {
    return std::tie(this->Zone, this->Cell) == std::tie(other.Zone, other.Cell);
  }
};

/// The integral of what a field exceeds a level by: over the part of the triangle above it.
double above(
  const ZoneShape& zone, const Point2 (&corners)[3], const double (&values)[3], double level)
{
  // A convex polygon of at most four corners.
  Point2 at[4];
  double over[4];
  int count = 0;
  for (int i = 0; i < 3; ++i)
  {
    const int k = (i + 1) % 3;
    if (values[i] >= level)
    {
      at[count] = corners[i];
      over[count++] = values[i] - level;
    }
    if ((values[i] >= level) != (values[k] >= level))
    {
      const double share = (level - values[i]) / (values[k] - values[i]);
      at[count] = { corners[i].x + share * (corners[k].x - corners[i].x),
        corners[i].y + share * (corners[k].y - corners[i].y) };
      over[count++] = 0;
    }
  }
  ZoneShape::Integral part;
  for (int i = 2; i < count; ++i)
  {
    zone.integrate({ at[0], at[i - 1], at[i] }, { over[0], over[i - 1], over[i] }, part);
  }
  return part.Sum;
}

/// The sums of one zone.
struct ZoneSums
{
  std::int64_t Cells = 0;
  ExactSum Area;
  ExactSum Sum;
  ExactSum Above;
  double Low = HUGE_VAL;
  double High = -HUGE_VAL;

  void add(const Contribution& of)
  {
    this->Cells += 1;
    this->Area.add(of.Part.Area);
    this->Sum.add(of.Part.Sum);
    this->Above.add(of.Above);
    this->Low = std::min(this->Low, of.Part.Low);
    this->High = std::max(this->High, of.Part.High);
  }
};

/// Collects the contributions of all cells, each once.
class ZoneCollector
{
public:
  ZoneCollector(
    const std::vector<Zone>& zones, const StoredArray* array, int component, double level)
    : Array(array)
    , Component(component)
    , Level(level)
    , Sums(zones.size())
  {
    for (std::size_t i = 0; i < zones.size(); ++i)
    {
      this->Zones.emplace_back(zones[i], i);
    }
    this->Tree = BoxTree<2>(std::int64_t(zones.size()), 1,
      [this](std::int64_t i) { return this->Zones[std::size_t(i)].bounds(); });
  }

  void addCells(const MeshPart& part, const Bounds* box, std::int64_t begin, std::int64_t end)
  {
    const PartValues values(part, this->Array);
    std::vector<Contribution> inner;
    std::vector<Contribution> shared;
    withAccess(part.Mesh,
      [&](const auto& access)
      {
        for (std::int64_t cell = begin; cell < end; ++cell)
        {
          if (!part.Mesh.Hidden || !part.Mesh.Hidden[cell])
          {
            this->addCell(access, part, values, cell, box, inner, shared);
          }
        }
      });
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const Contribution& contribution : inner)
    {
      this->Sums[std::size_t(contribution.Zone)].add(contribution);
    }
    this->Shared.insert(this->Shared.end(), shared.begin(), shared.end());
  }

  ZoneStatistics result()
  {
    std::sort(this->Shared.begin(), this->Shared.end());
    const auto end = std::unique(this->Shared.begin(), this->Shared.end());
    std::for_each(this->Shared.begin(), end,
      [this](const Contribution& c) { this->Sums[std::size_t(c.Zone)].add(c); });
    ZoneStatistics result;
    for (const ZoneSums& sums : this->Sums)
    {
      const double area = sums.Area.value();
      const double none = std::numeric_limits<double>::quiet_NaN();
      result.Cells.push_back(sums.Cells);
      result.Area.push_back(area);
      result.Low.push_back(sums.Cells > 0 ? sums.Low : none);
      result.High.push_back(sums.Cells > 0 ? sums.High : none);
      result.Sum.push_back(sums.Sum.value());
      result.Mean.push_back(area > 0 ? sums.Sum.value() / area : none);
      result.Above.push_back(sums.Above.value());
    }
    return result;
  }

  bool wants(const Bounds& box) const
  {
    return std::any_of(this->Zones.begin(), this->Zones.end(),
      [&box](const ZoneShape& zone) { return meets(box, boundsOf(zone), 2); });
  }

private:
  template <typename Access>
  void addCell(const Access& access, const MeshPart& part, const PartValues& values,
    std::int64_t cell, const Bounds* box, std::vector<Contribution>& inner,
    std::vector<Contribution>& shared) const
  {
    Point2 corners[3];
    double given[3];
    Box<2> extent = Box<2>::empty();
    for (int i = 0; i < 3; ++i)
    {
      const Point3 p = access.point(access.ids(cell)[i]);
      corners[i] = { p.x, p.y };
      extent.extend({ { p.x, p.y }, { p.x, p.y } });
    }
    bool isRead = false;
    // A cell in the inside of a piece's box is in no other piece.
    const bool isInner = !box ||
      ((*box)[0] < extent.Low[0] && extent.High[0] < (*box)[1] && (*box)[2] < extent.Low[1] &&
        extent.High[1] < (*box)[3]);
    extent.isEmpty() ? void()
                     : this->Tree.search(extent,
                         [&](std::int32_t z)
                         {
                           isRead ? void() : this->read(access, part, values, cell, given);
                           isRead = true;
                           Contribution found{ z, part.cellId(cell), {}, 0 };
                           if (this->integrate(std::size_t(z), corners, given, found))
                           {
                             (isInner ? inner : shared).push_back(found);
                           }
                         });
  }

  template <typename Access>
  void read(const Access& access, const MeshPart& part, const PartValues& values, std::int64_t cell,
    double (&given)[3]) const
  {
    for (int i = 0; i < 3; ++i)
    {
      const bool ofPoints = values.description().OfPoints;
      const std::int64_t row = part.Rows ? part.Rows[cell] : cell;
      given[i] =
        values.atPoint(ofPoints ? std::int64_t(access.ids(cell)[i]) : row, this->Component);
    }
  }

  bool integrate(
    std::size_t zone, const Point2 (&corners)[3], const double (&values)[3], Contribution& to) const
  {
    if (!std::isfinite(values[0]) || !std::isfinite(values[1]) || !std::isfinite(values[2]))
    {
      return false;
    }
    const ZoneShape& shape = this->Zones[zone];
    shape.integrate(corners, values, to.Part);
    to.Above =
      to.Part.IsMet && to.Part.High > this->Level ? above(shape, corners, values, this->Level) : 0;
    return to.Part.IsMet;
  }

  const StoredArray* Array;
  const int Component;
  const double Level;
  std::vector<ZoneShape> Zones;
  BoxTree<2> Tree;
  std::mutex Mutex;
  std::vector<ZoneSums> Sums;
  std::vector<Contribution> Shared; ///< of cells that several pieces may have
};

} // namespace

ZoneStatistics statisticsOf(const ResidentMesh& mesh, const std::vector<Zone>& zones,
  const std::string& array, int component, double level)
{
  const StoredArray* const description = fieldOf(mesh, array, component, true);
  if (!std::isfinite(level))
  {
    throw IOError("The level is not a finite number.");
  }
  ZoneCollector collector(zones, description, component, level);
  forCells(
    mesh, mesh.needsOf({ array }), [&](const Bounds& box) { return collector.wants(box); },
    [&](const MeshPart& part, const Bounds* box, std::int64_t begin, std::int64_t end)
    { collector.addCells(part, box, begin, end); });
  return collector.result();
}

namespace
{

/// Decides what is in a region.
class RegionTest
{
public:
  RegionTest(const ResidentMesh& mesh, const Region& region)
    : Dimension(mesh.mesh().CellSize - 1)
    , Box(region.Box)
    , IsBox(region.Polygons.empty())
    , Shape(region.Polygons, 0)
  {
    if (!this->IsBox && this->Dimension == 3)
    {
      throw IOError(mesh.isStored() ? mesh.mesh().Path : "the mesh",
        "has tetrahedra, of which a polygon holds none; give a box.");
    }
    for (std::size_t axis = 0; axis < std::size_t(this->Dimension) && this->IsBox; ++axis)
    {
      if (!(this->Box[2 * axis] <= this->Box[2 * axis + 1]))
      {
        throw IOError("The box has a minimum above its maximum, or bounds that are no numbers.");
      }
    }
    this->Box = this->IsBox ? this->Box : boundsOf(this->Shape);
  }

  bool wants(const Bounds& box) const { return meets(box, this->Box, this->Dimension); }

  bool holds(const Point3& p) const
  {
    const Bounds at = { p.x, p.x, p.y, p.y, p.z, p.z };
    return meets(at, this->Box, this->Dimension) &&
      (this->IsBox || this->Shape.holds({ p.x, p.y }));
  }

  /// Whether a cell that has an area or volume has a point of the region, or lies in it.
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
    return whole ? std::all_of(t, t + 4, [this](const Point3& p) { return this->holds(p); })
                 : tetrahedronMeetsBox(t[0], t[1], t[2], t[3], this->box());
  }

private:
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

std::vector<std::int64_t> cellsIn(const ResidentMesh& mesh, const Region& region, bool whole)
{
  const RegionTest test(mesh, region);
  std::vector<std::int64_t> ids;
  std::mutex mutex;
  forCells(
    mesh, {}, [&](const Bounds& box) { return test.wants(box); },
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
            const bool isHidden = part.Mesh.Hidden && part.Mesh.Hidden[cell];
            !isHidden&& test.has(corners, whole) ? own.push_back(part.cellId(cell)) : void();
          }
        });
      const std::lock_guard<std::mutex> lock(mutex);
      ids.insert(ids.end(), own.begin(), own.end());
    });
  sortUnique(ids);
  return ids;
}

std::vector<std::int64_t> pointsIn(const ResidentMesh& mesh, const Region& region)
{
  const RegionTest test(mesh, region);
  std::vector<std::int64_t> ids;
  for (std::size_t i = 0; i < mesh.mesh().Pieces.size(); ++i)
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
  sortUnique(ids);
  return ids;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Files/IOError.h"
#include "Parallel/Sort.h"
#include "Predicates/ExactArithmetic.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/ExactPredicates3.h"
#include "Query/RankAnswer.h"
#include "Resident/ForPieces.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <tuple>
#include <type_traits>
#include <utility>

namespace tipp
{
namespace
{

/// The integrals of one cell in one zone.
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

/// The integral of (field - level) over the part of the triangle where the field exceeds the level.
double above(
  const ZoneShape& zone, const Point2 (&corners)[3], const double (&values)[3], double level)
{
  // This part is a convex polygon with at most four corners.
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
  void add(const ZoneSums& other)
  {
    this->Cells += other.Cells;
    this->Area.add(other.Area);
    this->Sum.add(other.Sum);
    this->Above.add(other.Above);
    this->Low = std::min(this->Low, other.Low);
    this->High = std::max(this->High, other.High);
  }
};

template <typename Archive>
void serialize(Archive& archive, ZoneSums& sums)
{
  archive(sums.Cells, sums.Area, sums.Sum, sums.Above, sums.Low, sums.High);
}

/// The results of some pieces.
struct ZoneParts
{
  std::vector<ZoneSums> Sums;
  std::vector<Contribution> Shared; ///< of cells that other pieces may have too
};

template <typename Archive>
void serialize(Archive& archive, ZoneParts& parts)
{
  archive(parts.Sums, parts.Shared);
}

/// Combines the results of all pieces. Removes repeated contributions.
ZoneStatistics resultOf(ZoneParts parts)
{
  std::sort(parts.Shared.begin(), parts.Shared.end());
  const auto end = std::unique(parts.Shared.begin(), parts.Shared.end());
  std::for_each(parts.Shared.begin(), end,
    [&parts](const Contribution& c) { parts.Sums[std::size_t(c.Zone)].add(c); });
  ZoneStatistics result;
  for (const ZoneSums& sums : parts.Sums)
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

/// Collects the contributions of cells to zones.
class ZoneCollector
{
public:
  ZoneCollector(
    const std::vector<Zone>& zones, const StoredArray* array, int component, double level)
    : Array(array)
    , Component(component)
    , Level(level)
  {
    this->Parts.Sums.resize(zones.size());
    for (std::size_t i = 0; i < zones.size(); ++i)
    {
      this->Zones.emplace_back(zones[i], i);
    }
    this->Tree = BoxTree<2>(std::int64_t(zones.size()), 1,
      [this](std::int64_t i) { return this->Zones[std::size_t(i)].bounds(); });
  }

  void addCells(const MeshPart& part, const Box3* box, std::int64_t begin, std::int64_t end)
  {
    const PartValues values(part, this->Array);
    std::vector<Contribution> inner;
    std::vector<Contribution> shared;
    withAccess(part.Mesh,
      [&](const auto& access)
      {
        for (std::int64_t cell = begin; cell < end; ++cell)
        {
          if (!part.isHidden(cell))
          {
            this->addCell(access, part, values, cell, box, inner, shared);
          }
        }
      });
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const Contribution& contribution : inner)
    {
      this->Parts.Sums[std::size_t(contribution.Zone)].add(contribution);
    }
    this->Parts.Shared.insert(this->Parts.Shared.end(), shared.begin(), shared.end());
  }

  bool wants(const Box3& box) const
  {
    return std::any_of(this->Zones.begin(), this->Zones.end(),
      [&box](const ZoneShape& zone) { return projected<2>(box).meets(zone.bounds()); });
  }

  ZoneParts Parts; ///< what has been collected

private:
  template <typename Access>
  void addCell(const Access& access, const MeshPart& part, const PartValues& values,
    std::int64_t cell, const Box3* box, std::vector<Contribution>& inner,
    std::vector<Contribution>& shared) const
  {
    Point2 corners[3];
    double given[3];
    Box2 extent = Box2::empty();
    for (int i = 0; i < 3; ++i)
    {
      corners[i] = projected<2>(access.point(access.ids(cell)[i]));
      extent.extend(corners[i]);
    }
    bool isRead = false;
    // No other piece has a cell that is strictly inside this piece's box.
    const bool isInner = !box ||
      (box->Min.x < extent.Min.x && extent.Max.x < box->Max.x && box->Min.y < extent.Min.y &&
        extent.Max.y < box->Max.y);
    if (isFinite(extent))
    {
      this->Tree.search(extent,
        [&](std::int32_t z)
        {
          if (!isRead)
          {
            this->read(access, part, values, cell, given);
          }
          isRead = true;
          Contribution found{ z, part.cellId(cell), {}, 0 };
          if (this->integrate(std::size_t(z), corners, given, found))
          {
            (isInner ? inner : shared).push_back(found);
          }
        });
    }
  }

  template <typename Access>
  void read(const Access& access, const MeshPart& part, const PartValues& values, std::int64_t cell,
    double (&given)[3]) const
  {
    for (int i = 0; i < 3; ++i)
    {
      const bool ofPoints = values.description().OfPoints;
      given[i] = values.atPoint(
        ofPoints ? std::int64_t(access.ids(cell)[i]) : part.row(cell), this->Component);
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
};

/// The contributions of the cells in the pieces [first, last).
ZoneParts partsIn(const ResidentMesh& mesh, std::pair<std::size_t, std::size_t> pieces,
  const std::vector<Zone>& zones, const std::string& array, int component, double level)
{
  if (mesh.mesh().CellSize != 3)
  {
    mesh.refuse("has tetrahedra; statistics of zones are made over the area of triangles, so ask a "
                "surface.");
  }
  const StoredArray* const description = mesh.fieldOf(array, component, true);
  if (!std::isfinite(level))
  {
    throw IOError("The level is not a finite number.");
  }
  ZoneCollector collector(zones, description, component, level);
  forCells(
    mesh, pieces, mesh.needsOf({ array }), [&](const Box3& box) { return collector.wants(box); },
    [&](const MeshPart& part, const Box3* box, std::int64_t begin, std::int64_t end)
    { collector.addCells(part, box, begin, end); });
  return std::move(collector.Parts);
}

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
      if (!(this->Box.Min[axis] <= this->Box.Max[axis]))
      {
        throw IOError("The box has a minimum above its maximum, or bounds that are no numbers.");
      }
    }
    if (!this->IsBox)
    {
      const auto& [low, high] = this->Shape.bounds();
      this->Box = { { low.x, low.y, -HUGE_VAL }, { high.x, high.y, HUGE_VAL } };
    }
  }

  bool wants(const Box3& box) const { return meets(box, this->Box, this->Dimension); }

  bool holds(const Point3& p) const
  {
    return contains(this->Box, p, this->Dimension) &&
      (this->IsBox || this->Shape.holds(projected<2>(p)));
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
                 : triangleMeetsBox(t[0], t[1], t[2], boundedBox(this->Box, 2));
  }
  bool has(const Point3 (&t)[4], bool whole) const
  {
    const bool isUsable = std::all_of(t, t + 4, [](const Point3& p) { return isFinite(p); });
    if (!isUsable || orientation3(t[0], t[1], t[2], t[3]) == 0)
    {
      return false;
    }
    if (!this->IsBox)
    {
      return this->columnHas(t, whole);
    }
    return whole ? std::all_of(t, t + 4, [this](const Point3& p) { return this->holds(p); })
                 : tetrahedronMeetsBox(t[0], t[1], t[2], t[3], boundedBox(this->Box, 3));
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
      const Point2 face[3] = { projected<2>(t[i]), projected<2>(t[(i + 1) % 4]),
        projected<2>(t[(i + 2) % 4]) };
      if (orientation(face[0], face[1], face[2]) != 0)
      {
        hasAny = hasAny || this->has(face, false);
        hasAll = hasAll && this->has(face, true);
      }
    }
    return whole ? hasAll : hasAny;
  }

  const int Dimension;
  Box3 Box;
  const bool IsBox;
  const ZoneShape Shape;
};

} // namespace

ZoneStatistics statisticsOf(const ResidentMesh& mesh, const std::vector<Zone>& zones,
  const std::string& array, int component, double level, Communicator* ranks)
{
  if (!ranks)
  {
    return resultOf(partsIn(mesh, piecesOfRank(ranks, mesh), zones, array, component, level));
  }
  const std::vector<Zone> common = ranks->broadcast(zones);
  const double commonLevel = ranks->broadcast(level);
  ZoneParts all;
  all.Sums.resize(common.size());
  ZoneParts own = all;
  if (canQuery(ranks, mesh))
  {
    own = partsIn(mesh, piecesOfRank(ranks, mesh), common, array, component, commonLevel);
  }
  for (const ZoneParts& part : ranks->gather(own))
  {
    for (std::size_t i = 0; i < common.size(); ++i)
    {
      all.Sums[i].add(part.Sums[i]);
    }
    all.Shared.insert(all.Shared.end(), part.Shared.begin(), part.Shared.end());
  }
  return ranks->broadcast(ranks->isFirst() ? resultOf(std::move(all)) : ZoneStatistics());
}

std::vector<std::int64_t> cellsIn(
  const ResidentMesh& mesh, const Region& region, bool whole, Communicator* ranks)
{
  const RegionTest test(mesh, region);
  std::vector<std::int64_t> ids;
  std::mutex mutex;
  forCells(
    mesh, piecesOfRank(ranks, mesh), {}, [&](const Box3& box) { return test.wants(box); },
    [&](const MeshPart& part, const Box3*, std::int64_t begin, std::int64_t end)
    {
      std::vector<std::int64_t> own;
      withAccess(part.Mesh,
        [&](const auto& access)
        {
          using Access = std::decay_t<decltype(access)>;
          typename Access::Point corners[Access::Corners];
          for (std::int64_t cell = begin; cell < end; ++cell)
          {
            access.corners(cell, corners);
            if (!part.isHidden(cell) && test.has(corners, whole))
            {
              own.push_back(part.cellId(cell));
            }
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
      if (test.holds(positionOf(part, point)))
      {
        ids.push_back(part.pointId(point));
      }
    }
  }
  return sortedUnique(gathered(ranks, std::move(ids)));
}

} // namespace tipp

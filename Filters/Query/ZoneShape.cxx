// SPDX-License-Identifier: BSD-3-Clause
#include "Query/ZoneShape.h"

#include "Files/IOError.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Vectors.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

/// Whether a ring is counter-clockwise. Decided by the turn at its lexicographically first corner
/// or, if the ring goes back on itself there, by its area.
bool isCounterClockwise(const std::vector<Point2>& ring)
{
  const std::size_t count = ring.size();
  std::size_t first = 0;
  double area = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    first = lexicographicLess(ring[i], ring[first]) ? i : first;
    area += cross(ring[i] - ring[0], ring[(i + 1) % count] - ring[0]);
  }
  const int turn =
    orientation(ring[(first + count - 1) % count], ring[first], ring[(first + 1) % count]);
  return turn != 0 ? turn > 0 : area > 0;
}

/// The position of a zone's edge relative to a counter-clockwise triangle, as exact signs.
struct Sides
{
  int OfFrom[3]; ///< per edge of the triangle: 1 inside, 0 on its line, -1 outside
  int OfTo[3];
  int OfCorners[3]; ///< per corner: 1 left of the edge's line, 0 on it, -1 right

  Sides(const Point2 (&triangle)[3], Point2 from, Point2 to)
  {
    for (int i = 0; i < 3; ++i)
    {
      this->OfFrom[i] = orientation(triangle[i], triangle[(i + 1) % 3], from);
      this->OfTo[i] = orientation(triangle[i], triangle[(i + 1) % 3], to);
      this->OfCorners[i] = orientation(from, to, triangle[i]);
    }
  }

  /// Two convex sets are disjoint only if a line through a side of one of them separates them.
  bool meetsClosed() const
  {
    for (int i = 0; i < 3; ++i)
    {
      if (this->OfFrom[i] < 0 && this->OfTo[i] < 0)
      {
        return false;
      }
    }
    return std::abs(this->OfCorners[0] + this->OfCorners[1] + this->OfCorners[2]) != 3;
  }
  bool meetsInterior() const
  {
    for (int i = 0; i < 3; ++i)
    {
      if (this->OfFrom[i] <= 0 && this->OfTo[i] <= 0)
      {
        return false;
      }
    }
    const auto [low, high] =
      std::minmax({ this->OfCorners[0], this->OfCorners[1], this->OfCorners[2] });
    return low < 0 && high > 0;
  }

  /// Whether the edge crosses side i of the triangle between its ends: 1 inwards, -1 outwards, 0 if
  /// not. An end on the side's line counts as outside.
  int crossing(int i) const
  {
    const bool isInward = this->OfFrom[i] <= 0 && this->OfTo[i] > 0;
    const bool isOutward = this->OfFrom[i] > 0 && this->OfTo[i] <= 0;
    const int sign = isInward ? 1 : isOutward ? -1 : 0;
    const bool isBetween = this->OfCorners[i] * sign > 0 && this->OfCorners[(i + 1) % 3] * sign < 0;
    return isBetween ? sign : 0;
  }
};

/// Makes a triangle counter-clockwise. Returns false if it has no area or is not finite.
bool turned(Point2 (&triangle)[3], double (&values)[3])
{
  const bool isUsable = isFinite(triangle[0]) && isFinite(triangle[1]) && isFinite(triangle[2]);
  const int turn = isUsable ? orientation(triangle[0], triangle[1], triangle[2]) : 0;
  if (turn < 0)
  {
    std::swap(triangle[1], triangle[2]);
    std::swap(values[1], values[2]);
  }
  // Starts with the lexicographically lowest corner, so that roundings do not depend on the order
  // of the corners.
  int first = 0;
  for (int i = 1; i < 3; ++i)
  {
    first = lexicographicLess(triangle[i], triangle[first]) ? i : first;
  }
  std::rotate(triangle, triangle + first, triangle + 3);
  std::rotate(values, values + first, values + 3);
  return turn != 0;
}

Box2 boxOf(const Point2 (&triangle)[3])
{
  Box2 box = Box2::of(triangle[0], triangle[1]);
  box.extend(triangle[2]);
  return box;
}

} // namespace

ZoneShape::ZoneShape(const Zone& zone, std::size_t number)
{
  for (const ZoneRing& ring : zone)
  {
    const bool isFinite = std::all_of(
      ring.Corners.begin(), ring.Corners.end(), [](Point2 p) { return tipp::isFinite(p); });
    if (!isFinite)
    {
      throw IOError("Zone " + std::to_string(number) + " has a corner that is not finite.");
    }
    this->addRing(ring);
  }
  const auto boxOfEdge = [this](std::int64_t i)
  { return Box2::of(this->Edges[std::size_t(i)].From, this->Edges[std::size_t(i)].To); };
  this->Tree = BoxTree<2>(std::int64_t(this->Edges.size()), 1, boxOfEdge);
  this->Bounds = boundsOf<2>(std::int64_t(this->Edges.size()), 1, boxOfEdge);
  this->refuseCrossings(number);
}

void ZoneShape::addRing(const ZoneRing& ring)
{
  std::vector<Point2> corners;
  for (const Point2 p : ring.Corners)
  {
    if (corners.empty() || !(corners.back() == p))
    {
      corners.push_back(p);
    }
  }
  while (corners.size() > 1 && corners.back() == corners.front())
  {
    corners.pop_back();
  }
  if (corners.size() < 3)
  {
    return;
  }
  if (isCounterClockwise(corners) == ring.IsHole)
  {
    std::reverse(corners.begin(), corners.end());
  }
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    this->Edges.push_back({ corners[i], corners[(i + 1) % corners.size()] });
  }
}

template <typename Visit>
void ZoneShape::visitNear(const Box2& box, const Visit& visit) const
{
  if (box.meets(this->Bounds))
  {
    this->Tree.search(box,
      [&](std::int32_t i)
      {
        const Edge& edge = this->Edges[std::size_t(i)];
        if (box.meets(Box2::of(edge.From, edge.To)))
        {
          visit(edge);
        }
      });
  }
}

void ZoneShape::refuseCrossings(std::size_t number) const
{
  for (const Edge& edge : this->Edges)
  {
    this->visitNear(Box2::of(edge.From, edge.To),
      [&](const Edge& other)
      {
        if (crossProperly(edge.From, edge.To, other.From, other.To))
        {
          throw IOError("Zone " + std::to_string(number) +
            " has edges that cross, one of them at (" + std::to_string(edge.From.x) + ", " +
            std::to_string(edge.From.y) +
            "): a polygon crosses itself or overlaps another one; repair them.");
        }
      });
  }
}

/// The winding number of the rings around the point a + e (b - a) + e^2 n for all small e > 0,
/// where n points to the left of ab. a and b must differ.
int ZoneShape::windingBeside(Point2 a, Point2 b) const
{
  const bool isLower = b.y < a.y || (b.y == a.y && b.x < a.x);
  const auto isAbove = [&](Point2 p) { return p.y > a.y || (p.y == a.y && isLower); };
  int winding = 0;
  this->visitNear({ a, { this->Bounds.Max.x, a.y } },
    [&](const Edge& edge)
    {
      const bool isUpward = isAbove(edge.To);
      if (isAbove(edge.From) == isUpward)
      {
        return;
      }
      int side = orientation(edge.From, edge.To, a);
      side = side != 0 ? side : orientation(edge.From, edge.To, b);
      if (side == 0) // all three are on one line
      {
        side = lexicographicLess(edge.From, edge.To) == lexicographicLess(a, b) ? 1 : -1;
      }
      winding += side > 0 && isUpward ? 1 : side < 0 && !isUpward ? -1 : 0;
    });
  return winding;
}

bool ZoneShape::holds(Point2 point) const
{
  if (!isFinite(point) || !this->Bounds.contains(point))
  {
    return false;
  }
  bool isOnBorder = false;
  this->visitNear(Box2::of(point),
    [&](const Edge& edge)
    { isOnBorder = isOnBorder || orientation(edge.From, edge.To, point) == 0; });
  return isOnBorder || this->windingBeside(point, { std::nextafter(point.x, HUGE_VAL), point.y });
}

ZoneShape::Relation ZoneShape::relationTo(const Point2 (&corners)[3]) const
{
  Point2 triangle[3] = { corners[0], corners[1], corners[2] };
  double none[3] = {};
  if (!turned(triangle, none) || !boxOf(triangle).meets(this->Bounds))
  {
    return Relation::Apart;
  }
  bool isCut = false;
  bool isTouched = false;
  this->visitNear(boxOf(triangle),
    [&](const Edge& edge)
    {
      if (!isCut)
      {
        const Sides sides(triangle, edge.From, edge.To);
        isTouched = isTouched || sides.meetsClosed();
        isCut = sides.meetsInterior();
      }
    });
  if (isCut)
  {
    return Relation::Cut;
  }
  return this->windingBeside(triangle[0], triangle[1]) != 0 ? Relation::Inside
    : isTouched                                             ? Relation::Touches
                                                            : Relation::Apart;
}

/// Integrates over the part of a triangle in a zone by Green's theorem. The border of this part
/// consists of the zone's edges inside the triangle, and of the parts of the triangle's sides
/// inside the zone. Where an edge crosses a side, both use the same rounded point, so that the
/// border is always closed.
class ZoneShape::CutTriangle
{
public:
  CutTriangle(const Point2 (&triangle)[3], const double (&values)[3], Integral& to)
    : To(to)
  {
    std::copy_n(triangle, 3, this->Corners);
    std::copy_n(values, 3, this->Values);
    const Point2 u = triangle[1] - triangle[0];
    const Point2 v = triangle[2] - triangle[0];
    const double area = cross(u, v);
    this->SlopeX = ((values[1] - values[0]) * v.y - (values[2] - values[0]) * u.y) / area;
    this->SlopeY = ((values[2] - values[0]) * u.x - (values[1] - values[0]) * v.x) / area;
  }

  /// Adds an edge of the zone that meets the triangle's interior.
  void addEdge(const Sides& sides, Point2 from, Point2 to)
  {
    FieldPoint ends[2] = { this->inside(from), this->inside(to) };
    const auto isInside = [](const int(&of)[3]) { return of[0] >= 0 && of[1] >= 0 && of[2] >= 0; };
    bool isFound[2] = { isInside(sides.OfFrom), isInside(sides.OfTo) };
    for (int i = 0; i < 3; ++i)
    {
      const int sign = sides.crossing(i);
      if (sign != 0)
      {
        const FieldPoint at = this->onSide(i, sides, from, to);
        this->Jumps[i] += sign;
        this->addPart(at, this->corner((i + 1) % 3), -sign);
        // If the edge ends on the side, the crossing is this end.
        FieldPoint& end = ends[sign > 0 ? 0 : 1];
        bool& isEnd = isFound[sign > 0 ? 0 : 1];
        end = isEnd ? end : at;
        isEnd = true;
      }
    }
    for (int i = 0; i < 3; ++i) // whether the edge enters or leaves at a corner
    {
      for (int k = 0; k < 2 && sides.OfCorners[i] == 0; ++k)
      {
        ends[k] = isFound[k] ? ends[k] : this->corner(i);
      }
    }
    this->addPart(ends[0], ends[1], 1);
    this->extend(ends[0].Value);
    this->extend(ends[1].Value);
  }

  /// Adds a side of the triangle. `winding` is the zone's winding number at the start of the side.
  void addSide(int side, int winding)
  {
    this->addPart(this->corner(side), this->corner((side + 1) % 3), winding);
    if (winding != 0)
    {
      this->extend(this->Values[side]);
    }
    if (winding - this->Jumps[side] != 0)
    {
      this->extend(this->Values[(side + 1) % 3]);
    }
  }

  /// Adds the result to the integral, after all edges and sides.
  void finish()
  {
    const double whole =
      cross(this->Corners[1] - this->Corners[0], this->Corners[2] - this->Corners[0]) / 2;
    this->To.Area += std::clamp(this->Area, 0.0, std::fabs(whole));
    this->To.Sum += this->Sum;
    this->To.IsMet = true;
  }

private:
  /// A point in the triangle, and the value of the field there.
  struct FieldPoint
  {
    Point2 Position; ///< relative to the first corner
    double Value;
  };

  FieldPoint corner(int i) const
  {
    return { this->Corners[i] - this->Corners[0], this->Values[i] };
  }

  FieldPoint inside(Point2 p) const
  {
    const Point2 at = p - this->Corners[0];
    const auto [low, high] = std::minmax({ this->Values[0], this->Values[1], this->Values[2] });
    const double value = this->Values[0] + this->SlopeX * at.x + this->SlopeY * at.y;
    return { at, value >= low ? std::min(value, high) : low };
  }

  /// The point where an edge crosses a side.
  FieldPoint onSide(int side, const Sides& sides, Point2 from, Point2 to) const
  {
    if (sides.OfFrom[side] == 0 || sides.OfTo[side] == 0)
    {
      return this->inside(sides.OfFrom[side] == 0 ? from : to);
    }
    const FieldPoint a = this->corner(side);
    const FieldPoint b = this->corner((side + 1) % 3);
    const Point2 along = to - from;
    const double ofA = std::fabs(cross(along, this->Corners[side] - from));
    const double ofB = std::fabs(cross(along, this->Corners[(side + 1) % 3] - from));
    const double share = ofA + ofB > 0 ? ofA / (ofA + ofB) : 0.5;
    return { { a.Position.x + share * (b.Position.x - a.Position.x),
               a.Position.y + share * (b.Position.y - a.Position.y) },
      a.Value + share * (b.Value - a.Value) };
  }

  void addPart(const FieldPoint& a, const FieldPoint& b, int times)
  {
    const double area = times * cross(a.Position, b.Position) / 2;
    this->Area += area;
    this->Sum += area * ((this->Values[0] + a.Value + b.Value) / 3);
  }

  void extend(double value)
  {
    this->To.Low = std::min(this->To.Low, value);
    this->To.High = std::max(this->To.High, value);
  }

  Point2 Corners[3];
  double Values[3];
  double SlopeX;
  double SlopeY;
  int Jumps[3] = {};
  double Area = 0;
  double Sum = 0;
  Integral& To;
};

void ZoneShape::integrate(
  const Point2 (&corners)[3], const double (&given)[3], Integral& integral) const
{
  Point2 triangle[3] = { corners[0], corners[1], corners[2] };
  double values[3] = { given[0], given[1], given[2] };
  if (!turned(triangle, values) || !boxOf(triangle).meets(this->Bounds))
  {
    return;
  }
  CutTriangle cut(triangle, values, integral);
  bool isCut = false;
  this->visitNear(boxOf(triangle),
    [&](const Edge& edge)
    {
      const Sides sides(triangle, edge.From, edge.To);
      if (sides.meetsInterior())
      {
        isCut = true;
        cut.addEdge(sides, edge.From, edge.To);
      }
    });
  const int winding = this->windingBeside(triangle[0], triangle[1]);
  if (!isCut && winding == 0)
  {
    return;
  }
  for (int side = 0; side < 3; ++side)
  {
    cut.addSide(side,
      isCut && side > 0 ? this->windingBeside(triangle[side], triangle[(side + 1) % 3]) : winding);
  }
  cut.finish();
}

} // namespace tipp

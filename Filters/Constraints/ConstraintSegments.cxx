// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintSegments.h"

#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

/// A tree of the segments around holes, or of all others. The items' Ids are indices in `segments`.
SegmentTree treeOf(const std::vector<ConstraintSegment>& segments, bool areHoles)
{
  std::vector<SegmentTree::Item> items;
  items.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const ConstraintSegment& segment = segments[i];
    if ((segment.Role == SegmentRole::Hole) == areHoles)
    {
      items.push_back({ segment.A, segment.B, std::int64_t(i) });
    }
  }
  return SegmentTree(std::move(items));
}

/// A corner of a triangle, and the other two corners.
struct Wedge
{
  Point2 Corner;
  Point2 One;
  Point2 Other;
};

const auto isLower = [](Point2 a, Point2 b) { return lexicographicLess(a, b); };

/// The wedge at the lexicographically lowest corner.
Wedge lowestWedge(const std::array<Point2, 3>& triangle)
{
  const auto low =
    std::size_t(std::min_element(triangle.begin(), triangle.end(), isLower) - triangle.begin());
  return { triangle[low], triangle[(low + 1) % 3], triangle[(low + 2) % 3] };
}

/// Calls visit(item, sign, isOn) for each segment of a tree that crosses an upward ray, or on which
/// the ray starts: the sign is 1 if the segment goes to the left there, otherwise -1. The ray
/// starts inside the triangle, so close to the corner that among the segments through the corner no
/// others need to be compared; no segment enters the wedge. isOn: the ray starts on the segment;
/// this is possible only if the wedge is a single edge.
template <typename Visit>
void visitAbove(const SegmentTree& tree, const Wedge& wedge, const Visit& visit)
{
  // The other corners are not to the left of the corner, so the ray's x is slightly larger than the
  // corner's.
  const Point2 p = wedge.Corner;
  const double infinity = std::numeric_limits<double>::infinity();
  tree.visitNear(Box2{ p, { p.x, infinity } },
    [&](const SegmentTree::Item& item)
    {
      const bool goesLeft = item.B.x < item.A.x;
      const Point2 left = goesLeft ? item.B : item.A;
      const Point2 right = goesLeft ? item.A : item.B;
      if (!(left.x <= p.x && p.x < right.x))
      {
        return true;
      }
      int side = orientation(left, right, p); // where the ray starts: 1 is above the segment
      for (const Point2 other : { wedge.One, wedge.Other })
      {
        side = side == 0 ? orientation(left, right, other) : side;
      }
      if (side <= 0)
      {
        visit(item, goesLeft ? 1 : -1, side == 0);
      }
      return true;
    });
}

const auto isAny = [](const SegmentTree::Item&) { return true; };

} // namespace

ConstraintSegments::ConstraintSegments(
  const std::vector<ConstraintSegment>& segments, std::vector<std::int64_t>* indices)
  : All(treeOf(segments, false))
  , Holes(treeOf(segments, true))
{
  // Items are identified by their index in the tree, which is the same on all ranks.
  std::vector<std::int64_t> names = this->All.nameByPosition();
  for (const std::int64_t segment : names)
  {
    this->Roles.push_back(std::uint8_t(segments[std::size_t(segment)].Role));
  }
  if (indices)
  {
    *indices = std::move(names);
  }
  this->HasPolygons = this->has(SegmentRole::Polygon);
  this->HasBoundary = this->has(SegmentRole::Boundary);
  this->OnlyHoles = !this->haveInside();
}

ConstraintSegments::ConstraintSegments(
  const std::vector<ConstraintSegment>& segments, const std::vector<std::int64_t>& names)
  : All(treeOf(segments, false))
  , Holes({})
  , Names(this->All.nameByPosition())
{
  for (std::int64_t& name : this->Names)
  {
    name = names[std::size_t(name)];
  }
}

bool ConstraintSegments::has(SegmentRole role) const
{
  return std::find(this->Roles.begin(), this->Roles.end(), std::uint8_t(role)) != this->Roles.end();
}

/// Whether the winding number of the polygons is positive anywhere. If it is, then also at the
/// lexicographically lowest corner of such an area: directly above or below an edge that starts
/// there, or to the right of a vertical one.
bool ConstraintSegments::haveInside() const
{
  const auto isPolygon = [this](const SegmentTree::Item& item)
  { return this->roleOf(item) == SegmentRole::Polygon; };
  return std::any_of(this->All.items().begin(), this->All.items().end(),
    [&](const SegmentTree::Item& item)
    {
      if (!isPolygon(item))
      {
        return false;
      }
      const auto [low, high] = std::minmax(item.A, item.B, isLower);
      int above = 0;
      int below = 0;
      visitAbove(this->All, Wedge{ low, high, high },
        [&](const SegmentTree::Item& other, int sign, bool isOn)
        {
          above += isPolygon(other) && !isOn ? sign : 0;
          below += isPolygon(other) ? sign : 0;
        });
      return above > 0 || below > 0;
    });
}

std::vector<ConstraintSegment> ConstraintSegments::list() const
{
  std::vector<ConstraintSegment> segments;
  segments.reserve(this->Roles.size() + this->Holes.items().size());
  for (const SegmentTree::Item& item : this->All.items())
  {
    segments.push_back({ item.A, item.B, this->roleOf(item) });
  }
  for (const SegmentTree::Item& item : this->Holes.items())
  {
    segments.push_back({ item.A, item.B, SegmentRole::Hole });
  }
  return segments;
}

bool ConstraintSegments::isUncut(const Box2& box) const
{
  bool isUncut = true;
  const auto look = [&](const SegmentTree& tree, const auto& isTaken)
  {
    tree.visitNear(box,
      [&](const SegmentTree::Item& item)
      {
        isUncut = isUncut && !(isTaken(item) && lineMayMeet(item.A, item.B, box));
        return isUncut;
      });
  };
  look(this->All,
    [this](const SegmentTree::Item& item) { return this->roleOf(item) != SegmentRole::Line; });
  look(this->Holes, isAny);
  return isUncut;
}

bool ConstraintSegments::keeps(const std::array<Point2, 3>& triangle) const
{
  const Wedge wedge = lowestWedge(triangle);
  int holes = 0;
  visitAbove(this->Holes, wedge, [&](const SegmentTree::Item&, int, bool) { ++holes; });
  int boundary = 0;
  int winding = 0;
  if (this->HasPolygons || this->HasBoundary)
  {
    visitAbove(this->All, wedge,
      [&](const SegmentTree::Item& item, int sign, bool)
      {
        const SegmentRole role = this->roleOf(item);
        boundary += role == SegmentRole::Boundary ? 1 : 0;
        winding += role == SegmentRole::Polygon ? sign : 0;
      });
  }
  return holes % 2 == 0 && (!this->HasBoundary || boundary % 2 != 0) &&
    (!this->HasPolygons || winding >= (this->OnlyHoles ? 0 : 1));
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintSegments.h"

#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

/// All segments as a tree; Ids are their indices in `segments`.
SegmentTree treeOf(const std::vector<ConstraintSegment>& segments)
{
  std::vector<SegmentTree::Item> items;
  items.reserve(segments.size());
  for (const ConstraintSegment& segment : segments)
  {
    items.push_back({ segment.A, segment.B, std::int64_t(items.size()) });
  }
  return SegmentTree(std::move(items));
}

SegmentTree treeOf(const std::vector<ConstraintSegment>& segments, SegmentRole role)
{
  std::vector<ConstraintSegment> some;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(some),
    [role](const ConstraintSegment& segment) { return segment.Role == role; });
  return treeOf(some);
}

/// A corner of a triangle, and the others.
struct Wedge
{
  Point2 Corner;
  Point2 One;
  Point2 Other;
};

const auto isLower = [](Point2 a, Point2 b) { return lexicographicLess(a, b); };

/// At the lexicographically lowest corner.
Wedge lowestWedge(const std::array<Point2, 3>& triangle)
{
  const auto low =
    std::size_t(std::min_element(triangle.begin(), triangle.end(), isLower) - triangle.begin());
  return { triangle[low], triangle[(low + 1) % 3], triangle[(low + 2) % 3] };
}

/// Calls visit(sign) for each segment of a tree that a ray upward crosses: 1 if the segment goes to
/// the left there, else -1. The ray begins inside of the wedge, so near its corner that only
/// segments through the corner have to be told apart by it; none goes into the wedge.
template <typename Visit>
void visitAbove(const SegmentTree& tree, const Wedge& wedge, const Visit& visit)
{
  // The other corners are not left of the corner, so the ray's x is a bit more than the corner's.
  const Point2 p = wedge.Corner;
  const double infinity = std::numeric_limits<double>::infinity();
  tree.visitNear(Box2{ p.x, p.y, p.x, infinity },
    [&](const SegmentTree::Item& item)
    {
      const bool goesLeft = item.B.x < item.A.x;
      const Point2 left = goesLeft ? item.B : item.A;
      const Point2 right = goesLeft ? item.A : item.B;
      if (!(left.x <= p.x && p.x < right.x))
      {
        return true;
      }
      int side = orientation(left, right, p); // of the ray's beginning: above is 1
      for (const Point2 other : { wedge.One, wedge.Other })
      {
        side = side == 0 ? orientation(left, right, other) : side;
      }
      if (side < 0)
      {
        visit(goesLeft ? 1 : -1);
      }
      return true;
    });
}

int windingOf(const SegmentTree& polygons, const Wedge& wedge)
{
  int winding = 0;
  visitAbove(polygons, wedge, [&winding](int sign) { winding += sign; });
  return winding;
}

/// How much more often polygons go round the left side of an edge than its right side, if the edge
/// goes from its lexicographically lower end, `low`, to `high`.
int windingAcross(const SegmentTree& polygons, Point2 low, Point2 high)
{
  int sum = 0;
  polygons.visitNear(boxOf(low, low),
    [&](const SegmentTree::Item& item)
    {
      const bool isAscending = lexicographicLess(item.A, item.B);
      const Point2 from = isAscending ? item.A : item.B;
      const Point2 to = isAscending ? item.B : item.A;
      const bool isSame = !lexicographicLess(low, from) && lexicographicLess(low, to) &&
        orientation(from, to, low) == 0 && orientation(from, to, high) == 0;
      sum += !isSame ? 0 : isAscending ? 1 : -1;
      return true;
    });
  return sum;
}

/// Whether polygons go round anything counter-clockwise: then also on one side of an edge.
bool haveInside(const SegmentTree& polygons)
{
  return std::any_of(polygons.items().begin(), polygons.items().end(),
    [&](const SegmentTree::Item& item)
    {
      const auto [low, high] = std::minmax(item.A, item.B, isLower);
      // Above the edge, or on the right of a vertical one.
      const int winding = windingOf(polygons, Wedge{ low, high, high });
      const int across = windingAcross(polygons, low, high);
      return winding > 0 || winding + (low.x == high.x ? across : -across) > 0;
    });
}

} // namespace

ConstraintSegments::ConstraintSegments(const std::vector<ConstraintSegment>& segments)
  : All(treeOf(segments))
  , Polygons(treeOf(segments, SegmentRole::Polygon))
  , Boundary(treeOf(segments, SegmentRole::Boundary))
  , OnlyHoles(!haveInside(this->Polygons))
{
  // Items are named by their position, which is the same wherever the tree is made.
  std::vector<SegmentTree::Item> items = this->All.items();
  this->Roles.reserve(items.size());
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    this->Roles.push_back(std::uint8_t(segments[std::size_t(items[i].Id)].Role));
    items[i].Id = std::int64_t(i);
  }
  this->All = SegmentTree(std::move(items)); // in the same order
}

std::vector<ConstraintSegment> ConstraintSegments::list() const
{
  std::vector<ConstraintSegment> segments;
  segments.reserve(this->Roles.size());
  for (const SegmentTree::Item& item : this->All.items())
  {
    segments.push_back(
      { item.A, item.B, static_cast<SegmentRole>(this->Roles[std::size_t(item.Id)]) });
  }
  return segments;
}

bool ConstraintSegments::isUncut(const Box2& box) const
{
  bool isUncut = true;
  for (const SegmentTree* const tree : { &this->Polygons, &this->Boundary })
  {
    tree->visitNear(box,
      [&](const SegmentTree::Item& item)
      {
        isUncut = isUncut && !lineMayMeet(item.A, item.B, box);
        return isUncut;
      });
  }
  return isUncut;
}

bool ConstraintSegments::keeps(const std::array<Point2, 3>& triangle) const
{
  const Wedge wedge = lowestWedge(triangle);
  if (this->Boundary.groups() > 0)
  {
    int crossed = 0;
    visitAbove(this->Boundary, wedge, [&crossed](int) { ++crossed; });
    if (crossed % 2 == 0)
    {
      return false;
    }
  }
  return this->Polygons.groups() == 0 ||
    windingOf(this->Polygons, wedge) >= (this->OnlyHoles ? 0 : 1);
}

} // namespace tipp

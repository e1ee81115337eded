// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/HolePoints.h"

#include "Locate/BoxTree.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>

namespace tipp
{
namespace
{

/// An edge of the border, directed with the mesh on its left.
struct BorderEdge
{
  std::int64_t From;
  std::int64_t To;
  std::int64_t Loop = -1;
};

/// The border of a mesh in loops, each of which has one part of the plane outside on its right.
class Border
{
public:
  Border(const NodesView& nodes, TrianglesView triangles,
    const std::vector<std::array<std::int64_t, 2>>& segments)
    : Nodes(nodes)
  {
    this->findEdges(triangles, segments);
    for (std::size_t i = 0; i < this->Edges.size(); ++i)
    {
      this->follow(i);
    }
    for (std::size_t i = 0; i < this->Edges.size(); ++i)
    {
      this->Bounds.extend(this->from(i));
    }
    this->Tree = BoxTree<2>(std::int64_t(this->Edges.size()), 1,
      [this](std::int64_t i)
      {
        Box2 box = Box2::of(this->from(std::size_t(i)));
        box.extend(this->to(std::size_t(i)));
        return box;
      });
  }

  std::size_t loops() const { return this->Loops.size(); }

  /// Whether a loop surrounds a hole. Then it turns right whenever it passes its leftmost node, of
  /// several the lowest. Other loops are outer borders of the mesh: they turn left there once.
  bool isHole(std::size_t loop) const;

  /// Returns a point on the right of a loop around a hole; nullopt if none is found.
  std::optional<Point2> pointIn(std::size_t loop) const;

private:
  struct Crossing
  {
    double X;
    std::size_t Edge;
    bool operator<(const Crossing& other) const
    {
      return std::tie(this->X, this->Edge) < std::tie(other.X, other.Edge);
    }
  };

  Point2 at(std::int64_t node) const { return this->Nodes[std::size_t(node)]; }
  Point2 from(std::size_t edge) const { return this->at(this->Edges[edge].From); }
  Point2 to(std::size_t edge) const { return this->at(this->Edges[edge].To); }
  bool isRising(std::size_t edge) const { return this->to(edge).y > this->from(edge).y; }
  double height(std::size_t edge) const { return std::fabs(this->to(edge).y - this->from(edge).y); }

  void findEdges(TrianglesView triangles, const std::vector<std::array<std::int64_t, 2>>& segments);
  void follow(std::size_t first);
  std::size_t next(std::size_t edge) const;
  std::optional<Point2> pointAt(double y, std::int64_t loop) const;

  const NodesView& Nodes;
  std::vector<BorderEdge> Edges;               ///< by From
  std::vector<std::vector<std::size_t>> Loops; ///< edges, in order
  Box2 Bounds = Box2::empty();
  BoxTree<2> Tree; ///< of the edges
};

/// Finds the segments with a triangle on one side only.
void Border::findEdges(
  TrianglesView triangles, const std::vector<std::array<std::int64_t, 2>>& segments)
{
  std::vector<bool> isEnd(this->Nodes.size(), false);
  std::vector<BorderEdge> sides; // in both directions
  for (const auto& [a, b] : segments)
  {
    isEnd[std::size_t(a)] = isEnd[std::size_t(b)] = true;
    sides.push_back({ a, b });
    sides.push_back({ b, a });
  }
  const auto isBefore = [](const BorderEdge& a, const BorderEdge& b)
  { return std::tie(a.From, a.To) < std::tie(b.From, b.To); };
  std::sort(sides.begin(), sides.end(), isBefore);
  std::vector<bool> hasTriangle(sides.size(), false);
  const auto find = [&](std::int64_t from, std::int64_t to)
  {
    return std::size_t(
      std::lower_bound(sides.begin(), sides.end(), BorderEdge{ from, to }, isBefore) -
      sides.begin());
  };
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::int64_t from = triangles.id(t, corner);
      const std::int64_t to = triangles.id(t, (corner + 1) % 3);
      if (isEnd[std::size_t(from)] && isEnd[std::size_t(to)])
      {
        const std::size_t side = find(from, to);
        if (side < sides.size() && sides[side].From == from && sides[side].To == to)
        {
          hasTriangle[side] = true;
        }
      }
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    if (hasTriangle[i] && !hasTriangle[find(sides[i].To, sides[i].From)])
    {
      this->Edges.push_back(sides[i]);
    }
  }
}

/// Makes the loop that an edge is in, unless it is known.
void Border::follow(std::size_t first)
{
  if (this->Edges[first].Loop >= 0)
  {
    return;
  }
  const auto loop = std::int64_t(this->Loops.size());
  this->Loops.emplace_back();
  for (std::size_t edge = first; this->Edges[edge].Loop < 0; edge = this->next(edge))
  {
    this->Edges[edge].Loop = loop;
    this->Loops.back().push_back(edge);
  }
}

/// The edge that follows in the loop: of those that leave the node, the first one counter-clockwise
/// from the edge that arrives, because there is no triangle between them.
std::size_t Border::next(std::size_t edge) const
{
  const Point2 node = this->to(edge);
  const Point2 back = this->from(edge);
  const auto isInFirstHalf = [&](std::size_t candidate)
  {
    const Point2 end = this->to(candidate);
    const int side = orientation(node, back, end);
    const Point2 u = back - node;
    const Point2 v = end - node;
    return side > 0 || (side == 0 && u.x * v.x + u.y * v.y < 0);
  };
  const auto isEarlier = [&](std::size_t a, std::size_t b)
  {
    const bool first = isInFirstHalf(a);
    return first != isInFirstHalf(b) ? first : orientation(node, this->to(a), this->to(b)) > 0;
  };
  const std::int64_t id = this->Edges[edge].To;
  const auto begin = std::lower_bound(this->Edges.begin(), this->Edges.end(), id,
    [](const BorderEdge& candidate, std::int64_t from) { return candidate.From < from; });
  auto found = std::size_t(begin - this->Edges.begin());
  for (std::size_t i = found + 1; i < this->Edges.size() && this->Edges[i].From == id; ++i)
  {
    found = isEarlier(i, found) ? i : found;
  }
  return found;
}

bool Border::isHole(std::size_t loop) const
{
  const std::vector<std::size_t>& edges = this->Loops[loop];
  Point2 leftmost = this->from(edges.front());
  for (const std::size_t edge : edges)
  {
    const Point2 p = this->from(edge);
    leftmost = std::tie(p.x, p.y) < std::tie(leftmost.x, leftmost.y) ? p : leftmost;
  }
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const std::size_t before = edges[(i + edges.size() - 1) % edges.size()];
    if (this->from(edges[i]) == leftmost &&
      orientation(this->from(before), leftmost, this->to(edges[i])) > 0)
    {
      return false;
    }
  }
  return true;
}

/// Returns the middle of the widest part of a horizontal line that is on the right of the loop.
std::optional<Point2> Border::pointAt(double y, std::int64_t loop) const
{
  std::vector<Crossing> crossings;
  this->Tree.search({ { this->Bounds.Min.x, y }, { this->Bounds.Max.x, y } },
    [&](std::int32_t i)
    {
      const auto edge = std::size_t(i);
      const Point2 a = this->from(edge);
      const Point2 b = this->to(edge);
      if ((a.y <= y) != (b.y <= y))
      {
        crossings.push_back({ a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), edge });
      }
    });
  std::sort(crossings.begin(), crossings.end());
  std::optional<Point2> found;
  double widest = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i)
  {
    const std::size_t left = crossings[i].Edge;
    const std::size_t right = crossings[i + 1].Edge;
    const double width = crossings[i + 1].X - crossings[i].X;
    const Point2 middle{ crossings[i].X + width / 2, y };
    // Crossings are rounded, so that their order is certain only if the point is between them.
    if (this->Edges[left].Loop == loop && this->isRising(left) && !this->isRising(right) &&
      width > widest && orientation(this->from(left), this->to(left), middle) < 0 &&
      orientation(this->from(right), this->to(right), middle) < 0)
    {
      widest = width;
      found = middle;
    }
  }
  return found;
}

std::optional<Point2> Border::pointIn(std::size_t loop) const
{
  std::vector<std::size_t> edges = this->Loops[loop];
  constexpr std::size_t mostTrials = 16;
  const std::size_t trials = std::min(mostTrials, edges.size());
  std::partial_sort(edges.begin(), edges.begin() + std::ptrdiff_t(trials), edges.end(),
    [this](std::size_t a, std::size_t b)
    { return std::make_tuple(-this->height(a), a) < std::make_tuple(-this->height(b), b); });
  std::optional<Point2> found;
  for (std::size_t i = 0; i < trials && !found; ++i)
  {
    const double low = this->from(edges[i]).y;
    found = this->pointAt(low + (this->to(edges[i]).y - low) / 2, std::int64_t(loop));
  }
  return found;
}

} // namespace

HolePoints findHolePoints(const NodesView& nodes, TrianglesView triangles,
  const std::vector<std::array<std::int64_t, 2>>& segments)
{
  const Border border(nodes, triangles, segments);
  HolePoints holes;
  for (std::size_t loop = 0; loop < border.loops(); ++loop)
  {
    if (border.isHole(loop))
    {
      const std::optional<Point2> point = border.pointIn(loop);
      if (point)
      {
        holes.Points.push_back(*point);
      }
      else
      {
        ++holes.TooThin;
      }
    }
  }
  return holes;
}

} // namespace tipp

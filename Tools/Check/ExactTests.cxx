// SPDX-License-Identifier: BSD-3-Clause
#include "Check/ExactTests.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>

namespace tipp
{
namespace check
{
namespace
{

class Chain
{
public:
  Chain(const std::vector<double>& xy, const std::vector<DirectedEdge>& edges)
    : XY(xy)
    , Edges(edges)
  {
  }

  // Follows the chain from its first edge. A chain that always turns left may wind around several
  // times; then it has several lexicographic minima.
  std::int64_t countFaults() const
  {
    std::int64_t faults = 0;
    std::int64_t minima = 0;
    std::size_t length = 0;
    const DirectedEdge* edge = this->Edges.data();
    do
    {
      const DirectedEdge* const next = this->edgeFrom(edge->To);
      if (!next)
      {
        return this->rest(length);
      }
      const Position a = this->at(edge->From);
      const Position b = this->at(edge->To);
      const Position c = this->at(next->To);
      faults += turnsWrongly(a, b, c) ? 1 : 0;
      minima += isBefore(b, a) && isBefore(b, c) ? 1 : 0;
      edge = next;
      ++length;
    } while (edge != this->Edges.data() && length < this->Edges.size());
    const bool closed = edge == this->Edges.data();
    return faults + (closed ? this->rest(length) : std::int64_t(this->Edges.size())) +
      (minima == 1 ? 0 : 1);
  }

private:
  std::int64_t rest(std::size_t length) const { return std::int64_t(this->Edges.size() - length); }

  static bool turnsWrongly(Position a, Position b, Position c)
  {
    const int turned = turn(a, b, c);
    return turned < 0 || (turned == 0 && isBefore(a, b) != isBefore(b, c));
  }

  Position at(std::int64_t id) const
  {
    return { this->XY[2 * std::size_t(id)], this->XY[2 * std::size_t(id) + 1] };
  }

  // Returns the edge that starts at a point; null if none or several do.
  const DirectedEdge* edgeFrom(std::int64_t id) const
  {
    const auto [first, last] =
      std::equal_range(this->Edges.begin(), this->Edges.end(), DirectedEdge{ id, 0 },
        [](const DirectedEdge& a, const DirectedEdge& b) { return a.From < b.From; });
    return last - first == 1 ? &*first : nullptr;
  }

  const std::vector<double>& XY;
  const std::vector<DirectedEdge>& Edges;
};

} // namespace

bool breaksDelaunay(Position a, Position b, Position c, Position d, bool tieRule)
{
  const int side = inCircle(a, b, c, d);
  return side > 0 ||
    (side == 0 && tieRule && isBefore(isBefore(c, d) ? d : c, isBefore(a, b) ? b : a));
}

std::int64_t countHullFaults(const std::vector<double>& xy, std::vector<DirectedEdge>& edges)
{
  std::sort(edges.begin(), edges.end(),
    [](const DirectedEdge& a, const DirectedEdge& b)
    { return a.From < b.From || (a.From == b.From && a.To < b.To); });
  return edges.empty() ? 0 : Chain(xy, edges).countFaults();
}

std::int64_t countOffHull(const std::vector<double>& xy, const std::vector<DirectedEdge>& edges)
{
  if (edges.empty())
  {
    return 0;
  }
  std::vector<Position> points;
  for (std::size_t i = 0; i + 1 < xy.size(); i += 2)
  {
    const Position p{ xy[i], xy[i + 1] };
    if (isFinite(p))
    {
      points.push_back(p);
    }
  }
  std::sort(points.begin(), points.end(), isBefore);
  points.erase(std::unique(points.begin(), points.end(), isSame), points.end());
  std::set<std::array<double, 4>> hull;
  for (const auto& half :
    { halfHull(points.begin(), points.end()), halfHull(points.rbegin(), points.rend()) })
  {
    for (std::size_t i = 1; i < half.size(); ++i)
    {
      hull.insert({ half[i - 1].x, half[i - 1].y, half[i].x, half[i].y });
    }
  }
  return std::count_if(edges.begin(), edges.end(),
    [&](const DirectedEdge& edge)
    {
      const std::size_t from = 2 * std::size_t(edge.From);
      const std::size_t to = 2 * std::size_t(edge.To);
      return hull.count({ xy[from], xy[from + 1], xy[to], xy[to + 1] }) == 0;
    });
}

} // namespace check
} // namespace tipp

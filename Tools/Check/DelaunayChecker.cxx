// SPDX-License-Identifier: BSD-3-Clause
#include "Check/DelaunayChecker.h"

#include "Check/ExactTests.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <map>
#include <utility>

namespace tipp
{
namespace
{

using check::DirectedEdge;
using check::Position;

// Index is std::uint32_t if all ids and half-edges fit: that halves the memory.
template <typename Index>
class Checker
{
public:
  Checker(const std::vector<double>& xy, const std::vector<std::int64_t>& triangles,
    const CheckOptions& options, const std::vector<std::int64_t>& neighbors)
    : XY(xy)
    , Ids(triangles)
    , Neighbors(neighbors)
    , Options(options)
  {
  }

  CheckReport run()
  {
    this->Report.Points = std::int64_t(this->XY.size() / 2);
    this->Report.Triangles = std::int64_t(this->Ids.size() / 3);
    this->checkTriangles();
    this->checkPoints();
    this->gatherEdges();
    this->checkEdges();
    if (this->Options.IsCut)
    {
      this->Report.UnusedPoints = 0;
      const auto constraints = std::remove_if(this->Boundary.begin(), this->Boundary.end(),
        [this](const DirectedEdge& edge) { return this->isConstraint(edge.From, edge.To); });
      this->Boundary.erase(constraints, this->Boundary.end());
      this->Report.OpenBoundary = check::countOffHull(this->XY, this->Boundary);
    }
    else if (!this->Options.BoundaryFree)
    {
      this->checkHull();
    }
    return this->Report;
  }

private:
  enum class State : char
  {
    Sound,
    BadTurn, // its edges count, its circumcircle does not
    BadIds   // the triangle cannot be used at all
  };

  // Half-edge h goes from corner h % 3 of triangle h / 3 to the next corner. Each is stored under
  // the lower of its two ids.
  struct HalfEdge
  {
    Index Higher;
    Index Id;
  };

  Position at(std::int64_t id) const
  {
    return { this->XY[2 * std::size_t(id)], this->XY[2 * std::size_t(id) + 1] };
  }

  bool isPoint(std::int64_t id) const
  {
    if (id < 0 || id >= this->Report.Points)
    {
      return false;
    }
    const Position p = this->at(id);
    return std::isfinite(p.x) && std::isfinite(p.y);
  }

  std::int64_t from(std::size_t h) const { return this->Ids[h]; }
  std::int64_t to(std::size_t h) const { return this->Ids[h % 3 == 2 ? h - 2 : h + 1]; }
  std::int64_t opposite(std::size_t h) const { return this->Ids[h % 3 == 0 ? h + 2 : h - 1]; }

  void checkTriangles()
  {
    const std::size_t count = this->Ids.size() / 3;
    this->States.assign(count, State::Sound);
    this->Used.assign(this->XY.size() / 2, false);
    for (std::size_t t = 0; t < count; ++t)
    {
      const std::int64_t a = this->Ids[3 * t];
      const std::int64_t b = this->Ids[3 * t + 1];
      const std::int64_t c = this->Ids[3 * t + 2];
      if (!this->isPoint(a) || !this->isPoint(b) || !this->isPoint(c))
      {
        this->States[t] = State::BadIds;
        ++this->Report.BadIds;
        continue;
      }
      for (const std::int64_t id : { a, b, c })
      {
        this->Used[std::size_t(id)] = true;
      }
      if (check::turn(this->at(a), this->at(b), this->at(c)) <= 0)
      {
        this->States[t] = State::BadTurn;
        ++this->Report.BadTurns;
      }
    }
  }

  // Each distinct point must be a vertex under one id only, unless the points are collinear.
  void checkPoints()
  {
    struct Placed
    {
      Position At;
      bool Used;
    };
    std::vector<Placed> points;
    points.reserve(this->XY.size() / 2);
    for (std::int64_t id = 0; id < this->Report.Points; ++id)
    {
      if (this->isPoint(id))
      {
        points.push_back({ this->at(id), this->Used[std::size_t(id)] });
      }
    }
    std::sort(points.begin(), points.end(),
      [](const Placed& a, const Placed& b) { return check::isBefore(a.At, b.At); });
    bool collinear = true;
    for (std::size_t first = 0, last = 0; first < points.size(); first = last)
    {
      const Position position = points[first].At;
      std::int64_t used = 0;
      for (last = first; last < points.size() && !check::isBefore(position, points[last].At);
           ++last)
      {
        used += points[last].Used ? 1 : 0;
      }
      ++this->Report.DistinctPoints;
      this->Report.UnusedPoints += used == 0 ? 1 : 0;
      this->Report.TwinVertices += std::max<std::int64_t>(used - 1, 0);
      collinear = collinear && check::turn(points.front().At, position, points.back().At) == 0;
    }
    if (collinear && this->Ids.empty())
    {
      this->Report.UnusedPoints = 0;
    }
  }

  // A counting sort by the lower id.
  void gatherEdges()
  {
    this->Starts.assign(this->XY.size() / 2 + 1, 0);
    this->forEachHalfEdge([this](std::size_t, std::int64_t lower, std::int64_t)
      { ++this->Starts[std::size_t(lower) + 1]; });
    for (std::size_t i = 1; i < this->Starts.size(); ++i)
    {
      this->Starts[i] += this->Starts[i - 1];
    }
    this->HalfEdges.resize(this->Starts.back());
    std::vector<Index> next(this->Starts.begin(), this->Starts.end() - 1);
    this->forEachHalfEdge(
      [&](std::size_t h, std::int64_t lower, std::int64_t higher) {
        this->HalfEdges[next[std::size_t(lower)]++] = { Index(higher), Index(h) };
      });
  }

  template <typename Function>
  void forEachHalfEdge(Function function)
  {
    for (std::size_t h = 0; h < this->Ids.size(); ++h)
    {
      if (this->States[h / 3] != State::BadIds)
      {
        const std::int64_t a = this->from(h);
        const std::int64_t b = this->to(h);
        function(h, std::min(a, b), std::max(a, b));
      }
    }
  }

  void checkEdges()
  {
    for (std::size_t lower = 0; lower + 1 < this->Starts.size(); ++lower)
    {
      const auto begin = this->HalfEdges.begin() + std::ptrdiff_t(this->Starts[lower]);
      const auto end = this->HalfEdges.begin() + std::ptrdiff_t(this->Starts[lower + 1]);
      std::sort(
        begin, end, [](const HalfEdge& a, const HalfEdge& b) { return a.Higher < b.Higher; });
      for (auto first = begin, last = begin; first != end; first = last)
      {
        last = std::find_if(
          first, end, [&](const HalfEdge& edge) { return edge.Higher != first->Higher; });
        this->checkEdge(first, last - first);
      }
    }
  }

  void checkEdge(typename std::vector<HalfEdge>::const_iterator edge, std::ptrdiff_t count)
  {
    const std::size_t h = edge->Id;
    if (count == 1)
    {
      ++this->Report.BoundaryEdges;
      this->Report.BadNeighbors += this->isNeighbor(h, -1) ? 0 : 1;
      this->Boundary.push_back({ this->from(h), this->to(h) });
      return;
    }
    const std::size_t twin = edge[1].Id;
    if (count > 2 || this->from(h) == this->from(twin))
    {
      ++this->Report.BadEdges;
      return;
    }
    const bool isMutual =
      this->isNeighbor(h, std::int64_t(twin / 3)) && this->isNeighbor(twin, std::int64_t(h / 3));
    this->Report.BadNeighbors += isMutual ? 0 : 1;
    if (this->States[h / 3] == State::Sound && this->States[twin / 3] == State::Sound &&
      !this->isConstraint(this->from(h), this->to(h)))
    {
      this->checkCircle(h, this->opposite(twin));
    }
  }

  bool isConstraint(std::int64_t a, std::int64_t b) const
  {
    return std::binary_search(this->Options.Constraints.begin(), this->Options.Constraints.end(),
      FixedEdge{ std::min(a, b), std::max(a, b) });
  }

  /// Whether the half-edge's triangle names `triangle` as its neighbour, or there is nothing to
  /// compare.
  bool isNeighbor(std::size_t h, std::int64_t triangle) const
  {
    return this->Neighbors.empty() || this->Neighbors[h % 3 == 0 ? h + 2 : h - 1] == triangle;
  }

  void checkCircle(std::size_t h, std::int64_t beyond)
  {
    const Position a = this->at(this->from(h));
    const Position b = this->at(this->to(h));
    const Position c = this->at(this->opposite(h));
    const Position d = this->at(beyond);
    const int side = check::inCircle(a, b, c, d);
    this->Report.BadCircles += side > 0 ? 1 : 0;
    if (side == 0)
    {
      ++this->Report.Ties;
      const Position end = check::isBefore(a, b) ? b : a;
      const Position off = check::isBefore(c, d) ? d : c;
      const bool broken = check::isBefore(off, end);
      this->Report.BadTies += this->Options.TieRule && broken ? 1 : 0;
    }
  }

  void checkHull()
  {
    if (this->Ids.empty())
    {
      return; // then every point is unused, or the points are collinear
    }
    this->Report.BadHullEdges = check::countHullFaults(this->XY, this->Boundary);
    this->Report.EulerMismatch =
      this->Report.Triangles - (2 * this->Report.DistinctPoints - 2 - this->Report.BoundaryEdges);
  }

  const std::vector<double>& XY;
  const std::vector<std::int64_t>& Ids;
  const std::vector<std::int64_t>& Neighbors;
  const CheckOptions& Options;
  CheckReport Report;
  std::vector<State> States;
  std::vector<bool> Used;
  std::vector<Index> Starts;
  std::vector<HalfEdge> HalfEdges;
  std::vector<DirectedEdge> Boundary;
};

} // namespace

std::vector<std::string> CheckReport::faults() const
{
  struct Kind
  {
    std::int64_t Count;
    const char* Text;
  };
  const Kind kinds[] = {
    { this->BadIds, "triangles name a point that does not exist or is not finite" },
    { this->BadTurns, "triangles are clockwise or flat" },
    { this->BadEdges, "edges are in three or more triangles or twice in one direction" },
    { this->BadCircles, "edges are not locally Delaunay" },
    { this->BadTies, "edges break a tie against the rule" },
    { this->UnusedPoints, "distinct points are in no triangle" },
    { this->TwinVertices, "vertices lie where another vertex lies" },
    { this->BadHullEdges, "boundary edges are not in one convex chain" },
    { this->LostConstraints, "constraints are no chain of edges" },
    { this->OpenBoundary, "boundary edges are neither constraints nor of the convex hull" },
    { this->BadNeighbors, "edges have triangles that name other neighbours" },
    { this->EulerMismatch, "triangles too many (negative: too few) by Euler's count" },
  };
  std::vector<std::string> lines;
  for (const Kind& kind : kinds)
  {
    if (kind.Count != 0)
    {
      lines.push_back(std::to_string(kind.Count) + " " + kind.Text);
    }
  }
  return lines;
}

CheckReport checkDelaunay(const std::vector<double>& xy, const std::vector<std::int64_t>& triangles,
  const CheckOptions& options, const std::vector<std::int64_t>& neighbors)
{
  constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max();
  if (xy.size() / 2 < limit && triangles.size() < limit)
  {
    return Checker<std::uint32_t>(xy, triangles, options, neighbors).run();
  }
  return Checker<std::uint64_t>(xy, triangles, options, neighbors).run();
}

namespace
{

using Ids = std::vector<std::int64_t>;

class ChainFinder
{
public:
  ChainFinder(const std::vector<double>& xy, const Ids& triangles)
    : XY(xy)
  {
    const std::int64_t points = std::int64_t(xy.size() / 2);
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::int64_t a = triangles[i + k];
        const std::int64_t b = triangles[i + (k + 1) % 3];
        if (std::min(a, b) >= 0 && std::max(a, b) < points)
        {
          this->Edges.push_back({ a, b });
          this->Edges.push_back({ b, a });
        }
      }
    }
    std::sort(this->Edges.begin(), this->Edges.end());
    this->Edges.erase(std::unique(this->Edges.begin(), this->Edges.end()), this->Edges.end());
    for (const FixedEdge& edge : this->Edges)
    {
      // Of points with equal coordinates the mesh uses one.
      this->VertexAt[{ this->x(edge[0]), this->y(edge[0]) }] = edge[0];
    }
  }

  /// Appends the edges of the constraint's chain; returns false if there is none.
  bool find(std::int64_t first, std::int64_t last, std::vector<FixedEdge>& edges)
  {
    if (!this->isFinite(first) || !this->isFinite(last) || this->isSame(first, last))
    {
      return true;
    }
    const auto a = this->VertexAt.find({ this->x(first), this->y(first) });
    const auto b = this->VertexAt.find({ this->x(last), this->y(last) });
    if (a == this->VertexAt.end() || b == this->VertexAt.end())
    {
      return false;
    }
    this->A = a->second;
    this->B = b->second;
    // Depth-first search: if vertices are a few units apart, a path may be a dead end.
    std::vector<Ids> open{ this->onward(this->A) };
    Ids way{ this->A };
    while (!open.empty() && way.back() != this->B)
    {
      if (open.back().empty())
      {
        open.pop_back();
        way.pop_back();
        continue;
      }
      way.push_back(open.back().back());
      open.back().pop_back();
      open.push_back(way.back() == this->B ? Ids{} : this->onward(way.back()));
    }
    for (std::size_t i = 1; i < way.size(); ++i)
    {
      edges.push_back({ std::min(way[i - 1], way[i]), std::max(way[i - 1], way[i]) });
    }
    return !open.empty();
  }

private:
  double x(std::int64_t id) const { return this->XY[2 * std::size_t(id)]; }
  double y(std::int64_t id) const { return this->XY[2 * std::size_t(id) + 1]; }
  bool isFinite(std::int64_t id) const
  {
    return std::isfinite(this->x(id)) && std::isfinite(this->y(id));
  }
  bool isSame(std::int64_t a, std::int64_t b) const
  {
    return this->x(a) == this->x(b) && this->y(a) == this->y(b);
  }

  /// Neighbours on the constraint that are nearer to its end, the nearest to the vertex last.
  Ids onward(std::int64_t vertex) const
  {
    Ids next;
    auto edge = std::lower_bound(this->Edges.begin(), this->Edges.end(), FixedEdge{ vertex, -1 });
    for (; edge != this->Edges.end() && (*edge)[0] == vertex; ++edge)
    {
      const std::int64_t id = (*edge)[1];
      if (this->isBefore(vertex, id) && (id == this->B || this->isBefore(id, this->B)) &&
        this->isOnConstraint(id))
      {
        next.push_back(id);
      }
    }
    std::sort(next.begin(), next.end(),
      [this](std::int64_t p, std::int64_t q) { return this->isBefore(q, p); });
    return next;
  }

  /// Whether p precedes q along the constraint in both coordinates.
  bool isBefore(std::int64_t p, std::int64_t q) const
  {
    const double signX = this->x(this->B) < this->x(this->A) ? -1 : 1;
    const double signY = this->y(this->B) < this->y(this->A) ? -1 : 1;
    return signX * this->x(p) <= signX * this->x(q) && signY * this->y(p) <= signY * this->y(q) &&
      !this->isSame(p, q);
  }

  static mpq_class twoUnits(double a, double b)
  {
    const double largest = std::max(std::fabs(a), std::fabs(b));
    return 2 * (mpq_class(std::nextafter(largest, HUGE_VAL)) - mpq_class(largest));
  }

  bool isOnConstraint(std::int64_t id) const
  {
    const mpq_class ax(this->x(this->A));
    const mpq_class ay(this->y(this->A));
    const mpq_class dx = mpq_class(this->x(this->B)) - ax;
    const mpq_class dy = mpq_class(this->y(this->B)) - ay;
    const mpq_class off = dx * (mpq_class(this->y(id)) - ay) - dy * (mpq_class(this->x(id)) - ax);
    return off == 0 ||
      abs(off) <= abs(dx) * twoUnits(this->y(this->A), this->y(this->B)) +
        abs(dy) * twoUnits(this->x(this->A), this->x(this->B));
  }

  const std::vector<double>& XY;
  std::vector<FixedEdge> Edges; ///< in both directions, sorted
  std::map<std::pair<double, double>, std::int64_t> VertexAt;
  std::int64_t A = 0; ///< the ends of the current constraint
  std::int64_t B = 0;
};

} // namespace

ConstraintChains findConstraintChains(const std::vector<double>& xy,
  const std::vector<std::int64_t>& triangles,
  const std::vector<std::array<std::int64_t, 2>>& constraints)
{
  ConstraintChains chains;
  ChainFinder finder(xy, triangles);
  for (const auto& constraint : constraints)
  {
    chains.Lost += finder.find(constraint[0], constraint[1], chains.Edges) ? 0 : 1;
  }
  std::sort(chains.Edges.begin(), chains.Edges.end());
  chains.Edges.erase(std::unique(chains.Edges.begin(), chains.Edges.end()), chains.Edges.end());
  return chains;
}

} // namespace tipp

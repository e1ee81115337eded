// SPDX-License-Identifier: BSD-3-Clause
#include "Check/DelaunayChecker.h"

#include "Check/ExactTests.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

using check::DirectedEdge;
using check::Position;

// Index is std::uint32_t if all ids and half-edges fit, which halves the memory.
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
    BadTurn, // edges are checked for it, circumcircles are not
    BadIds   // it is not checked further
  };

  // Half-edge h goes from corner h % 3 of triangle h / 3 to the next corner. It is stored at the
  // lower of its two ids.
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

  // Each distinct point must be a vertex under exactly one id, unless all points are collinear.
  void checkPoints()
  {
    struct Vertex
    {
      Position At;
      bool Used;
    };
    std::vector<Vertex> points;
    points.reserve(this->XY.size() / 2);
    for (std::int64_t id = 0; id < this->Report.Points; ++id)
    {
      if (this->isPoint(id))
      {
        points.push_back({ this->at(id), this->Used[std::size_t(id)] });
      }
    }
    std::sort(points.begin(), points.end(),
      [](const Vertex& a, const Vertex& b) { return check::isBefore(a.At, b.At); });
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

  // Sorts the half-edges by their lower id, by counting.
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

  /// Returns whether the half-edge's triangle stores `triangle` as its neighbour, or no neighbours
  /// are stored.
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
      return; // no point is a vertex, or the points are collinear
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
  return describe({
    { this->BadIds, "triangles have a point that does not exist or is not finite" },
    { this->BadTurns, "triangles are clockwise or flat" },
    { this->BadEdges, "edges are in three or more triangles or twice in one direction" },
    { this->BadCircles, "edges are not locally Delaunay" },
    { this->BadTies, "edges break a tie differently than the rule" },
    { this->UnusedPoints, "distinct points are in no triangle" },
    { this->TwinVertices, "vertices have the coordinates of another vertex" },
    { this->BadHullEdges, "boundary edges are not in one convex chain" },
    { this->LostConstraints, "constraints are not chains of edges" },
    { this->OpenBoundary, "boundary edges are neither constraints nor edges of the convex hull" },
    { this->BadNeighbors, "edges have triangles that store wrong neighbours" },
    { this->EulerMismatch, "more triangles (negative: fewer) than Euler's formula gives" },
  });
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

} // namespace tipp

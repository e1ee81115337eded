// SPDX-License-Identifier: BSD-3-Clause
#include "Check/DelaunayChecker.h"
#include "Check/ExactTests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace tipp
{
namespace
{

using check::Position3;
using Id = std::int64_t;

/// A facet of a tetrahedron, ids ascending, and the corner opposite to it.
struct Side
{
  std::array<Id, 3> Ids;
  std::size_t Slot; ///< 4 * index of the tetrahedron + that corner
};

/// An edge of a hull facet, ends ascending, and the corner opposite to it.
struct HullEdge
{
  std::array<Id, 2> Ends;
  std::size_t Facet;
  Id Apex;
};

class TetrahedraCheck
{
public:
  TetrahedraCheck(const std::vector<double>& xyz, const std::vector<Id>& ids, bool tieRule,
    const std::vector<Id>& neighbors)
    : XYZ(xyz)
    , Ids(ids)
    , Neighbors(neighbors)
    , TieRule(tieRule)
  {
  }

  CheckReport run()
  {
    this->Report.InSpace = true;
    this->Report.Points = Id(this->XYZ.size() / 3);
    this->Report.Cells = Id(this->Ids.size() / 4);
    this->checkCells();
    this->checkPoints();
    if (this->Report.BadIds == 0)
    {
      this->checkSides();
      this->checkHull();
      this->checkEuler();
    }
    return this->Report;
  }

private:
  Position3 at(Id id) const
  {
    const std::size_t i = 3 * std::size_t(id);
    return { this->XYZ[i], this->XYZ[i + 1], this->XYZ[i + 2] };
  }

  bool isPoint(Id id) const
  {
    const auto isFinite = [&](std::size_t i) { return std::isfinite(this->XYZ[i]); };
    const std::size_t i = 3 * std::size_t(id);
    return id >= 0 && id < this->Report.Points && isFinite(i) && isFinite(i + 1) && isFinite(i + 2);
  }

  int turn(Id a, Id b, Id c, Id d) const
  {
    return check::turn(this->at(a), this->at(b), this->at(c), this->at(d));
  }

  void checkCells()
  {
    this->Used.assign(this->XYZ.size() / 3, false);
    for (std::size_t t = 0; t < this->Ids.size(); t += 4)
    {
      const Id* const v = &this->Ids[t];
      if (!std::all_of(v, v + 4, [&](Id id) { return this->isPoint(id); }))
      {
        ++this->Report.BadIds;
        continue;
      }
      std::for_each(v, v + 4, [&](Id id) { this->Used[std::size_t(id)] = true; });
      this->Report.BadTurns += this->turn(v[0], v[1], v[2], v[3]) > 0 ? 0 : 1;
    }
  }

  /// Each distinct point must be a vertex under exactly one id, unless all points are in one plane.
  void checkPoints()
  {
    std::vector<Id> order;
    for (Id id = 0; id < this->Report.Points; ++id)
    {
      if (this->isPoint(id))
      {
        order.push_back(id);
      }
    }
    const auto key = [this](Id id)
    {
      const std::size_t i = 3 * std::size_t(id);
      return std::make_tuple(this->XYZ[i], this->XYZ[i + 1], this->XYZ[i + 2]);
    };
    std::sort(order.begin(), order.end(), [&](Id a, Id b) { return key(a) < key(b); });
    Id uses = 0;
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      uses += this->Used[std::size_t(order[i])] ? 1 : 0;
      if (i + 1 == order.size() || key(order[i]) != key(order[i + 1]))
      {
        ++this->Report.DistinctPoints;
        this->Report.UnusedPoints += uses == 0 ? 1 : 0;
        this->Report.TwinVertices += std::max<Id>(uses - 1, 0);
        uses = 0;
      }
    }
    if (this->Ids.empty() && this->arePlanar(order))
    {
      this->Report.UnusedPoints = 0;
    }
  }

  bool arePlanar(const std::vector<Id>& ids) const
  {
    std::vector<Id> base;
    for (const Id id : ids)
    {
      const bool extends = base.empty() ||
        (base.size() == 1 && !(this->at(base[0]) == this->at(id))) ||
        (base.size() == 2 && !areCollinear(this->at(base[0]), this->at(base[1]), this->at(id)));
      if (base.size() == 3 && this->turn(base[0], base[1], base[2], id) != 0)
      {
        return false;
      }
      if (extends && base.size() < 3)
      {
        base.push_back(id);
      }
    }
    return true;
  }

  void checkSides()
  {
    std::vector<Side> sides;
    sides.reserve(this->Ids.size());
    for (std::size_t slot = 0; slot < this->Ids.size(); ++slot)
    {
      const std::size_t first = slot / 4 * 4;
      const auto id = [&](std::size_t i) { return this->Ids[first + (slot + i) % 4]; };
      Side side{ { id(1), id(2), id(3) }, slot };
      std::sort(side.Ids.begin(), side.Ids.end());
      sides.push_back(side);
    }
    std::sort(sides.begin(), sides.end(),
      [](const Side& a, const Side& b)
      { return a.Ids != b.Ids ? a.Ids < b.Ids : a.Slot < b.Slot; });
    for (std::size_t i = 0; i < sides.size();)
    {
      std::size_t end = i + 1;
      while (end < sides.size() && sides[end].Ids == sides[i].Ids)
      {
        ++end;
      }
      this->addFacet(&sides[i], end - i);
      i = end;
    }
  }

  void addFacet(const Side* sides, std::size_t count)
  {
    ++this->Facets;
    if (count == 1)
    {
      this->Hull.push_back(sides[0].Slot);
      this->requireNeighbor(sides[0].Slot, -1);
      return;
    }
    const auto sideOf = [&](const Side& s)
    { return this->turn(s.Ids[0], s.Ids[1], s.Ids[2], this->Ids[s.Slot]); };
    if (count > 2 || sideOf(sides[0]) == sideOf(sides[1]))
    {
      ++this->Report.BadFacets;
      return;
    }
    this->requireNeighbor(sides[0].Slot, Id(sides[1].Slot / 4));
    this->requireNeighbor(sides[1].Slot, Id(sides[0].Slot / 4));
    const Id* const v = &this->Ids[sides[0].Slot / 4 * 4];
    this->checkSphere(v, this->Ids[sides[1].Slot]);
  }

  void requireNeighbor(std::size_t slot, Id cell)
  {
    this->Report.BadNeighbors +=
      this->Neighbors.empty() || (slot < this->Neighbors.size() && this->Neighbors[slot] == cell)
      ? 0
      : 1;
  }

  void checkSphere(const Id* v, Id other)
  {
    const int side =
      inSphere(this->at(v[0]), this->at(v[1]), this->at(v[2]), this->at(v[3]), this->at(other));
    this->Report.BadSpheres += side > 0 ? 1 : 0;
    this->Report.Ties += side == 0 ? 1 : 0;
    if (side == 0 && this->TieRule && this->isRaisedInside(v, other))
    {
      ++this->Report.BadTies;
    }
  }

  /// Returns how the tie rule decides for five points on a sphere: whether `other` is in conflict
  /// with the tetrahedron. Lifted to the paraboloid, each point is raised by an infinitesimal, and
  /// the lexicographically larger point by infinitely more. `other` is in conflict if it is then
  /// below the tetrahedron's hyperplane.
  bool isRaisedInside(const Id* v, Id other) const
  {
    std::array<std::size_t, 5> order = { 0, 1, 2, 3, 4 };
    const auto idAt = [&](std::size_t i) { return i == 4 ? other : v[i]; };
    std::sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return this->at(idAt(b)) < this->at(idAt(a)); });
    for (const std::size_t raised : order)
    {
      if (raised == 4)
      {
        return false;
      }
      std::array<Id, 4> corners = { v[0], v[1], v[2], v[3] };
      corners[raised] = other;
      const int side = this->turn(corners[0], corners[1], corners[2], corners[3]);
      if (side != 0)
      {
        return side > 0;
      }
    }
    return false;
  }

  /// Every edge of the hull must be in exactly two facets, which are convex there or coplanar.
  void checkHull()
  {
    this->Report.BoundaryFacets = Id(this->Hull.size());
    std::vector<HullEdge> edges;
    for (std::size_t facet = 0; facet < this->Hull.size(); ++facet)
    {
      const std::array<Id, 3> ids = this->hullFacet(facet);
      for (std::size_t i = 0; i < 3; ++i)
      {
        const auto [low, high] = std::minmax(ids[(i + 1) % 3], ids[(i + 2) % 3]);
        edges.push_back({ { low, high }, facet, ids[i] });
      }
    }
    std::sort(edges.begin(), edges.end(),
      [](const HullEdge& a, const HullEdge& b)
      { return a.Ends != b.Ends ? a.Ends < b.Ends : a.Facet < b.Facet; });
    for (std::size_t i = 0; i < edges.size(); i += 2)
    {
      const bool isPair = i + 1 < edges.size() && edges[i].Ends == edges[i + 1].Ends &&
        (i + 2 == edges.size() || edges[i + 2].Ends != edges[i].Ends);
      const auto isConvex = [&](const HullEdge& own, const HullEdge& other)
      {
        const std::array<Id, 3> f = this->hullFacet(own.Facet);
        return this->turn(f[0], f[1], f[2], other.Apex) >= 0;
      };
      if (!isPair || !isConvex(edges[i], edges[i + 1]) || !isConvex(edges[i + 1], edges[i]))
      {
        ++this->Report.BadHullEdges;
      }
    }
    // A closed surface that is convex everywhere is convex as a whole if it winds around once.
    std::vector<Id> vertices;
    vertices.reserve(edges.size());
    for (const HullEdge& edge : edges)
    {
      vertices.push_back(edge.Apex);
    }
    std::sort(vertices.begin(), vertices.end());
    const auto end = std::unique(vertices.begin(), vertices.end());
    const Id sphere = Id(end - vertices.begin()) - Id(edges.size() / 2) + Id(this->Hull.size());
    this->Report.EulerMismatch += this->Hull.empty() ? 0 : std::abs(sphere - 2);
  }

  /// Returns the corners of a hull facet, ordered so that the tetrahedron is on its positive side.
  std::array<Id, 3> hullFacet(std::size_t facet) const
  {
    const std::size_t slot = this->Hull[facet];
    const std::size_t first = slot / 4 * 4;
    constexpr std::size_t corners[4][3] = { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 0, 1, 2 } };
    const auto& c = corners[slot % 4];
    return { this->Ids[first + c[0]], this->Ids[first + c[1]], this->Ids[first + c[2]] };
  }

  void checkEuler()
  {
    std::vector<std::array<Id, 2>> edges;
    edges.reserve(this->Ids.size() / 4 * 6);
    for (std::size_t t = 0; t < this->Ids.size(); t += 4)
    {
      for (std::size_t i = 0; i < 4; ++i)
      {
        for (std::size_t j = i + 1; j < 4; ++j)
        {
          const auto [low, high] = std::minmax(this->Ids[t + i], this->Ids[t + j]);
          edges.push_back({ low, high });
        }
      }
    }
    std::sort(edges.begin(), edges.end());
    const Id edgeCount = Id(std::unique(edges.begin(), edges.end()) - edges.begin());
    const Id vertices = Id(std::count(this->Used.begin(), this->Used.end(), true));
    if (!this->Ids.empty())
    {
      this->Report.EulerMismatch +=
        std::abs(vertices - edgeCount + this->Facets - this->Report.Cells - 1);
    }
  }

  const std::vector<double>& XYZ;
  const std::vector<Id>& Ids;
  const std::vector<Id>& Neighbors;
  const bool TieRule;
  CheckReport Report;
  std::vector<bool> Used;
  std::vector<std::size_t> Hull; ///< facets of the hull, as Side::Slot
  Id Facets = 0;
};

} // namespace

CheckReport checkTetrahedra(const std::vector<double>& xyz,
  const std::vector<std::int64_t>& tetrahedra, bool tieRule,
  const std::vector<std::int64_t>& neighbors)
{
  return TetrahedraCheck(xyz, tetrahedra, tieRule, neighbors).run();
}

} // namespace tipp

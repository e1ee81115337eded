// SPDX-License-Identifier: BSD-3-Clause
#include "Check/DelaunayChecker.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace tipp
{
namespace
{

using check::Position;
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
    for (auto begin = this->Edges.begin(); begin != this->Edges.end();)
    {
      const auto end = std::find_if(
        begin, this->Edges.end(), [begin](const FixedEdge& edge) { return edge != *begin; });
      if (end - begin == 1) // an edge of one triangle only: at the mesh's border
      {
        this->Border.insert((*begin)[0]);
      }
      begin = end;
    }
    this->Edges.erase(std::unique(this->Edges.begin(), this->Edges.end()), this->Edges.end());
    for (const FixedEdge& edge : this->Edges)
    {
      // Of several points with equal coordinates, the mesh uses one: find it by the coordinates.
      this->VertexAt[{ this->x(edge[0]), this->y(edge[0]) }] = edge[0];
    }
  }

  /// Does the same as find() for a constraint of which a cut mesh has only a part. Gaps in its
  /// chain begin and end at the mesh's border.
  bool findParts(std::int64_t first, std::int64_t last, std::vector<FixedEdge>& edges)
  {
    this->A = first;
    this->B = last;
    const auto [west, east] = std::minmax({ this->x(first), this->x(last) });
    const double none = -HUGE_VAL;
    Ids on;
    for (auto at = this->VertexAt.lower_bound({ west, none });
         at != this->VertexAt.end() && at->first.first <= east; ++at)
    {
      const std::int64_t v = at->second;
      const bool isBetween = (this->isSame(v, first) || this->isBefore(first, v)) &&
        (this->isSame(v, last) || this->isBefore(v, last));
      if (isBetween && this->isOnConstraint(v))
      {
        on.push_back(v);
      }
    }
    std::sort(on.begin(), on.end(),
      [this](std::int64_t p, std::int64_t q) { return this->isBefore(p, q); });
    const auto isOnBorder = [this](std::int64_t v) { return this->Border.count(v) > 0; };
    bool isGood = on.empty() ||
      ((this->isSame(on.front(), first) || isOnBorder(on.front())) &&
        (this->isSame(on.back(), last) || isOnBorder(on.back())));
    for (std::size_t i = 1; i < on.size(); ++i)
    {
      const FixedEdge edge{ on[i - 1], on[i] };
      if (std::binary_search(this->Edges.begin(), this->Edges.end(), edge))
      {
        edges.push_back({ std::min(edge[0], edge[1]), std::max(edge[0], edge[1]) });
      }
      else
      {
        isGood = isGood && isOnBorder(on[i - 1]) && isOnBorder(on[i]);
      }
    }
    return isGood;
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
    // A depth-first search, because a path may be a dead end if vertices are only a few roundings
    // apart.
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

  /// Returns the vertex's neighbours on the constraint that are nearer to its end, in descending
  /// order of their distance from the vertex.
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
  std::vector<FixedEdge> Edges; ///< both directions of each edge; sorted
  std::map<std::pair<double, double>, std::int64_t> VertexAt;
  std::set<std::int64_t> Border; ///< vertices of edges with one triangle
  std::int64_t A = 0;            ///< the ends of the current constraint
  std::int64_t B = 0;
};

/// Finds the edges of a large mesh that may be parts of constraints, so that only these are kept in
/// memory. It may keep too many edges, but must not miss one, which would be reported as a lost
/// constraint.
class NearConstraints
{
public:
  /// `xy`: x and y of each point. `edges`: two indices of points each. Both are copied.
  NearConstraints(
    const std::vector<double>& xy, const std::vector<std::array<std::int64_t, 2>>& edges)
  {
    const auto at = [&xy](std::int64_t id) {
      return Position{ xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1] };
    };
    this->Low = { HUGE_VAL, HUGE_VAL };
    this->High = { -HUGE_VAL, -HUGE_VAL };
    double largest = 0;
    for (const auto& edge : edges)
    {
      const Segment segment{ at(edge[0]), at(edge[1]) };
      if (!check::isFinite(segment.A) || !check::isFinite(segment.B))
      {
        continue; // constraints that are not finite are ignored
      }
      this->Segments.push_back(segment);
      for (const Position p : { segment.A, segment.B })
      {
        this->Low = { std::min(this->Low[0], p.x), std::min(this->Low[1], p.y) };
        this->High = { std::max(this->High[0], p.x), std::max(this->High[1], p.y) };
        largest = std::max({ largest, std::fabs(p.x), std::fabs(p.y) });
      }
    }
    constexpr double relative = 1e-10;
    this->Tolerance = relative * largest;
    constexpr double most = 2048;
    this->Side = std::int64_t(std::clamp(std::sqrt(double(this->Segments.size())), 1.0, most));
    this->Starts.assign(std::size_t(this->Side * this->Side) + 1, 0);
    for (const Segment& segment : this->Segments)
    {
      this->visitCells(segment, [this](std::size_t cell) { ++this->Starts[cell + 1]; });
    }
    for (std::size_t cell = 1; cell < this->Starts.size(); ++cell)
    {
      this->Starts[cell] += this->Starts[cell - 1];
    }
    this->InCells.resize(this->Starts.back());
    std::vector<std::size_t> next = this->Starts;
    for (std::size_t i = 0; i < this->Segments.size(); ++i)
    {
      this->visitCells(this->Segments[i],
        [&](std::size_t cell) { this->InCells[next[cell]++] = std::uint32_t(i); });
    }
  }

  /// Returns whether both ends of an edge are within about a million rounding errors of one
  /// constraint.
  bool mayHave(Position a, Position b) const
  {
    if (this->Segments.empty())
    {
      return false;
    }
    const auto cell = std::size_t(this->cellOf(a.y, 1) * this->Side + this->cellOf(a.x, 0));
    return std::any_of(this->InCells.begin() + std::ptrdiff_t(this->Starts[cell]),
      this->InCells.begin() + std::ptrdiff_t(this->Starts[cell + 1]),
      [&](std::uint32_t s)
      { return this->isNear(a, this->Segments[s]) && this->isNear(b, this->Segments[s]); });
  }

private:
  struct Segment
  {
    Position A;
    Position B;
  };

  std::int64_t cellOf(double value, std::size_t axis) const
  {
    // Halved, because the difference could overflow.
    const double length = this->High[axis] / 2 - this->Low[axis] / 2;
    const double part = (value / 2 - this->Low[axis] / 2) / length;
    return part > 0
      ? std::min(std::int64_t(std::min(part, 1.0) * double(this->Side)), this->Side - 1)
      : 0;
  }

  /// Visits the cells that a segment crosses and their neighbours.
  template <typename Visit>
  void visitCells(const Segment& segment, const Visit& visit) const
  {
    const auto clamped = [this](std::int64_t cell)
    { return std::clamp<std::int64_t>(cell, 0, this->Side - 1); };
    const auto [bottom, top] =
      std::minmax({ this->cellOf(segment.A.y, 1), this->cellOf(segment.B.y, 1) });
    const double height = this->High[1] / 2 - this->Low[1] / 2;
    const double rise = segment.B.y / 2 - segment.A.y / 2;
    // Returns the column of the segment at the lower border of a row of cells.
    const auto columnAt = [&](std::int64_t row)
    {
      const double y = this->Low[1] / 2 + height * (double(row) / double(this->Side));
      const double part = rise == 0 ? 0 : std::clamp((y - segment.A.y / 2) / rise, 0.0, 1.0);
      return this->cellOf(segment.A.x + 2 * part * (segment.B.x / 2 - segment.A.x / 2), 0);
    };
    for (std::int64_t row = clamped(bottom - 1); row <= clamped(top + 1); ++row)
    {
      const auto [left, right] = rise == 0
        ? std::minmax({ this->cellOf(segment.A.x, 0), this->cellOf(segment.B.x, 0) })
        : std::minmax({ columnAt(row - 1), columnAt(row), columnAt(row + 1), columnAt(row + 2) });
      for (std::int64_t column = clamped(left - 1); column <= clamped(right + 1); ++column)
      {
        visit(std::size_t(row * this->Side + column));
      }
    }
  }

  bool isNear(Position p, const Segment& segment) const
  {
    const Position a = segment.A;
    const Position b = segment.B;
    const double tolerance = this->Tolerance;
    if (p.x < std::min(a.x, b.x) - tolerance || p.x > std::max(a.x, b.x) + tolerance ||
      p.y < std::min(a.y, b.y) - tolerance || p.y > std::max(a.y, b.y) + tolerance)
    {
      return false;
    }
    const double dx = b.x / 2 - a.x / 2;
    const double dy = b.y / 2 - a.y / 2;
    const double length = std::hypot(dx, dy);
    const double off = std::fabs(dx / length * (p.y - a.y) - dy / length * (p.x - a.x));
    return !(off > tolerance); // true if the computation has overflowed
  }

  std::vector<Segment> Segments;
  std::array<double, 2> Low{};
  std::array<double, 2> High{};
  double Tolerance = 0;
  std::int64_t Side = 1; ///< cells of the grid along each axis
  /// By cell: the start of its entries in InCells; one more entry at the end.
  std::vector<std::size_t> Starts;
  std::vector<std::uint32_t> InCells; ///< indices of Segments, cell by cell
};

} // namespace

ConstraintChains findConstraintChains(const std::vector<double>& xy,
  const std::vector<std::int64_t>& triangles,
  const std::vector<std::array<std::int64_t, 2>>& constraints, bool isCut)
{
  ConstraintChains chains;
  ChainFinder finder(xy, triangles);
  for (const auto& constraint : constraints)
  {
    const bool isFound = finder.find(constraint[0], constraint[1], chains.Edges) ||
      (isCut && finder.findParts(constraint[0], constraint[1], chains.Edges));
    chains.Lost += isFound ? 0 : 1;
  }
  std::sort(chains.Edges.begin(), chains.Edges.end());
  chains.Edges.erase(std::unique(chains.Edges.begin(), chains.Edges.end()), chains.Edges.end());
  return chains;
}

ConstraintChains findConstraintChains(std::size_t pieces,
  const std::function<CheckedPiece(std::size_t)>& read, const std::vector<double>& constraintXY,
  const std::vector<std::array<std::int64_t, 2>>& edges, bool isCut)
{
  const NearConstraints near(constraintXY, edges);
  std::vector<double> xy;
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> triangles;
  for (std::size_t number = 0; number < pieces; ++number)
  {
    const CheckedPiece piece = read(number);
    const auto at = [&piece](std::int64_t point)
    {
      const auto i = 2 * std::size_t(point);
      return Position{ piece.XY.at(i), piece.XY.at(i + 1) };
    };
    std::unordered_map<std::int64_t, std::int64_t> known;
    for (std::size_t t = 0; t < 3 * std::size_t(piece.OwnTriangles); t += 3)
    {
      const std::int64_t* const corners = &piece.Triangles[t];
      bool isNear = false;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const Position from = at(corners[i]);
        isNear = isNear || near.mayHave(from, isCut ? from : at(corners[(i + 1) % 3]));
      }
      for (std::size_t i = 0; isNear && i < 3; ++i)
      {
        const auto [found, isNew] = known.emplace(corners[i], std::int64_t(ids.size()));
        if (isNew)
        {
          xy.insert(xy.end(), { at(corners[i]).x, at(corners[i]).y });
          ids.push_back(piece.Ids[std::size_t(corners[i])]);
        }
        triangles.push_back(found->second);
      }
    }
  }
  // A point may be in several pieces. The first one with its coordinates represents all.
  std::map<std::pair<double, double>, std::int64_t> positions;
  for (std::int64_t& corner : triangles)
  {
    const auto i = 2 * std::size_t(corner);
    corner = positions.emplace(std::make_pair(xy[i], xy[i + 1]), corner).first->second;
  }
  const auto own = std::int64_t(xy.size() / 2);
  xy.insert(xy.end(), constraintXY.begin(), constraintXY.end());
  std::vector<std::array<std::int64_t, 2>> constraints = edges;
  for (auto& edge : constraints)
  {
    edge = { edge[0] + own, edge[1] + own };
  }
  ConstraintChains chains = findConstraintChains(xy, triangles, constraints, isCut);
  for (FixedEdge& edge : chains.Edges)
  {
    const auto [low, high] = std::minmax({ ids[std::size_t(edge[0])], ids[std::size_t(edge[1])] });
    edge = { low, high };
  }
  std::sort(chains.Edges.begin(), chains.Edges.end());
  return chains;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Check/PieceChecker.h"

#include "Check/ExactTests.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace tipp
{
namespace
{

using check::Position;

Position at(const CheckedPiece& piece, std::int32_t point)
{
  return { piece.XY[2 * std::size_t(point)], piece.XY[2 * std::size_t(point) + 1] };
}

bool isSame(Position a, Position b)
{
  return a.x == b.x && a.y == b.y;
}

constexpr std::int64_t none = -1;

std::uint64_t mix(std::uint64_t x) // the finaliser of splitmix64
{
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

} // namespace

std::uint64_t PieceChecker::hashPoint(std::int64_t id, double x, double y)
{
  std::uint64_t bits[2];
  const double xy[2] = { x, y };
  std::memcpy(bits, xy, sizeof(bits));
  return mix(std::uint64_t(id) + mix(bits[0] + mix(bits[1])));
}

void PieceChecker::add(const CheckedPiece& piece)
{
  this->Report.Triangles += piece.OwnTriangles;
  this->checkTriangles(piece);
  this->checkPoints(piece);
  this->checkEdges(piece);
}

void PieceChecker::checkTriangles(const CheckedPiece& piece)
{
  const std::size_t count = piece.Triangles.size() / 3;
  const auto points = std::int32_t(piece.Ids.size());
  this->IsGood.assign(count, 1);
  this->IsSound.assign(count, 1);
  for (std::size_t t = 0; t < count; ++t)
  {
    const std::int32_t* const corners = &piece.Triangles[3 * t];
    const bool isOwn = std::int64_t(t) < piece.OwnTriangles;
    this->IsGood[t] = std::all_of(corners, corners + 3,
      [&](std::int32_t point)
      {
        return point >= 0 && point < points && std::isfinite(at(piece, point).x) &&
          std::isfinite(at(piece, point).y);
      });
    this->Report.BadIds += isOwn && !this->IsGood[t] ? 1 : 0;
    this->IsSound[t] = this->IsGood[t] &&
      check::turn(at(piece, corners[0]), at(piece, corners[1]), at(piece, corners[2])) > 0;
    this->Report.BadTurns += isOwn && this->IsGood[t] && !this->IsSound[t] ? 1 : 0;
  }
}

/// Counts the piece's own points, the distinct ones, and those that no triangle uses. No other
/// piece is needed: a piece has all triangles at its own points, and owns all points with the same
/// coordinates.
void PieceChecker::checkPoints(const CheckedPiece& piece)
{
  std::vector<bool> used(piece.Ids.size(), false);
  for (std::size_t t = 0; t < this->IsGood.size(); ++t)
  {
    for (std::size_t i = 0; this->IsGood[t] && i < 3; ++i)
    {
      used[std::size_t(piece.Triangles[3 * t + i])] = true;
    }
  }
  std::vector<std::int32_t> own;
  for (std::size_t i = 0; i < piece.Ids.size(); ++i)
  {
    const Position p = at(piece, std::int32_t(i));
    if (piece.IsOwn[i])
    {
      ++this->Report.Points;
      const bool isGiven = piece.Ids[i] < this->Given;
      this->GivenPoints += isGiven ? 1 : 0;
      this->PointSum += isGiven ? hashPoint(piece.Ids[i], p.x, p.y) : 0;
      if (std::isfinite(p.x) && std::isfinite(p.y))
      {
        own.push_back(std::int32_t(i));
      }
    }
  }
  std::sort(own.begin(), own.end(),
    [&](std::int32_t a, std::int32_t b) { return check::isBefore(at(piece, a), at(piece, b)); });
  if (this->Options.IsCut)
  {
    this->keepHull(piece, own);
  }
  for (std::size_t first = 0, last = 0; first < own.size(); first = last)
  {
    const Position position = at(piece, own[first]);
    std::int64_t vertices = 0;
    for (last = first; last < own.size() && isSame(position, at(piece, own[last])); ++last)
    {
      vertices += used[std::size_t(own[last])] ? 1 : 0;
    }
    ++this->Report.DistinctPoints;
    this->Report.UnusedPoints += vertices == 0 ? 1 : 0;
    this->Report.TwinVertices += std::max<std::int64_t>(vertices - 1, 0);
    if (this->Line.size() < 2)
    {
      this->Line.push_back(position);
    }
    else if (this->IsCollinear)
    {
      this->IsCollinear = check::turn(this->Line[0], this->Line[1], position) == 0;
    }
  }
}

/// Keeps the points of the piece's convex hull, including those inside its edges. `points` are in
/// lexicographic order.
void PieceChecker::keepHull(const CheckedPiece& piece, const std::vector<std::int32_t>& points)
{
  for (const int side : { 1, -1 })
  {
    std::vector<Position> chain;
    for (const std::int32_t point : points)
    {
      const Position p = at(piece, point);
      while (chain.size() > 1 && side * check::turn(chain[chain.size() - 2], chain.back(), p) < 0)
      {
        chain.pop_back();
      }
      chain.push_back(p);
    }
    for (const Position p : chain)
    {
      this->HullXY.insert(this->HullXY.end(), { p.x, p.y });
    }
  }
}

PieceChecker::Edge PieceChecker::edgeOf(const CheckedPiece& piece, std::size_t h) const
{
  const std::int32_t from = piece.Triangles[h];
  const std::int32_t to = piece.Triangles[h % 3 == 2 ? h - 2 : h + 1];
  const std::size_t opposite = h % 3 == 0 ? h + 2 : h - 1;
  const std::int32_t off = piece.Triangles[opposite];
  const bool isReversed = piece.Ids[std::size_t(from)] > piece.Ids[std::size_t(to)];
  const std::int32_t low = isReversed ? to : from;
  const std::int32_t high = isReversed ? from : to;
  return { { piece.Ids[std::size_t(low)], piece.Ids[std::size_t(high)] }, isReversed,
    { at(piece, low), at(piece, high) }, at(piece, off), this->IsSound[h / 3] != 0,
    piece.Neighbors.empty() ? none : piece.CellIds[h / 3],
    piece.Neighbors.empty() ? none : piece.Neighbors[opposite] };
}

/// Sorts the half-edges by their lower point, by counting, and then the few of each point.
void PieceChecker::checkEdges(const CheckedPiece& piece)
{
  struct HalfEdge
  {
    std::int32_t Higher;
    std::uint32_t Id;
  };
  const std::size_t halfEdges = 3 * std::size_t(piece.OwnTriangles);
  const auto eachHalfEdge = [&](const auto& take)
  {
    for (std::size_t h = 0; h < halfEdges; ++h)
    {
      if (this->IsGood[h / 3])
      {
        const std::int32_t a = piece.Triangles[h];
        const std::int32_t b = piece.Triangles[h % 3 == 2 ? h - 2 : h + 1];
        take(h, std::min(a, b), std::max(a, b));
      }
    }
  };
  std::vector<std::uint32_t> starts(piece.Ids.size() + 1, 0);
  eachHalfEdge(
    [&](std::size_t, std::int32_t low, std::int32_t) { ++starts[std::size_t(low) + 1]; });
  for (std::size_t i = 1; i < starts.size(); ++i)
  {
    starts[i] += starts[i - 1];
  }
  std::vector<HalfEdge> sorted(starts.back());
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  eachHalfEdge(
    [&](std::size_t h, std::int32_t low, std::int32_t high) {
      sorted[next[std::size_t(low)]++] = { high, std::uint32_t(h) };
    });
  for (std::size_t point = 0; point + 1 < starts.size(); ++point)
  {
    const auto begin = sorted.begin() + std::ptrdiff_t(starts[point]);
    const auto end = sorted.begin() + std::ptrdiff_t(starts[point + 1]);
    std::sort(begin, end, [](const HalfEdge& a, const HalfEdge& b) { return a.Higher < b.Higher; });
    for (auto first = begin, last = begin; first != end; first = last)
    {
      last = std::find_if(
        first, end, [&](const HalfEdge& edge) { return edge.Higher != first->Higher; });
      if (last - first == 1)
      {
        this->Open.push_back(this->edgeOf(piece, first->Id));
      }
      else if (last - first == 2)
      {
        this->checkPair(this->edgeOf(piece, first[0].Id), this->edgeOf(piece, first[1].Id));
      }
      else
      {
        ++this->Report.BadEdges;
      }
    }
  }
}

bool PieceChecker::isConstraint(const Edge& edge) const
{
  return std::binary_search(
    this->Options.Constraints.begin(), this->Options.Constraints.end(), FixedEdge(edge.Ids));
}

void PieceChecker::checkPair(const Edge& a, const Edge& b)
{
  if (a.IsReversed == b.IsReversed || !isSame(a.Ends[0], b.Ends[0]) ||
    !isSame(a.Ends[1], b.Ends[1]))
  {
    ++this->Report.BadEdges;
    return;
  }
  this->Report.BadNeighbors += a.Neighbor != b.Cell || b.Neighbor != a.Cell ? 1 : 0;
  if (!a.IsSound || !b.IsSound || this->isConstraint(a))
  {
    return;
  }
  const Position from = a.Ends[a.IsReversed ? 1 : 0];
  const Position to = a.Ends[a.IsReversed ? 0 : 1];
  const int side = check::inCircle(from, to, a.Opposite, b.Opposite);
  this->Report.BadCircles += side > 0 ? 1 : 0;
  if (side == 0)
  {
    ++this->Report.Ties;
    const Position end = check::isBefore(from, to) ? to : from;
    const Position off = check::isBefore(a.Opposite, b.Opposite) ? b.Opposite : a.Opposite;
    this->Report.BadTies += this->Options.TieRule && check::isBefore(off, end) ? 1 : 0;
  }
}

/// Matches the edges between pieces. The remaining ones must be on the hull.
void PieceChecker::matchEdges()
{
  std::sort(this->Open.begin(), this->Open.end(),
    [](const Edge& a, const Edge& b) { return a.Ids < b.Ids; });
  std::size_t hull = 0;
  for (std::size_t first = 0, last = 0; first < this->Open.size(); first = last)
  {
    while (last < this->Open.size() && this->Open[last].Ids == this->Open[first].Ids)
    {
      ++last;
    }
    if (last - first == 2)
    {
      this->checkPair(this->Open[first], this->Open[first + 1]);
    }
    else if (last - first == 1)
    {
      this->Report.BadNeighbors += this->Open[first].Neighbor != none ? 1 : 0;
      this->Open[hull++] = this->Open[first];
    }
    else
    {
      ++this->Report.BadEdges;
    }
  }
  this->Open.resize(hull);
}

CheckReport PieceChecker::finish()
{
  this->matchEdges();
  this->Report.BoundaryEdges = std::int64_t(this->Open.size());
  if (this->Options.IsCut)
  {
    this->Report.UnusedPoints = 0;
    const auto constraints = std::remove_if(this->Open.begin(), this->Open.end(),
      [this](const Edge& edge) { return this->isConstraint(edge); });
    this->Open.erase(constraints, this->Open.end());
  }
  if (this->Report.Triangles == 0)
  {
    this->Report.UnusedPoints = this->IsCollinear ? 0 : this->Report.UnusedPoints;
    return this->Report;
  }
  if (this->Options.BoundaryFree)
  {
    return this->Report;
  }
  std::unordered_map<std::int64_t, std::int64_t> indices;
  std::vector<double> xy;
  std::vector<check::DirectedEdge> hull;
  for (const Edge& edge : this->Open)
  {
    std::int64_t ends[2];
    for (std::size_t i = 0; i < 2; ++i)
    {
      const auto [found, isNew] = indices.emplace(edge.Ids[i], std::int64_t(xy.size() / 2));
      if (isNew)
      {
        xy.push_back(edge.Ends[i].x);
        xy.push_back(edge.Ends[i].y);
      }
      ends[i] = found->second;
    }
    hull.push_back({ ends[edge.IsReversed ? 1 : 0], ends[edge.IsReversed ? 0 : 1] });
  }
  if (this->Options.IsCut)
  {
    xy.insert(xy.end(), this->HullXY.begin(), this->HullXY.end());
    this->Report.OpenBoundary = check::countOffHull(xy, hull);
    return this->Report;
  }
  this->Report.BadHullEdges = check::countHullFaults(xy, hull);
  this->Report.EulerMismatch =
    this->Report.Triangles - (2 * this->Report.DistinctPoints - 2 - this->Report.BoundaryEdges);
  return this->Report;
}

NearConstraints::NearConstraints(
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
    const double sum = segment.A.x + segment.A.y + segment.B.x + segment.B.y;
    if (std::isnan(sum) || std::isinf(segment.A.x) || std::isinf(segment.A.y) ||
      std::isinf(segment.B.x) || std::isinf(segment.B.y))
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
    this->visitCells(
      this->Segments[i], [&](std::size_t cell) { this->InCells[next[cell]++] = std::uint32_t(i); });
  }
}

std::int64_t NearConstraints::cellOf(double value, std::size_t axis) const
{
  // Halved, because the difference could overflow.
  const double length = this->High[axis] / 2 - this->Low[axis] / 2;
  const double part = (value / 2 - this->Low[axis] / 2) / length;
  return part > 0 ? std::min(std::int64_t(std::min(part, 1.0) * double(this->Side)), this->Side - 1)
                  : 0;
}

/// Visits the cells that a segment crosses and their neighbours.
template <typename Visit>
void NearConstraints::visitCells(const Segment& segment, const Visit& visit) const
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

bool NearConstraints::isNear(Position p, const Segment& segment) const
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

bool NearConstraints::mayHave(Position a, Position b) const
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

} // namespace tipp

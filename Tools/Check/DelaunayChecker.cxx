// SPDX-License-Identifier: BSD-3-Clause
#include "Check/DelaunayChecker.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace tipp
{
namespace
{

using check::Position;

Position at(const CheckedPiece& piece, std::int64_t point)
{
  return { piece.XY[2 * std::size_t(point)], piece.XY[2 * std::size_t(point) + 1] };
}

FixedEdge sorted(std::int64_t a, std::int64_t b)
{
  return { std::min(a, b), std::max(a, b) };
}

/// Half-edge h goes from corner h % 3 of triangle h / 3 to the next corner. Returns the next
/// half-edge of the same triangle.
std::size_t after(std::size_t h)
{
  return h % 3 == 2 ? h - 2 : h + 1;
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
  this->Report.Cells += piece.OwnTriangles;
  this->checkTriangles(piece);
  this->checkPoints(piece);
  // Indices of 32 bits halve the memory.
  std::max(piece.XY.size(), piece.Triangles.size()) < std::numeric_limits<std::uint32_t>::max()
    ? this->checkEdges<std::uint32_t>(piece)
    : this->checkEdges<std::uint64_t>(piece);
}

void PieceChecker::checkTriangles(const CheckedPiece& piece)
{
  const std::size_t count = piece.Triangles.size() / 3;
  const auto points = std::int64_t(piece.Ids.size());
  this->IsGood.assign(count, 1);
  this->IsSound.assign(count, 1);
  for (std::size_t t = 0; t < count; ++t)
  {
    const std::int64_t* const corners = &piece.Triangles[3 * t];
    const bool isOwn = std::int64_t(t) < piece.OwnTriangles;
    this->IsGood[t] = std::all_of(corners, corners + 3,
      [&](std::int64_t point)
      { return point >= 0 && point < points && check::isFinite(at(piece, point)); });
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
  std::vector<Vertex> own;
  for (std::size_t i = 0; i < piece.Ids.size(); ++i)
  {
    const Position p = at(piece, std::int64_t(i));
    if (piece.IsOwn[i])
    {
      ++this->Report.Points;
      const bool isGiven = piece.Ids[i] < this->Given;
      this->GivenPoints += isGiven ? 1 : 0;
      this->PointSum += isGiven ? hashPoint(piece.Ids[i], p.x, p.y) : 0;
      if (check::isFinite(p))
      {
        own.push_back({ p, used[i] });
      }
    }
  }
  std::sort(own.begin(), own.end(),
    [](const Vertex& a, const Vertex& b) { return check::isBefore(a.At, b.At); });
  if (this->Options.IsCut && !this->Options.BoundaryFree)
  {
    this->keepHull(own);
  }
  for (std::size_t first = 0, last = 0; first < own.size(); first = last)
  {
    const Position position = own[first].At;
    std::int64_t vertices = 0;
    for (last = first; last < own.size() && isSame(position, own[last].At); ++last)
    {
      vertices += own[last].IsUsed ? 1 : 0;
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

/// Keeps the points of the piece's convex hull, including those on its edges. `vertices` are in
/// lexicographic order.
void PieceChecker::keepHull(const std::vector<Vertex>& vertices)
{
  std::vector<Position> points(vertices.size());
  std::transform(vertices.begin(), vertices.end(), points.begin(),
    [](const Vertex& vertex) { return vertex.At; });
  for (const auto& half : { check::halfHull(points.begin(), points.end()),
         check::halfHull(points.rbegin(), points.rend()) })
  {
    for (const Position p : half)
    {
      this->HullXY.insert(this->HullXY.end(), { p.x, p.y });
    }
  }
}

PieceChecker::Edge PieceChecker::edgeOf(const CheckedPiece& piece, std::size_t h) const
{
  const std::int64_t from = piece.Triangles[h];
  const std::int64_t to = piece.Triangles[after(h)];
  const std::size_t opposite = after(after(h));
  const bool isReversed = piece.Ids[std::size_t(from)] > piece.Ids[std::size_t(to)];
  const std::int64_t low = isReversed ? to : from;
  const std::int64_t high = isReversed ? from : to;
  return { { piece.Ids[std::size_t(low)], piece.Ids[std::size_t(high)] }, isReversed,
    { at(piece, low), at(piece, high) }, at(piece, piece.Triangles[opposite]),
    this->IsSound[h / 3] != 0, piece.Neighbors.empty() ? none : piece.CellIds[h / 3],
    piece.Neighbors.empty() ? none : piece.Neighbors[opposite] };
}

/// Sorts the half-edges by their lower point, by counting, and then the few of each point. An Index
/// holds an index of a point or a half-edge.
template <typename Index>
void PieceChecker::checkEdges(const CheckedPiece& piece)
{
  struct HalfEdge
  {
    Index Higher;
    Index Id;
  };
  const auto eachHalfEdge = [&](const auto& take)
  {
    for (std::size_t t = 0; t < std::size_t(piece.OwnTriangles); ++t)
    {
      const std::int64_t* const corners = &piece.Triangles[3 * t];
      for (std::size_t i = 0; this->IsGood[t] && i < 3; ++i)
      {
        const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
        take(3 * t + i, std::size_t(low), std::size_t(high));
      }
    }
  };
  std::vector<Index> starts(piece.Ids.size() + 1, 0);
  eachHalfEdge([&](std::size_t, std::size_t low, std::size_t) { ++starts[low + 1]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<HalfEdge> byPoint(starts.back());
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  eachHalfEdge(
    [&](std::size_t h, std::size_t low, std::size_t high) {
      byPoint[next[low]++] = { Index(high), Index(h) };
    });
  for (std::size_t point = 0; point + 1 < starts.size(); ++point)
  {
    const auto begin = byPoint.begin() + std::ptrdiff_t(starts[point]);
    const auto end = byPoint.begin() + std::ptrdiff_t(starts[point + 1]);
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
        this->checkInside(piece, first[0].Id, first[1].Id);
      }
      else
      {
        ++this->Report.BadFacets;
      }
    }
  }
}

bool PieceChecker::isConstraint(const FixedEdge& ids) const
{
  return std::binary_search(
    this->Options.Constraints.begin(), this->Options.Constraints.end(), ids);
}

/// Checks an edge of two triangles of the piece.
void PieceChecker::checkInside(const CheckedPiece& piece, std::size_t h, std::size_t twin)
{
  const std::int64_t from = piece.Triangles[h];
  const std::int64_t to = piece.Triangles[after(h)];
  if (from == piece.Triangles[twin])
  {
    ++this->Report.BadFacets;
    return;
  }
  const auto hasAsNeighbor = [&piece](std::size_t own, std::size_t other)
  { return piece.Neighbors[after(after(own))] == piece.CellIds[other / 3]; };
  const bool isGood = piece.Neighbors.empty() || (hasAsNeighbor(h, twin) && hasAsNeighbor(twin, h));
  this->Report.BadNeighbors += isGood ? 0 : 1;
  const bool isFixed = !this->Options.Constraints.empty() &&
    this->isConstraint(sorted(piece.Ids[std::size_t(from)], piece.Ids[std::size_t(to)]));
  if (this->IsSound[h / 3] && this->IsSound[twin / 3] && !isFixed)
  {
    this->checkCircle(at(piece, from), at(piece, to), at(piece, piece.Triangles[after(after(h))]),
      at(piece, piece.Triangles[after(after(twin))]));
  }
}

/// Checks an edge of two triangles of different pieces.
void PieceChecker::checkPair(const Edge& a, const Edge& b)
{
  if (a.IsReversed == b.IsReversed || !isSame(a.Ends[0], b.Ends[0]) ||
    !isSame(a.Ends[1], b.Ends[1]))
  {
    ++this->Report.BadFacets;
    return;
  }
  this->Report.BadNeighbors += a.Neighbor != b.Cell || b.Neighbor != a.Cell ? 1 : 0;
  if (a.IsSound && b.IsSound && !this->isConstraint(a.Ids))
  {
    this->checkCircle(
      a.Ends[a.IsReversed ? 1 : 0], a.Ends[a.IsReversed ? 0 : 1], a.Opposite, b.Opposite);
  }
}

/// Checks the edge from a to b, with c opposite to it on the left and d on the right.
void PieceChecker::checkCircle(Position a, Position b, Position c, Position d)
{
  const int side = check::inCircle(a, b, c, d);
  this->Report.BadSpheres += side > 0 ? 1 : 0;
  if (side == 0)
  {
    ++this->Report.Ties;
    this->Report.BadTies += check::breaksDelaunay(a, b, c, d, this->Options.TieRule) ? 1 : 0;
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
      ++this->Report.BadFacets;
    }
  }
  this->Open.resize(hull);
}

CheckReport PieceChecker::finish()
{
  this->matchEdges();
  this->Report.BoundaryFacets = std::int64_t(this->Open.size());
  if (this->Options.IsCut)
  {
    this->Report.UnusedPoints = 0;
    const auto constraints = std::remove_if(this->Open.begin(), this->Open.end(),
      [this](const Edge& edge) { return this->isConstraint(edge.Ids); });
    this->Open.erase(constraints, this->Open.end());
  }
  if (this->Report.Cells == 0)
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
        xy.insert(xy.end(), { edge.Ends[i].x, edge.Ends[i].y });
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
    this->Report.Cells - (2 * this->Report.DistinctPoints - 2 - this->Report.BoundaryFacets);
  return this->Report;
}

namespace
{

/// Appends a line unless the count is 0.
void addCount(std::vector<std::string>& lines, std::int64_t count, const std::string& text)
{
  if (count != 0)
  {
    lines.push_back(std::to_string(count) + " " + text);
  }
}

} // namespace

std::vector<std::string> CheckReport::undecided() const
{
  std::vector<std::string> lines;
  addCount(lines, this->UndecidedConstraints,
    "constraints are chains of edges within several roundings, which may be right or not");
  addCount(lines, this->UndecidedEdges,
    "edges are not locally Delaunay, but may be on constraints within several roundings");
  return lines;
}

std::vector<std::string> CheckReport::faults() const
{
  std::vector<std::string> lines;
  const auto add = [&lines](std::int64_t count, const std::string& fault)
  { addCount(lines, count, fault); };
  const bool isPlanar = !this->InSpace;
  const std::string cells = isPlanar ? "triangles" : "tetrahedra";
  const std::string facets = isPlanar ? "edges" : "facets";
  add(this->BadIds, cells + " have a point that does not exist or is not finite");
  add(this->BadTurns, cells + (isPlanar ? " are clockwise or flat" : " are inverted or flat"));
  add(this->BadFacets,
    isPlanar ? "edges are in three or more triangles or twice in one direction"
             : "facets are in three or more tetrahedra, or in two on the same side");
  add(this->BadSpheres, (isPlanar ? "" : "interior ") + facets + " are not locally Delaunay");
  add(this->BadTies, facets + " break a tie differently than the rule");
  add(this->UnusedPoints,
    std::string("distinct points are in no ") + (isPlanar ? "triangle" : "tetrahedron"));
  add(this->TwinVertices, "vertices have the coordinates of another vertex");
  add(this->BadHullEdges,
    isPlanar ? "boundary edges are not in one convex chain"
             : "hull edges are where the hull is not closed or not convex");
  add(this->LostConstraints, "constraints are not chains of edges");
  add(this->OpenBoundary, "boundary edges are neither constraints nor edges of the convex hull");
  add(isPlanar ? 0 : this->EulerMismatch,
    "is the difference from Euler's formula for vertices, edges, facets and tetrahedra");
  add(this->BadNeighbors,
    isPlanar ? "edges have triangles that store wrong neighbours"
             : "corners have a wrong tetrahedron in NeighborIds");
  add(isPlanar ? this->EulerMismatch : 0,
    "more triangles (negative: fewer) than Euler's formula gives");
  return lines;
}

CheckedPiece wholeMesh(std::vector<double> xy, std::vector<std::int64_t> triangles)
{
  CheckedPiece piece;
  piece.XY = std::move(xy);
  piece.Ids.resize(piece.XY.size() / 2);
  std::iota(piece.Ids.begin(), piece.Ids.end(), std::int64_t(0));
  piece.IsOwn.assign(piece.Ids.size(), true);
  piece.Triangles = std::move(triangles);
  piece.OwnTriangles = std::int64_t(piece.Triangles.size() / 3);
  return piece;
}

CheckReport checkWhole(const CheckedPiece& mesh, const CheckOptions& options)
{
  PieceChecker checker(options);
  checker.add(mesh);
  return checker.finish();
}

CheckReport checkDelaunay(std::vector<double> xy, std::vector<std::int64_t> triangles,
  const CheckOptions& options, std::vector<std::int64_t> neighbors)
{
  CheckedPiece piece = wholeMesh(std::move(xy), std::move(triangles));
  piece.Neighbors = std::move(neighbors);
  piece.CellIds.resize(piece.Neighbors.empty() ? 0 : std::size_t(piece.OwnTriangles));
  std::iota(piece.CellIds.begin(), piece.CellIds.end(), std::int64_t(0));
  return checkWhole(piece, options);
}

} // namespace tipp

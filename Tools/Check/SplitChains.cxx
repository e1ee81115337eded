// SPDX-License-Identifier: BSD-3-Clause
#include "Check/SplitChains.h"

#include "Check/SnappedLine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tipp
{
namespace check
{

SplitChains::SplitChains(const MeshEdges& mesh)
  : Mesh(mesh)
  , Setting{ mesh, [](std::int64_t) { return true; }, mesh.borderVertices(), true }
{
  // A gap must not leave out a border vertex on the segment: there rounding alone would decide
  // whether the gap is outside of the mesh, and it could replace edges of the border.
  this->Setting.PassesAllNear = true;
  mesh.visitBorder(
    [this](std::int64_t from, std::int64_t to)
    {
      const Position p = this->Mesh.at(from);
      const Position q = this->Mesh.at(to);
      this->BorderEdges.push_back(p.x < q.x ? BorderEdge{ p, q } : BorderEdge{ q, p });
      this->Widest = std::max(this->Widest, std::fabs(q.x - p.x));
    });
  std::sort(this->BorderEdges.begin(), this->BorderEdges.end(), isWestOf);
}

/// No correct mesh has a vertex farther away. Along one axis, let M be the largest coordinate of
/// the segment's ends, and e = 2^-53.
///
/// A part of the segment, with ends p and q, is split at p + (q - p) f, with roundings of the
/// difference, of the product and of the sum. They add at most e (M + 4 |q - p|) to the distance of
/// p or q from the segment, whichever is larger. The parts' lengths fall by a factor of 2/3 or less
/// each time, because f is between 1/3 and 2/3: midpoints, and shells at powers of two. So after 94
/// splits |q - p| is below e M, as 2 M (2/3)^94 < e M. Until then the terms M sum up to 94 M, and
/// the terms 4 |q - p| to at most 4 * 3 * 2 M. Afterwards the sum is rounded to p or to q or to a
/// number between them, which is no farther away than they are, or by less than 2 e M. Together
/// this is below 120 e M, which is below 2^-46 M.
///
/// Crossings of segments are rounded before the splits: 16 rounds of this lead a segment by less
/// than 64 units (SnappedLine::reaches()), which is 2^-46 M, too. 2^-40 M leaves a factor of 32 for
/// other formulas. A mesh that is accepted has each segment within this distance, which is 5 um for
/// coordinates of 5,000 km.
///
/// A split point is between p and q in each coordinate: with f of at most 2/3, rounding cannot lead
/// it beyond, as neighbouring doubles have an exact difference. Where a vertex is in the way of the
/// rounded point, one of the doubles beside it is taken, which is between p and q, too. So the
/// chain leads forwards.
Position SplitChains::reach(Position a, Position b)
{
  constexpr double part = 0x1p-40;
  return { part * std::max(std::fabs(a.x), std::fabs(b.x)),
    part * std::max(std::fabs(a.y), std::fabs(b.y)) };
}

std::optional<Route> SplitChains::bestOf(const ConstraintRoutes& routes) const
{
  const bool areSeveral = routes.areSeveral();
  const auto gain = [&](std::int64_t from, std::int64_t to) -> std::int64_t
  { return areSeveral && this->Mesh.needsConstraint(from, to, false, true) ? 1 : 0; };
  Route route = routes.best(gain, RoutePreference::Gain);
  return this->crossesMesh(route) ? std::nullopt : std::make_optional(std::move(route));
}

/// Returns whether a gap of the route leads through triangles. Its ends have been tested: a gap
/// begins and ends outside of the mesh.
bool SplitChains::crossesMesh(const Route& route) const
{
  const SnappedLine line(route.Positions.front(), route.Positions.back(), this->Setting.WideReach);
  for (std::size_t i = 0; i + 1 < route.Positions.size(); ++i)
  {
    if (route.IsGap[i] && this->crossesBorder(route.Positions[i], route.Positions[i + 1], line))
    {
      return true;
    }
  }
  return false;
}

/// Returns whether the way between two positions crosses an edge of the border, where neither the
/// edge nor the way ends nearer to the other than rounding explains.
bool SplitChains::crossesBorder(Position from, Position to, const SnappedLine& line) const
{
  const auto [west, east] = std::minmax({ from.x, to.x });
  const auto [south, north] = std::minmax({ from.y, to.y });
  const auto edgeReaches = [this](Position p, Position q, Position end)
  { return SnappedLine(p, q, this->Setting.WideReach).reaches(end); };
  const Position first{ west - this->Widest, 0 }; // no edge that begins before it comes so far
  auto edge = std::lower_bound(
    this->BorderEdges.begin(), this->BorderEdges.end(), BorderEdge{ first, first }, isWestOf);
  for (; edge != this->BorderEdges.end() && edge->front().x <= east; ++edge)
  {
    const auto& [p, q] = *edge;
    if (q.x >= west && std::max(p.y, q.y) >= south && std::min(p.y, q.y) <= north &&
      turn(from, to, p) * turn(from, to, q) < 0 && turn(p, q, from) * turn(p, q, to) < 0 &&
      !line.reaches(p) && !line.reaches(q) && !edgeReaches(p, q, from) && !edgeReaches(p, q, to))
    {
      return true;
    }
  }
  return false;
}

} // namespace check
} // namespace tipp

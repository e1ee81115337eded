// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/BlockRefiner.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tipp
{

void BlockRefiner::enqueue(Index t)
{
  this->enqueue(t, this->Rules.judge(this->Mesh, this->at(t)));
}

/// Does what a live triangle needs.
BlockRefiner::Outcome BlockRefiner::improve(Index t, RefinementRules::Need need)
{
  Triangle& triangle = this->at(t);
  const std::array<Point2, 3> corners = this->pointsOf(triangle);
  if (!this->owns(corners))
  {
    return Outcome::Waits;
  }
  if (need == RefinementRules::Need::Segment)
  {
    return this->splitEncroached(t);
  }
  const Point2 p = this->Rules.pointFor(corners);
  const Outcome outcome = isFinite(p) ? this->insertFor(t, p) : Outcome::Impossible;
  if (outcome == Outcome::Impossible)
  {
    triangle.State |= RefinementMesh::IsGivenUp;
    ++this->Counted.GivenUp;
  }
  return outcome;
}

/// Inserts p for a triangle that is in conflict with it, or splits the subsegments that p is beyond
/// or encroaches upon.
BlockRefiner::Outcome BlockRefiner::insertFor(Index t, Point2 p)
{
  const Triangle& triangle = this->at(t);
  const std::int32_t a = this->see(triangle.Corner[0], p);
  const std::int32_t b = this->see(triangle.Corner[1], p);
  const std::int32_t c = this->see(triangle.Corner[2], p);
  this->FirstFan = 0;
  this->add(t);
  this->Regions[0] = triangle.State >> RefinementMesh::RegionShift << RefinementMesh::RegionShift;
  this->push(t, 1, c, a);
  this->push(t, 0, b, c);
  this->push(t, 2, a, b);
  if (!this->isInConflict(this->Seen[std::size_t(b)], this->Seen[std::size_t(a)],
        -this->Stack[2].Cross, this->Seen[std::size_t(c)], this->Stack[1].Cross,
        this->Stack[0].Cross, p))
  {
    this->closeAgain();
    return Outcome::Impossible; // the rounded point is on its circle
  }
  const Outcome grown = this->grow(p);
  if (grown == Outcome::Waits)
  {
    this->closeAgain();
    return grown;
  }
  this->InWay.clear();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Edge& edge : this->Rim)
  {
    const SeenVertex& start = this->Seen[std::size_t(edge.Start)];
    nearest = std::min(nearest, start.Square);
    if (!RefinementMesh::isSegment(edge.Outer))
    {
      continue;
    }
    const SeenVertex& stop = this->Seen[std::size_t(edge.Stop)];
    if (!this->isLeftOf(edge, p) ||
      this->Rules.isInLens(start.X * stop.X + start.Y * stop.Y, start.Square, stop.Square))
    {
      this->InWay.push_back(edge);
    }
  }
  if (!this->InWay.empty())
  {
    this->closeAgain();
    return this->splitInWay(t);
  }
  if (grown == Outcome::Impossible ||
    nearest <= this->Rules.ShortestEdge * this->Rules.ShortestEdge)
  {
    this->closeAgain();
    return Outcome::Impossible;
  }
  this->insert(p, RefinementMesh::Free);
  return Outcome::Done;
}

/// Splits the first subsegment that the triangle's vertices encroach upon.
BlockRefiner::Outcome BlockRefiner::splitEncroached(Index t)
{
  Triangle& triangle = this->at(t);
  for (int i = 0; i < 3; ++i)
  {
    if (RefinementMesh::isSegment(triangle.Across[std::size_t(i)]) &&
      this->Rules.isEncroached(this->pointOf(triangle.Corner[std::size_t(RefinementMesh::next(i))]),
        this->pointOf(triangle.Corner[std::size_t(RefinementMesh::previous(i))]),
        this->pointOf(triangle.Corner[std::size_t(i)])))
    {
      const Outcome outcome = this->split(t, i);
      if (outcome != Outcome::Impossible)
      {
        return outcome;
      }
    }
  }
  triangle.State |= RefinementMesh::KeepsSegments;
  this->enqueue(t); // it may need something else
  return Outcome::Done;
}

/// Splits the subsegments InWay instead of inserting the point for the triangle, which then gets
/// its turn again.
BlockRefiner::Outcome BlockRefiner::splitInWay(Index t)
{
  const std::uint32_t version = this->at(t).Version;
  std::vector<std::uint32_t> versions; // of the inner triangles: a split may replace others, too
  for (const Edge& edge : this->InWay)
  {
    versions.push_back(this->at(RefinementMesh::triangleOf(edge.Inner)).Version);
  }
  bool isSplit = false;
  bool waits = false;
  for (std::size_t i = 0; i < versions.size(); ++i)
  {
    const Link edge = this->InWay[i].Inner;
    if (this->Mesh.isLive(RefinementMesh::triangleOf(edge), versions[i]))
    {
      const Outcome outcome =
        this->split(RefinementMesh::triangleOf(edge), RefinementMesh::cornerOf(edge));
      isSplit |= outcome == Outcome::Done;
      waits |= outcome == Outcome::Waits;
    }
  }
  if (isSplit)
  {
    if (this->Mesh.isLive(t, version))
    {
      this->enqueue(t);
    }
    return Outcome::Done;
  }
  return waits ? Outcome::Waits : Outcome::Impossible;
}

/// Where to split a subsegment: at its middle; near an input point with a sharp angle, on a circle
/// around the point whose radius is a power of two, so that all segments there are split at equal
/// distances and their subsegments do not encroach upon each other (Ruppert 1995, A Delaunay
/// refinement algorithm for quality 2-dimensional mesh generation).
Point2 BlockRefiner::splitPoint(Index a, Index b, const InputSegment& segment) const
{
  const auto isSharp = [&](Index vertex)
  {
    const Index origin = this->Mesh.Origins[std::size_t(vertex)];
    if (!RefinementMesh::isInput(origin))
    {
      return false;
    }
    return segment.IsSharp[RefinementMesh::inputId(origin) == segment.Ids[0] ? 0 : 1];
  };
  Point2 from = this->pointOf(a);
  Point2 to = this->pointOf(b);
  const bool sharpA = isSharp(a);
  const bool sharpB = isSharp(b);
  if (sharpA == sharpB)
  {
    if (lexicographicLess(to, from)) // the same point from both sides
    {
      std::swap(from, to);
    }
    return { from.x + (to.x - from.x) / 2, from.y + (to.y - from.y) / 2 };
  }
  if (sharpB)
  {
    std::swap(from, to);
  }
  const double length =
    std::sqrt((to.x - from.x) * (to.x - from.x) + (to.y - from.y) * (to.y - from.y));
  constexpr double most = 1.5; // between 1/3 and 2/3 of the length
  const double fraction = std::exp2(std::floor(std::log2(length / most))) / length;
  return { from.x + (to.x - from.x) * fraction, from.y + (to.y - from.y) * fraction };
}

/// Splits the subsegment opposite to a corner of a triangle that the block owns.
BlockRefiner::Outcome BlockRefiner::split(Index t, int corner)
{
  const Triangle& triangle = this->at(t);
  const Index a = triangle.Corner[std::size_t(RefinementMesh::next(corner))];
  const Index b = triangle.Corner[std::size_t(RefinementMesh::previous(corner))];
  const Link outer = triangle.Across[std::size_t(corner)];
  if (this->Rules.KeepsSegments || (this->Rules.KeepsBorder && outer == RefinementMesh::Outside))
  {
    return Outcome::Impossible;
  }
  if (outer != RefinementMesh::Outside &&
    !this->owns(this->pointsOf(this->at(RefinementMesh::triangleOf(outer)))))
  {
    return Outcome::Waits;
  }
  const Point2 from = this->pointOf(a);
  const Point2 to = this->pointOf(b);
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  if (dx * dx + dy * dy < 4 * this->Rules.ShortestEdge * this->Rules.ShortestEdge)
  {
    return Outcome::Impossible;
  }
  const Index number = this->Mesh.segmentOf(a, b);
  const Point2 middle = this->splitPoint(a, b, this->Mesh.Segments[std::size_t(number)]);
  // The rounded point may be beside its subsegment, where a vertex is in the way. Then one of the
  // doubles around it is taken.
  constexpr std::array<std::array<int, 2>, 9> tries{ { { 0, 0 }, { 1, 0 }, { -1, 0 }, { 0, 1 },
    { 0, -1 }, { 1, 1 }, { 1, -1 }, { -1, 1 }, { -1, -1 } } };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [x, y] : tries)
  {
    const Point2 p{ x == 0 ? middle.x : std::nextafter(middle.x, x * infinity),
      y == 0 ? middle.y : std::nextafter(middle.y, y * infinity) };
    const Outcome outcome = this->growAtSegment(t, corner, p);
    if (outcome == Outcome::Done)
    {
      this->insert(p, RefinementMesh::onSegment(number));
      ++this->Counted.Splits;
      return Outcome::Done;
    }
    this->closeAgain();
    if (outcome == Outcome::Waits)
    {
      return outcome;
    }
  }
  return Outcome::Impossible;
}

/// Makes a triangle part of the cavity.
void BlockRefiner::add(Index t)
{
  this->at(t).State |= RefinementMesh::IsInCavity;
  this->Cavity.append() = t;
}

/// Returns the index of a vertex in Seen.
std::int32_t BlockRefiner::see(Index vertex, Point2 p)
{
  const Point2 place = this->pointOf(vertex);
  SeenVertex& seen = this->Seen.append();
  seen.X = place.x - p.x;
  seen.Y = place.y - p.y;
  seen.Square = seen.X * seen.X + seen.Y * seen.Y;
  seen.Vertex = vertex;
  return std::int32_t(this->Seen.size()) - 1;
}

/// Appends the edge opposite to a corner of a triangle of the cavity to the stack.
void BlockRefiner::push(Index t, int corner, std::int32_t start, std::int32_t stop)
{
  set(this->Stack.append(), crossOf(this->Seen[std::size_t(start)], this->Seen[std::size_t(stop)]),
    start, stop, RefinementMesh::linkTo(t, corner), this->at(t).Across[std::size_t(corner)]);
}

/// Whether p is strictly to the left of an edge.
bool BlockRefiner::isLeftOf(const Edge& edge, Point2 p) const
{
  const SeenVertex& start = this->Seen[std::size_t(edge.Start)];
  const SeenVertex& stop = this->Seen[std::size_t(edge.Stop)];
  // The products are at most half the sum of the squares; see orientation().
  constexpr double relative = 8.9e-16;
  constexpr double absolute = 1e-300;
  const double bound = relative * (start.Square + stop.Square) + absolute;
  return std::fabs(edge.Cross) > bound
    ? edge.Cross > 0
    : orientation(this->pointOf(start.Vertex), this->pointOf(stop.Vertex), p) > 0;
}

/// Whether the triangle across an edge, with this apex, is in conflict with p: p is strictly inside
/// its circle. The products are start x stop, start x apex and apex x stop.
inline bool BlockRefiner::isInConflict(const SeenVertex& start, const SeenVertex& stop,
  double cross, const SeenVertex& apex, double startCross, double crossStop, Point2 p) const
{
  const double determinant =
    stop.Square * startCross + start.Square * crossStop - apex.Square * cross;
  const double bound = inCircleErrorBound(start.Square + stop.Square + apex.Square);
  return std::fabs(determinant) > bound
    ? determinant > 0
    : inCircleExact(
        this->pointOf(stop.Vertex), this->pointOf(start.Vertex), this->pointOf(apex.Vertex), p) > 0;
}

/// Grows the cavity across the edges in the stack, whose last one is the first in counter-clockwise
/// order, to all triangles in conflict with p that can be reached without crossing a subsegment.
/// Since the cavity has no vertex inside, depth first finds its boundary in order.
BlockRefiner::Outcome BlockRefiner::grow(Point2 p)
{
  Outcome outcome = Outcome::Done;
  while (!this->Stack.empty())
  {
    const Edge& edge = this->Stack.takeLast();
    const double cross = edge.Cross;
    const std::int32_t from = edge.Start;
    const std::int32_t to = edge.Stop;
    const Link inner = edge.Inner;
    const Link outer = edge.Outer;
    if (RefinementMesh::isSegment(outer))
    {
      set(this->Rim.append(), cross, from, to, inner, outer);
      continue;
    }
    const Index t = RefinementMesh::triangleOf(outer);
    const int entry = RefinementMesh::cornerOf(outer);
    const Triangle& beside = this->at(t);
    const Index vertex = beside.Corner[std::size_t(entry)];
    const Point2 place = this->pointOf(vertex);
    const double x = place.x - p.x;
    const double y = place.y - p.y;
    const SeenVertex apex{ x, y, x * x + y * y, vertex };
    const SeenVertex& start = this->Seen[std::size_t(from)];
    const SeenVertex& stop = this->Seen[std::size_t(to)];
    const double startCross = crossOf(start, apex);
    const double crossStop = crossOf(apex, stop);
    if (!this->isInConflict(start, stop, cross, apex, startCross, crossStop, p))
    {
      set(this->Rim.append(), cross, from, to, inner, outer);
      continue;
    }
    if ((beside.State & RefinementMesh::IsInCavity) != 0)
    {
      outcome = Outcome::Impossible; // around the end of a segment, which hides p
      continue;
    }
    if (!this->owns(place)) // the block has the edge's ends
    {
      return Outcome::Waits;
    }
    this->add(t);
    const auto index = std::int32_t(this->Seen.size());
    SeenVertex& seen = this->Seen.append();
    seen.X = x;
    seen.Y = y;
    seen.Square = apex.Square;
    seen.Vertex = vertex;
    const int after = RefinementMesh::next(entry);
    const int last = RefinementMesh::previous(entry);
    set(this->Stack.append(), crossStop, index, to, RefinementMesh::linkTo(t, last),
      beside.Across[std::size_t(last)]);
    set(this->Stack.append(), startCross, from, index, RefinementMesh::linkTo(t, after),
      beside.Across[std::size_t(after)]);
  }
  return outcome;
}

/// The cavity of p, which splits the subsegment opposite to a corner: the triangles in conflict on
/// both sides, if p can be connected to its whole boundary.
BlockRefiner::Outcome BlockRefiner::growAtSegment(Index t, int corner, Point2 p)
{
  this->FirstFan = 0;
  Link side = RefinementMesh::linkTo(t, corner);
  for (std::size_t i = 0; i < 2 && side != RefinementMesh::Outside; ++i)
  {
    const Index base = RefinementMesh::triangleOf(side);
    const int apexCorner = RefinementMesh::cornerOf(side);
    const int startCorner = RefinementMesh::next(apexCorner);
    const int stopCorner = RefinementMesh::previous(apexCorner);
    const Triangle& triangle = this->at(base);
    const std::int32_t apex = this->see(triangle.Corner[std::size_t(apexCorner)], p);
    const std::int32_t start = this->see(triangle.Corner[std::size_t(startCorner)], p);
    const std::int32_t stop = this->see(triangle.Corner[std::size_t(stopCorner)], p);
    const SeenVertex& seenStart = this->Seen[std::size_t(start)];
    const SeenVertex& seenStop = this->Seen[std::size_t(stop)];
    this->push(base, stopCorner, apex, start);
    this->push(base, startCorner, stop, apex);
    // In conflict, except after an unlucky rounding.
    if ((triangle.State & RefinementMesh::IsInCavity) != 0 ||
      !this->isInConflict(seenStop, seenStart, crossOf(seenStop, seenStart),
        this->Seen[std::size_t(apex)], this->Stack[1].Cross, this->Stack[0].Cross, p))
    {
      return Outcome::Impossible;
    }
    this->Regions[i] = triangle.State >> RefinementMesh::RegionShift << RefinementMesh::RegionShift;
    this->add(base);
    const Outcome outcome = this->grow(p);
    if (outcome != Outcome::Done)
    {
      return outcome;
    }
    if (i == 0)
    {
      this->FirstFan = this->Rim.size();
    }
    side = triangle.Across[std::size_t(apexCorner)];
  }
  for (const Edge& edge : this->Rim)
  {
    if (!this->isLeftOf(edge, p))
    {
      return Outcome::Impossible;
    }
  }
  return Outcome::Done;
}

/// Gives up the cavity.
void BlockRefiner::closeAgain()
{
  for (const Index t : this->Cavity)
  {
    this->at(t).State &= ~std::uint32_t(RefinementMesh::IsInCavity);
  }
  this->Cavity.clear();
  this->Rim.clear();
  this->Stack.clear();
  this->Seen.clear();
}

/// Replaces the triangles of the cavity by those that connect p with the edges of its boundary.
/// They reuse the slots; two or, at the border, one are new. If FirstFan is not 0, p splits a
/// subsegment, and the edges before FirstFan are those on its one side.
void BlockRefiner::insert(Point2 p, Index origin)
{
  RefinementMesh& mesh = this->Mesh;
  const Index vertex =
    this->PointPlaces.take(mesh.PointEnd, RefinementMesh::PointsInGroup, mesh.Points.capacity());
  mesh.Points[std::size_t(vertex)] = p;
  mesh.Origins[std::size_t(vertex)] = origin;
  const std::size_t count = this->Rim.size();
  this->Made.assign(this->Cavity.begin(), this->Cavity.end());
  while (this->Made.size() < count)
  {
    this->Made.push_back(this->TrianglePlaces.take(
      mesh.TriangleEnd, RefinementMesh::TrianglesInGroup, mesh.Triangles.capacity()));
  }
  Index before = this->Made[count - 1];
  for (std::size_t i = 0; i < count; ++i)
  {
    const Edge& edge = this->Rim[i];
    const Index t = this->Made[i];
    Triangle& made = this->at(t);
    made.Corner = { vertex, this->Seen[std::size_t(edge.Start)].Vertex,
      this->Seen[std::size_t(edge.Stop)].Vertex };
    ++made.Version;
    made.Across = { edge.Outer, RefinementMesh::linkTo(this->Made[i + 1 < count ? i + 1 : 0], 2),
      RefinementMesh::linkTo(before, 1) };
    made.State =
      RefinementMesh::IsLive | this->Regions[i < this->FirstFan || this->FirstFan == 0 ? 0 : 1];
    before = t;
    if (edge.Outer != RefinementMesh::Outside)
    {
      this->at(RefinementMesh::triangleOf(edge.Outer))
        .Across[std::size_t(RefinementMesh::cornerOf(edge.Outer))] =
        RefinementMesh::linkTo(t, 0) | (edge.Outer & RefinementMesh::IsSegment);
    }
  }
  if (this->FirstFan > 0)
  {
    this->markSpokes(count);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    this->enqueueMade(this->Rim[i], this->Made[i]);
  }
  ++this->Counted.Inserted;
  this->Cavity.clear();
  this->Rim.clear();
  this->Seen.clear();
}

/// Enqueues the new triangle at an edge of the cavity if it needs something.
inline void BlockRefiner::enqueueMade(const Edge& edge, Index t)
{
  const SeenVertex& start = this->Seen[std::size_t(edge.Start)];
  const SeenVertex& stop = this->Seen[std::size_t(edge.Stop)];
  const double x = stop.X - start.X;
  const double y = stop.Y - start.Y;
  const std::array<double, 3> squares{ x * x + y * y, stop.Square, start.Square };
  const Triangle& triangle = this->at(t);
  if (this->Rules.mayNeed(triangle, squares, edge.Cross))
  {
    this->enqueue(t, this->Rules.judge(this->Mesh, triangle, squares, edge.Cross));
  }
}

/// Marks the edges between the new vertex and the ends of the subsegment that it splits.
void BlockRefiner::markSpokes(std::size_t count)
{
  const bool isAtBorder = this->FirstFan == count;
  const auto mark = [&](std::size_t first)
  {
    const std::size_t last = first > 0 ? first - 1 : count - 1;
    Link& from = this->at(this->Made[first]).Across[2];
    Link& to = this->at(this->Made[last]).Across[1];
    from = isAtBorder ? RefinementMesh::Outside : from | RefinementMesh::IsSegment;
    to = isAtBorder ? RefinementMesh::Outside : to | RefinementMesh::IsSegment;
  };
  mark(0);
  if (!isAtBorder)
  {
    mark(this->FirstFan);
  }
}

} // namespace tipp

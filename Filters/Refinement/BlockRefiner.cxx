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
  const std::array<Point2, 3> corners = this->Mesh.cornersOf(triangle);
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
  this->SecondSide = 0;
  this->add(t);
  this->Regions[0] = triangle.State >> RefinementMesh::RegionShift << RefinementMesh::RegionShift;
  this->push(t, 1, c, a);
  this->push(t, 0, b, c);
  this->push(t, 2, a, b);
  if (!isInConflict(this->Seen[std::size_t(b)], this->Seen[std::size_t(a)], -this->Stack[2].Cross,
        this->Seen[std::size_t(c)], this->Stack[1].Cross, this->Stack[0].Cross, p,
        this->Mesh.Points.data()))
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
  for (std::size_t i = 0; i < this->RimEnd; ++i)
  {
    const Edge& edge = this->Rim[i];
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
  if (grown == Outcome::Impossible || nearest < this->Rules.ShortestEdge * this->Rules.ShortestEdge)
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
    !this->owns(this->Mesh.cornersOf(this->at(RefinementMesh::triangleOf(outer)))))
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
  // doubles around it is taken, in the box of the ends: each chain leads forwards in x and in y.
  constexpr std::array<std::array<int, 2>, 9> tries{ { { 0, 0 }, { 1, 0 }, { -1, 0 }, { 0, 1 },
    { 0, -1 }, { 1, 1 }, { 1, -1 }, { -1, 1 }, { -1, -1 } } };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [x, y] : tries)
  {
    const Point2 p{ x == 0 ? middle.x : std::nextafter(middle.x, x * infinity),
      y == 0 ? middle.y : std::nextafter(middle.y, y * infinity) };
    if (p.x < std::min(from.x, to.x) || p.x > std::max(from.x, to.x) ||
      p.y < std::min(from.y, to.y) || p.y > std::max(from.y, to.y))
    {
      continue;
    }
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

/// Makes the lists of the cavity longer.
void BlockRefiner::enlarge()
{
  const std::size_t size = std::max<std::size_t>(256, 2 * this->Cavity.size());
  this->Cavity.resize(size);
  this->Rim.resize(size);
  this->Stack.resize(size);
  this->Seen.resize(size);
}

/// Makes a triangle part of the cavity. A cavity of n triangles has no vertex inside, so it has n +
/// 2 edges in its boundary and the stack, and as many vertices; a segment has 3 vertices twice.
inline void BlockRefiner::add(Index t)
{
  constexpr std::size_t more = 8;
  if (__builtin_expect(this->CavityEnd + more > this->Cavity.size(), 0))
  {
    this->enlarge();
  }
  this->at(t).State |= RefinementMesh::IsInCavity;
  this->Cavity[this->CavityEnd++] = t;
}

/// Returns the index of a vertex in Seen.
inline std::int32_t BlockRefiner::see(Index vertex, Point2 p)
{
  const Point2 position = this->pointOf(vertex);
  SeenVertex& seen = this->Seen[this->SeenEnd];
  seen.X = position.x - p.x;
  seen.Y = position.y - p.y;
  seen.Square = seen.X * seen.X + seen.Y * seen.Y;
  seen.Vertex = vertex;
  return std::int32_t(this->SeenEnd++);
}

/// Appends the edge opposite to a corner of a triangle of the cavity to the stack.
inline void BlockRefiner::push(Index t, int corner, std::int32_t start, std::int32_t stop)
{
  set(this->Stack[this->StackEnd++],
    crossOf(this->Seen[std::size_t(start)], this->Seen[std::size_t(stop)]), start, stop,
    RefinementMesh::linkTo(t, corner), this->at(t).Across[std::size_t(corner)]);
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

namespace
{

/// A call of its own, so that the usual path keeps its numbers in registers.
[[gnu::cold, gnu::noinline]] bool isInside(Point2 a, Point2 b, Point2 c, Point2 p)
{
  return inCircleExact(a, b, c, p) > 0;
}

} // namespace

/// Whether the triangle across an edge, with this apex, is in conflict with p: p is strictly inside
/// its circle. The products are start x stop, start x apex and apex x stop.
inline bool BlockRefiner::isInConflict(const SeenVertex& start, const SeenVertex& stop,
  double cross, const SeenVertex& apex, double startCross, double crossStop, Point2 p,
  const Point2* points)
{
  const double determinant =
    stop.Square * startCross + start.Square * crossStop - apex.Square * cross;
  const double bound = inCircleErrorBound(start.Square + stop.Square + apex.Square);
  if (__builtin_expect(std::fabs(determinant) > bound, 1))
  {
    return determinant > 0;
  }
  return isInside(points[stop.Vertex], points[start.Vertex], points[apex.Vertex], p);
}

/// Grows the cavity across the edges in the stack, whose last one is the first in counter-clockwise
/// order, to all triangles in conflict with p that can be reached without crossing a subsegment.
/// Since the cavity has no vertex inside, depth first finds its boundary in order.
BlockRefiner::Outcome BlockRefiner::grow(Point2 p)
{
  Outcome outcome = Outcome::Done;
  const Triangle* const triangles = this->Mesh.Triangles.data();
  const Point2* const points = this->Mesh.Points.data();
  // Elements are written in place, member by member: copying a whole one that was just written in
  // parts would stall the processor.
  Edge* stack = this->Stack.data();
  Edge* rim = this->Rim.data();
  SeenVertex* seen = this->Seen.data();
  std::size_t stackEnd = this->StackEnd;
  std::size_t rimEnd = this->RimEnd;
  while (stackEnd > 0)
  {
    const Edge& edge = stack[--stackEnd];
    const double cross = edge.Cross;
    const std::int32_t from = edge.Start;
    const std::int32_t to = edge.Stop;
    const Link inner = edge.Inner;
    const Link outer = edge.Outer;
    if (RefinementMesh::isSegment(outer))
    {
      set(rim[rimEnd++], cross, from, to, inner, outer);
      continue;
    }
    const int entry = RefinementMesh::cornerOf(outer);
    const Triangle& beside = triangles[std::size_t(RefinementMesh::triangleOf(outer))];
    const Index vertex = beside.Corner[std::size_t(entry)];
    const Point2 position = points[vertex];
    // Beyond the end: it becomes a vertex of the cavity if the triangle does.
    SeenVertex& apex = seen[this->SeenEnd];
    apex.X = position.x - p.x;
    apex.Y = position.y - p.y;
    apex.Square = apex.X * apex.X + apex.Y * apex.Y;
    apex.Vertex = vertex;
    const double startCross = crossOf(seen[from], apex);
    const double crossStop = crossOf(apex, seen[to]);
    if (!isInConflict(seen[from], seen[to], cross, apex, startCross, crossStop, p, points))
    {
      set(rim[rimEnd++], cross, from, to, inner, outer);
      continue;
    }
    if ((beside.State & RefinementMesh::IsInCavity) != 0)
    {
      outcome = Outcome::Impossible; // around the end of a segment, which hides p
      continue;
    }
    if (!this->owns(position)) // the block has the edge's ends
    {
      outcome = Outcome::Waits;
      break;
    }
    const Index t = RefinementMesh::triangleOf(outer);
    const auto index = std::int32_t(this->SeenEnd++);
    this->add(t);
    stack = this->Stack.data();
    rim = this->Rim.data();
    seen = this->Seen.data();
    const int after = RefinementMesh::next(entry);
    const int last = RefinementMesh::previous(entry);
    set(stack[stackEnd++], crossStop, index, to, RefinementMesh::linkTo(t, last),
      beside.Across[std::size_t(last)]);
    set(stack[stackEnd++], startCross, from, index, RefinementMesh::linkTo(t, after),
      beside.Across[std::size_t(after)]);
  }
  this->StackEnd = stackEnd;
  this->RimEnd = rimEnd;
  return outcome;
}

/// The cavity of p, which splits the subsegment opposite to a corner: the triangles in conflict on
/// both sides, if p can be connected to its whole boundary by edges that are not too short.
BlockRefiner::Outcome BlockRefiner::growAtSegment(Index t, int corner, Point2 p)
{
  this->FirstFan = 0;
  this->SecondSide = 1;
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
      !isInConflict(seenStop, seenStart, crossOf(seenStop, seenStart),
        this->Seen[std::size_t(apex)], this->Stack[1].Cross, this->Stack[0].Cross, p,
        this->Mesh.Points.data()))
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
      this->FirstFan = this->RimEnd;
    }
    side = triangle.Across[std::size_t(apexCorner)];
  }
  const double shortest = this->Rules.ShortestEdge * this->Rules.ShortestEdge;
  for (std::size_t i = 0; i < this->RimEnd; ++i)
  {
    const Edge& edge = this->Rim[i];
    if (this->Seen[std::size_t(edge.Start)].Square < shortest || !this->isLeftOf(edge, p))
    {
      return Outcome::Impossible;
    }
  }
  return Outcome::Done;
}

/// Gives up the cavity.
void BlockRefiner::closeAgain()
{
  for (std::size_t i = 0; i < this->CavityEnd; ++i)
  {
    this->at(this->Cavity[i]).State &= ~std::uint32_t(RefinementMesh::IsInCavity);
  }
  this->clearCavity();
}

/// Replaces the triangles of the cavity by those that connect p with the edges of its boundary.
/// They reuse the slots; two or, at the border, one are new. If FirstFan is not 0, p splits a
/// subsegment, and the edges before FirstFan are those on its one side.
void BlockRefiner::insert(Point2 p, Index origin)
{
  RefinementMesh& mesh = this->Mesh;
  const Index vertex =
    this->PointPlaces.take(mesh.Points, mesh.PointEnd, RefinementMesh::PointsInGroup);
  mesh.Origins.grow(std::size_t(vertex) + 1);
  mesh.Points[std::size_t(vertex)] = p;
  mesh.Origins[std::size_t(vertex)] = origin;
  const std::size_t count = this->RimEnd;
  while (this->CavityEnd < count)
  {
    this->Cavity[this->CavityEnd++] =
      this->TrianglePlaces.take(mesh.Triangles, mesh.TriangleEnd, RefinementMesh::TrianglesInGroup);
  }
  Triangle* const triangles = mesh.Triangles.data();
  const Index* const slots = this->Cavity.data();
  const Edge* const rim = this->Rim.data();
  const SeenVertex* const seen = this->Seen.data();
  Index before = slots[count - 1];
  Index t = slots[0];
  for (std::size_t i = 0; i < count; ++i)
  {
    const Edge& edge = rim[i];
    const Index after = slots[i + 1 < count ? i + 1 : 0];
    const Link outer = edge.Outer;
    Triangle& made = triangles[t];
    made.Corner[0] = vertex;
    made.Corner[1] = seen[edge.Start].Vertex;
    made.Corner[2] = seen[edge.Stop].Vertex;
    ++made.Version;
    made.Across[0] = outer;
    made.Across[1] = RefinementMesh::linkTo(after, 2);
    made.Across[2] = RefinementMesh::linkTo(before, 1);
    made.State = RefinementMesh::IsLive | this->Regions[i < this->FirstFan ? 0 : this->SecondSide];
    if (outer != RefinementMesh::Outside)
    {
      triangles[RefinementMesh::triangleOf(outer)]
        .Across[std::size_t(RefinementMesh::cornerOf(outer))] =
        RefinementMesh::linkTo(t, 0) | (outer & RefinementMesh::IsSegment);
    }
    before = t;
    t = after;
  }
  if (this->FirstFan > 0)
  {
    this->markSpokes(count);
  }
  this->enqueueMade(count);
  ++this->Counted.Inserted;
  this->clearCavity();
}

/// Enqueues the new triangles that need something.
void BlockRefiner::enqueueMade(std::size_t count)
{
  const RefinementRules::Limits limits = this->Rules.limits();
  const SeenVertex* const seen = this->Seen.data();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Edge& edge = this->Rim[i];
    const SeenVertex& start = seen[edge.Start];
    const SeenVertex& stop = seen[edge.Stop];
    const double x = stop.X - start.X;
    const double y = stop.Y - start.Y;
    const std::array<double, 3> squares{ x * x + y * y, stop.Square, start.Square };
    if (RefinementMesh::isSegment(edge.Outer) || this->FirstFan > 0 ||
      limits.areMissed(squares, edge.Cross))
    {
      const Index t = this->Cavity[i];
      this->enqueue(t, this->Rules.judge(this->Mesh, this->at(t), squares, edge.Cross));
    }
  }
}

/// Marks the edges between the new vertex and the ends of the subsegment that it splits.
void BlockRefiner::markSpokes(std::size_t count)
{
  const bool isAtBorder = this->FirstFan == count;
  const auto mark = [&](std::size_t first)
  {
    const std::size_t last = first > 0 ? first - 1 : count - 1;
    Link& from = this->at(this->Cavity[first]).Across[2];
    Link& to = this->at(this->Cavity[last]).Across[1];
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

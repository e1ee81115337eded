// SPDX-License-Identifier: BSD-3-Clause
#include "SweepKernel.h"

#include "Predicates/Circumball.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

/// The front has one or two vertices for each point near the line, about the square root of all
/// points. It is triangulated again with each strip, so a strip has many times as many points.
std::size_t chooseStrip(std::size_t points)
{
  constexpr double roots = 24;
  constexpr std::size_t least = 8192;
  return std::max(least, std::size_t(roots * std::sqrt(double(points))));
}

/// Whether the closed half-plane to the left of the line from a to b meets the box.
bool halfPlaneMeets(Point2 a, Point2 b, const Box2& box)
{
  const Point2 corners[4] = { { box.Min.x, box.Min.y }, { box.Max.x, box.Min.y },
    { box.Max.x, box.Max.y }, { box.Min.x, box.Max.y } };
  return std::any_of(
    corners, corners + 4, [&](Point2 corner) { return orientation(a, b, corner) >= 0; });
}

} // namespace

void SweepKernel::triangulate(const Point2* points, std::size_t count, const Sink& sink)
{
  this->Duplicates.clear();
  this->Points.clear();
  this->Places.clear();
  this->FrontSize = this->Carried = 0;
  if (count == 0)
  {
    return;
  }
  const SweepStrips strips(
    points, count, this->PointsInStrip > 0 ? this->PointsInStrip : chooseStrip(count));
  for (std::size_t strip = 0, next = 0; strip < strips.size(); strip = next)
  {
    // If circumdisks are large, the front is large too. Then several strips are inserted at once.
    constexpr std::size_t times = 4;
    const std::size_t start = strips.start(strip);
    for (next = strip + 1;
         next < strips.size() && strips.start(next) - start < times * this->FrontSize;)
    {
      ++next;
    }
    this->takeStrip(points, strips.order().data() + start, strips.start(next) - start);
    if (!this->Kernel.hasTriangles())
    {
      this->FrontSize = this->Points.size();
      continue;
    }
    this->nameDuplicates();
    this->States.assign(this->Kernel.triangleCount(), State::Unknown);
    if (next < strips.size())
    {
      this->findFront(strips.boxFrom(next));
    }
    this->collectFinal(strips.boxFrom(strip));
    sink(this->Finished);
    this->collectFront();
  }
}

/// Inserts the front's vertices first, so that they are the representatives of later duplicates.
void SweepKernel::takeStrip(const Point2* points, const std::uint32_t* places, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Places.push_back(places[i]);
    this->Points.push_back(points[places[i]]);
  }
  this->Kernel.clear();
  this->Kernel.insert(this->Points.data(), this->FrontSize);
  this->Kernel.insert(this->Points.data() + this->FrontSize, count);
}

/// Makes the lowest index the representative. Points of different strips have different x, so no
/// duplicate is a vertex of an earlier triangle.
void SweepKernel::nameDuplicates()
{
  for (const DelaunayKernel::Duplicate& found : this->Kernel.duplicates())
  {
    std::uint32_t& place = this->Places[found.Point];
    std::uint32_t& representative = this->Places[this->Kernel.pointIndex(found.Vertex)];
    if (place < representative)
    {
      std::swap(place, representative);
    }
  }
  for (const DelaunayKernel::Duplicate& found : this->Kernel.duplicates())
  {
    this->Duplicates.push_back(
      { this->Places[found.Point], this->Places[this->Kernel.pointIndex(found.Vertex)] });
  }
}

bool SweepKernel::meets(Index triangle, const Box2& box) const
{
  const std::array<Index, 3> v = this->Kernel.corners(triangle);
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (v[i] == DelaunayKernel::Infinite)
    {
      return halfPlaneMeets(
        this->Kernel.point(v[(i + 1) % 3]), this->Kernel.point(v[(i + 2) % 3]), box);
    }
  }
  return Circumdisk(this->Kernel.point(v[0]), this->Kernel.point(v[1]), this->Kernel.point(v[2]))
    .meets(box);
}

/// Finds all triangles that meet the box, by a walk from one to the next: these triangles are
/// connected, because a straight walk from one to a point of its disk in the box, and a walk inside
/// the box, only visit triangles that meet it. All inserted points are to the left of the box, so
/// at least one infinite triangle meets it.
void SweepKernel::findFront(const Box2& ahead)
{
  std::size_t first = 0;
  while (!this->Kernel.isInfinite(DelaunayKernel::triangle(first)) ||
    !this->meets(DelaunayKernel::triangle(first), ahead))
  {
    ++first;
  }
  this->Stack.assign(1, DelaunayKernel::triangle(first));
  this->States[first] = State::Front;
  while (!this->Stack.empty())
  {
    const Index t = this->Stack.back();
    this->Stack.pop_back();
    for (Index i = 0; i < 3; ++i)
    {
      this->visit(this->Kernel.neighbour(t, i), ahead);
    }
  }
}

void SweepKernel::visit(Index triangle, const Box2& ahead)
{
  State& state = this->States[DelaunayKernel::number(triangle)];
  if (state == State::Unknown)
  {
    state = this->meets(triangle, ahead) ? State::Front : State::Final;
    if (state == State::Front)
    {
      this->Stack.push_back(triangle);
    }
  }
}

/// Collects the triangles that do not belong to the new front. A triangle whose vertices are all of
/// the last front may not be in the whole triangulation, or is already final. In both cases it does
/// not meet the box of the points that were still missing before this strip.
void SweepKernel::collectFinal(const Box2& before)
{
  this->Finished.clear();
  this->Kernel.forEach(
    [&](Index t)
    {
      if (this->States[DelaunayKernel::number(t)] == State::Front || this->Kernel.isInfinite(t))
      {
        return;
      }
      const auto [u, v, w] = this->Kernel.corners(t);
      const std::array<std::uint32_t, 3> places = { this->Kernel.pointIndex(u),
        this->Kernel.pointIndex(v), this->Kernel.pointIndex(w) };
      const bool isOld = *std::max_element(places.begin(), places.end()) < this->FrontSize;
      if (!isOld || this->meets(t, before))
      {
        this->Finished.push_back(
          { this->Places[places[0]], this->Places[places[1]], this->Places[places[2]] });
      }
    });
}

void SweepKernel::collectFront()
{
  std::vector<bool> isFront(std::size_t(this->Kernel.vertexEnd()), false);
  for (std::size_t t = 0; t < this->States.size(); ++t)
  {
    if (this->States[t] == State::Front)
    {
      for (const Index v : this->Kernel.corners(DelaunayKernel::triangle(t)))
      {
        isFront[std::size_t(v)] = true;
      }
    }
  }
  std::vector<Point2> points;
  std::vector<std::uint32_t> places;
  for (Index v = 1; v < this->Kernel.vertexEnd(); ++v)
  {
    if (isFront[std::size_t(v)])
    {
      points.push_back(this->Kernel.point(v));
      places.push_back(this->Places[this->Kernel.pointIndex(v)]);
    }
  }
  this->Points.swap(points);
  this->Places.swap(places);
  this->FrontSize = this->Points.size();
  this->Carried += this->FrontSize;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/Dataflow3.h"

#include <algorithm>
#include <limits>

namespace tipp
{

Vertex3 Worker3::vertex(Index v) const
{
  const std::size_t i = this->Kernel.pointIndex(v);
  return i < this->Own.Count
    ? Vertex3{ this->Kernel.point(v), this->Own.id(i), this->Own.Partition }
    : this->Others[i - this->Own.Count];
}

/// Takes the inbox's vertices of other partitions.
void Worker3::collect(const std::vector<VertexMessage3>& inbox)
{
  this->Others.clear();
  for (const VertexMessage3& message : inbox)
  {
    std::copy_if(message.Vertices.begin(), message.Vertices.end(), std::back_inserter(this->Others),
      [this](const Vertex3& v) { return v.Partition != this->Own.Partition; });
  }
  keepUnique(this->Others);
}

/// Returns a box around the own region, bounded by a plane for each later region: across the axis
/// with the widest gap to that region. Returns the own region if a later one overlaps it.
Box3 Worker3::boxBesideLater() const
{
  const Box3& own = this->Regions[std::size_t(this->Own.Partition)];
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box3 box{ { -infinity, -infinity, -infinity }, { infinity, infinity, infinity } };
  for (const PartitionIndex q : this->Order.later(this->Own.Partition))
  {
    const Box3& later = this->Regions[std::size_t(q)];
    double widest = -1;
    std::size_t axis = 0;
    bool isAbove = false;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double above = later.Min[k] - own.Max[k];
      const double below = own.Min[k] - later.Max[k];
      if (std::max(above, below) > widest)
      {
        widest = std::max(above, below);
        axis = k;
        isAbove = above > below;
      }
    }
    if (widest < 0)
    {
      return own;
    }
    double& side = isAbove ? box.Max[axis] : box.Min[axis];
    side = isAbove ? std::min(side, later.Min[axis]) : std::max(side, later.Max[axis]);
  }
  return box;
}

void Worker3::measureVertices()
{
  this->Vertices.resize(this->Kernel.vertexEnd());
  const Box3& box = this->Interior;
  for (Index v = 1; v < this->Kernel.vertexEnd(); ++v)
  {
    const std::size_t i = this->Kernel.pointIndex(v);
    const bool isOwn = i < this->Own.Count;
    const Point3& p = this->Kernel.point(v);
    this->Vertices[v] = isOwn ? Measured{ this->Own.id(i),
      std::min({ p.x - box.Min.x, box.Max.x - p.x, p.y - box.Min.y, box.Max.y - p.y,
        p.z - box.Min.z, box.Max.z - p.z }) }
                              : Measured{ this->Others[i - this->Own.Count].Id, -1 };
  }
}

SentMessages3 Worker3::triangulate(const PartitionPoints3& points,
  const std::vector<VertexMessage3>& inbox, FinalCellConsumer3& final)
{
  this->Own = points;
  this->collect(inbox);
  // The partition's own points first, so that they represent points with the same coordinates.
  const std::vector<Point3> others = positionsOf(this->Others);
  std::vector<Point3> all(points.Points, points.Points + points.Count);
  all.insert(all.end(), others.begin(), others.end());
  this->Kernel.triangulate(all.data(), all.size());
  return this->routeAll(final);
}

void Worker3::begin(const PartitionPoints3& points, const DelaunayKernel3::Monitor& proceed)
{
  this->Own = points;
  this->Kernel.triangulate(points.Points, points.Count, proceed, 1, points.Count / 8);
}

SentMessages3 Worker3::finish(const std::vector<VertexMessage3>& inbox, FinalCellConsumer3& final)
{
  if (this->Kernel.dimension() < 3)
  {
    return this->triangulate(this->Own, inbox, final);
  }
  this->collect(inbox);
  const std::vector<Point3> others = positionsOf(this->Others);
  this->Kernel.add(others.data(), others.size());
  return this->routeAll(final);
}

/// Routes the tetrahedra of the partition's own points and Others.
//
// Few need their circumball tested. If the ball of a tetrahedron t reaches a half-space beyond a
// side of Interior at a point q, follow a ray from t to q: the powers of q do not increase along
// it, so all balls on the way reach q, up to a tetrahedron that contains q or is at the hull. Own
// points are inside, so the former has a corner with Slack <= 0. From such tetrahedra, all those
// that are not inside are reached across facets.
SentMessages3 Worker3::routeAll(FinalCellConsumer3& final)
{
  this->VertexCount += this->Own.Count + this->Others.size();
  this->Outgoing.assign(this->Order.later(this->Own.Partition).size(), {});
  this->Beside = this->boxBesideLater();
  const bool isAny = this->Inside == InsideCells::Any;
  this->Interior = isAny ? this->Beside : this->Regions[std::size_t(this->Own.Partition)];
  this->measureVertices();
  this->IsTested.assign(this->Kernel.numberEnd(), 0);
  this->ToTest.clear();
  this->Kernel.forEach([&](Index cell) { this->findBorder(cell); });
  for (std::size_t i = 0; i < this->ToTest.size(); ++i)
  {
    this->route(this->ToTest[i], final);
  }
  this->Kernel.forEach(
    [&](Index cell)
    {
      if (!this->Kernel.isInfinite(cell) && this->IsTested[DelaunayKernel3::number(cell)] == 0)
      {
        this->addInside(cell, final);
      }
    });
  this->takeDuplicates();
  return this->send();
}

void Worker3::test(Index cell)
{
  if (!this->Kernel.isInfinite(cell) && this->IsTested[DelaunayKernel3::number(cell)] == 0)
  {
    this->IsTested[DelaunayKernel3::number(cell)] = 1;
    this->ToTest.push_back(cell);
  }
}

/// Chooses the tetrahedra that are tested first.
void Worker3::findBorder(Index cell)
{
  if (this->Kernel.isInfinite(cell))
  {
    this->test(this->Kernel.neighbour(cell, 0));
    return;
  }
  const std::array<Index, 4> v = this->Kernel.corners(cell);
  if (std::any_of(
        v.begin(), v.end(), [this](Index corner) { return !(this->Vertices[corner].Slack > 0); }))
  {
    this->test(cell);
  }
}

void Worker3::addInside(Index cell, FinalCellConsumer3& final) const
{
  const std::array<Index, 4> v = this->Kernel.corners(cell);
  final.addInside({ this->Vertices[v[0]].Id, this->Vertices[v[1]].Id, this->Vertices[v[2]].Id,
    this->Vertices[v[3]].Id });
}

void Worker3::takeDuplicates()
{
  for (const DelaunayKernel3::Duplicate& duplicate : this->Kernel.duplicates())
  {
    if (duplicate.Point < this->Own.Count)
    {
      this->Duplicates.push_back(
        { this->Own.id(duplicate.Point), this->Own.id(this->Kernel.pointIndex(duplicate.Vertex)) });
    }
  }
}

void Worker3::route(Index cell, FinalCellConsumer3& final)
{
  const std::array<Index, 4> v = this->Kernel.corners(cell);
  const Point3& a = this->Kernel.point(v[0]);
  const Point3& b = this->Kernel.point(v[1]);
  const Point3& c = this->Kernel.point(v[2]);
  const Point3& d = this->Kernel.point(v[3]);
  const auto isOwn = [this](Index corner) { return this->Vertices[corner].Slack >= 0; };
  const bool areOwn = std::all_of(v.begin(), v.end(), isOwn);
  if (areOwn &&
    (Circumball::isSurelySmall(a, b, c, d, this->Vertices[v[0]].Slack) ||
      Circumball::isSurelyInside(a, b, c, d, this->Interior)))
  {
    this->addInside(cell, final);
    return;
  }
  for (Index i = 0; i < 4; ++i)
  {
    this->test(this->Kernel.neighbour(cell, i));
  }
  const auto add = [&] {
    final.add({ this->vertex(v[0]), this->vertex(v[1]), this->vertex(v[2]), this->vertex(v[3]) });
  };
  // A ball passes through its corners, so it meets the region if one of them is an own point.
  const bool meetsRegion = areOwn || std::any_of(v.begin(), v.end(), isOwn);
  if (meetsRegion && Circumball::isSurelyInside(a, b, c, d, this->Beside))
  {
    add();
    return;
  }
  const Circumball ball(a, b, c, d);
  if (!meetsRegion && !ball.meets(this->Regions[std::size_t(this->Own.Partition)]))
  {
    return;
  }
  const PartitionOrder::LaterPartitions later = this->Order.later(this->Own.Partition);
  const auto next = std::find_if(later.begin(), later.end(),
    [&](PartitionIndex q) { return ball.meets(this->Regions[std::size_t(q)]); });
  if (next == later.end())
  {
    add();
    return;
  }
  this->Outgoing[std::size_t(next - later.begin())].push_back(v);
}

SentMessages3 Worker3::send()
{
  SentMessages3 sent = messagesWith(this->Own.Partition, this->Outgoing, this->Kernel.vertexEnd(),
    [this](Index v) { return this->vertex(v); });
  const PartitionOrder::LaterPartitions later = this->Order.later(this->Own.Partition);
  for (auto& [to, message] : sent)
  {
    to = later.begin()[to];
  }
  return sent;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/Dataflow3.h"

#include "Predicates/InSphere.h"

#include <algorithm>
#include <array>

namespace tipp
{
namespace
{

using Index = DelaunayKernel3::Index;

/// Sorts vertices by id, and removes repetitions.
void keepUnique(std::vector<Vertex3>& vertices)
{
  std::sort(vertices.begin(), vertices.end(),
    [](const Vertex3& a, const Vertex3& b) { return a.Id < b.Id; });
  vertices.erase(std::unique(vertices.begin(), vertices.end(),
                   [](const Vertex3& a, const Vertex3& b) { return a.Id == b.Id; }),
    vertices.end());
}

Circumball ballOf(const DelaunayKernel3& kernel, const std::array<Index, 4>& v)
{
  return { kernel.point(v[0]), kernel.point(v[1]), kernel.point(v[2]), kernel.point(v[3]) };
}

} // namespace

void FinalCells::add(const Vertex3& a, const Vertex3& b, const Vertex3& c, const Vertex3& d)
{
  if (!a.isArtificial() && !b.isArtificial() && !c.isArtificial() && !d.isArtificial())
  {
    this->Cells.push_back({ a.Id, b.Id, c.Id, d.Id });
    return;
  }
  for (const Vertex3& v : { a, b, c, d })
  {
    if (!v.isArtificial())
    {
      this->HullVertices.push_back(v);
    }
  }
}

Vertex3 Worker3::vertex(PartitionIndex p, Index v) const
{
  const std::size_t own = this->Buckets.count(p);
  const std::size_t i = this->Kernel.pointIndex(v);
  return i < own ? Vertex3{ this->Kernel.point(v),
    this->Buckets.Ids[this->Buckets.Begins[std::size_t(p)] + i], p }
                 : this->Others[i - own];
}

/// The partition's own points first, so that they stand for points with the same coordinates.
void Worker3::collect(PartitionIndex p)
{
  this->Others.clear();
  for (const VertexMessage3& message : this->Inboxes[std::size_t(p)].take())
  {
    std::copy_if(message.Vertices.begin(), message.Vertices.end(), std::back_inserter(this->Others),
      [p](const Vertex3& v) { return v.Partition != p; });
  }
  keepUnique(this->Others);
  const auto first = this->Buckets.Points.begin();
  this->Points.assign(first + std::ptrdiff_t(this->Buckets.Begins[std::size_t(p)]),
    first + std::ptrdiff_t(this->Buckets.Begins[std::size_t(p) + 1]));
  for (const Vertex3& v : this->Others)
  {
    this->Points.push_back(v.Position);
  }
}

void Worker3::triangulate(PartitionIndex p, FinalCells& final)
{
  this->collect(p);
  this->Kernel.triangulate(this->Points.data(), this->Points.size());
  this->VertexCount += this->Points.size();
  this->Outgoing.assign(this->Order.later(p).size(), {});
  this->Ids.resize(this->Kernel.vertexEnd());
  for (Index v = 1; v < this->Kernel.vertexEnd(); ++v)
  {
    this->Ids[v] = this->vertex(p, v).Id;
  }
  this->Kernel.forEach(
    [&](Index cell)
    {
      if (!this->Kernel.isInfinite(cell))
      {
        this->route(p, cell, final);
      }
    });
  this->send(p);
  const std::size_t own = this->Buckets.count(p);
  const std::int32_t* const ids = &this->Buckets.Ids[this->Buckets.Begins[std::size_t(p)]];
  for (const DelaunayKernel3::Duplicate& duplicate : this->Kernel.duplicates())
  {
    if (duplicate.Point < own)
    {
      this->Duplicates.push_back(
        { ids[duplicate.Point], ids[this->Kernel.pointIndex(duplicate.Vertex)] });
    }
  }
}

void Worker3::route(PartitionIndex p, Index cell, FinalCells& final)
{
  const std::array<Index, 4> v = this->Kernel.corners(cell);
  const std::vector<Box3>& regions = this->Buckets.Regions;
  if (!Circumball::isSurelyInside(this->Kernel.point(v[0]), this->Kernel.point(v[1]),
        this->Kernel.point(v[2]), this->Kernel.point(v[3]), regions[std::size_t(p)]))
  {
    const Circumball ball = ballOf(this->Kernel, v);
    if (!ball.meets(regions[std::size_t(p)]))
    {
      return;
    }
    const PartitionOrder::Range later = this->Order.later(p);
    const auto next = std::find_if(later.begin(), later.end(),
      [&](PartitionIndex q) { return ball.meets(regions[std::size_t(q)]); });
    if (next != later.end())
    {
      std::vector<Index>& corners = this->Outgoing[std::size_t(next - later.begin())];
      corners.insert(corners.end(), v.begin(), v.end());
      return;
    }
  }
  const CellIds ids = { this->Ids[v[0]], this->Ids[v[1]], this->Ids[v[2]], this->Ids[v[3]] };
  if (std::all_of(ids.begin(), ids.end(), [](std::int32_t id) { return id >= 0; }))
  {
    final.Cells.push_back(ids);
    return;
  }
  final.add(
    this->vertex(p, v[0]), this->vertex(p, v[1]), this->vertex(p, v[2]), this->vertex(p, v[3]));
}

void Worker3::send(PartitionIndex p)
{
  const PartitionOrder::Range later = this->Order.later(p);
  this->SentTo.assign(this->Kernel.vertexEnd(), 0);
  for (std::size_t i = 0; i < this->Outgoing.size(); ++i)
  {
    VertexMessage3 message{ p, {} };
    for (const Index v : this->Outgoing[i])
    {
      if (this->SentTo[v] != i + 1)
      {
        this->SentTo[v] = static_cast<std::uint32_t>(i + 1);
        message.Vertices.push_back(this->vertex(p, v));
      }
    }
    if (!message.Vertices.empty())
    {
      this->Inboxes[std::size_t(later.begin()[i])].put(std::move(message));
    }
  }
}

void sendInitialMesh(const InitialMesh3& mesh, const PartitionOrder& order,
  std::vector<Inbox3>& inboxes, FinalCells& final)
{
  std::vector<VertexMessage3> messages(inboxes.size());
  for (std::size_t cell = 0; cell < mesh.Cells.size(); ++cell)
  {
    const auto& [a, b, c, d] = mesh.Cells[cell];
    const auto& all = mesh.Vertices;
    if (mesh.metBegin(cell) == mesh.metEnd(cell))
    {
      final.add(all[a], all[b], all[c], all[d]);
      continue;
    }
    const PartitionIndex* const met = mesh.Met.data();
    const PartitionIndex to = order.first(met + mesh.metBegin(cell), met + mesh.metEnd(cell));
    auto& vertices = messages[std::size_t(to)].Vertices;
    vertices.insert(vertices.end(), { all[a], all[b], all[c], all[d] });
  }
  for (std::size_t p = 0; p < messages.size(); ++p)
  {
    keepUnique(messages[p].Vertices);
    inboxes[p].put(std::move(messages[p]));
  }
}

void repairHull(const std::vector<Vertex3>& artificial, FinalCells& final)
{
  std::vector<Vertex3>& vertices = final.HullVertices;
  keepUnique(vertices);
  std::vector<Point3> points;
  for (const Vertex3& v : vertices)
  {
    points.push_back(v.Position);
  }
  // They are on the sides of this box.
  PointBounds frame;
  for (const Vertex3& z : artificial)
  {
    frame.include(z.Position);
  }
  DelaunayKernel3 kernel;
  kernel.triangulate(points.data(), points.size());
  kernel.forEach(
    [&](Index cell)
    {
      const std::array<Index, 4> v = kernel.corners(cell);
      if (kernel.isInfinite(cell) ||
        Circumball::isSurelyInside(kernel.point(v[0]), kernel.point(v[1]), kernel.point(v[2]),
          kernel.point(v[3]), frame.Box))
      {
        return;
      }
      const auto isInConflict = [&](const Vertex3& z)
      {
        return inSpherePerturbed(kernel.point(v[0]), kernel.point(v[1]), kernel.point(v[2]),
          kernel.point(v[3]), z.Position);
      };
      if (std::any_of(artificial.begin(), artificial.end(), isInConflict))
      {
        const auto id = [&](Index corner) { return vertices[kernel.pointIndex(corner)].Id; };
        final.Cells.push_back({ id(v[0]), id(v[1]), id(v[2]), id(v[3]) });
      }
    });
  vertices.clear();
}

} // namespace tipp

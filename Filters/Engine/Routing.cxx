// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/Routing.h"

#include "Kernel/DelaunayKernel.h"
#include "Predicates/Circumdisk.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace tipp
{

std::vector<BoundaryVertex> UniqueVertices::collect(const std::vector<VertexMessage>& messages)
{
  std::size_t count = 0;
  for (const VertexMessage& message : messages)
  {
    count += message.Vertices.size();
  }
  std::size_t size = 64;
  while (size < 2 * count)
  {
    size *= 2;
  }
  constexpr std::uint32_t empty = ~0U;
  this->HashTable.assign(size, empty);
  std::vector<BoundaryVertex> vertices;
  vertices.reserve(count);
  for (const VertexMessage& message : messages)
  {
    for (const BoundaryVertex& v : message.Vertices)
    {
      std::size_t at = ((std::uint64_t(v.Id) * 0x9e3779b97f4a7c15U) >> 32) & (size - 1);
      while (this->HashTable[at] != empty && vertices[this->HashTable[at]].Id != v.Id)
      {
        at = (at + 1) & (size - 1);
      }
      if (this->HashTable[at] == empty)
      {
        this->HashTable[at] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(v);
      }
    }
  }
  return vertices;
}

template <typename Id>
void FinalBoundary<Id>::add(const BoundaryTriangle& triangle)
{
  if (takeHullVertices(triangle, this->HullVertices))
  {
    return;
  }
  const auto lowest = std::min_element(triangle.begin(), triangle.end(),
    [](const BoundaryVertex& a, const BoundaryVertex& b) { return a.Id < b.Id; });
  this->Triangles.push_back({ TriangleSink<Id>::fromLowest({ static_cast<Id>(triangle[0].Id),
                                static_cast<Id>(triangle[1].Id), static_cast<Id>(triangle[2].Id) }),
    lowest->Partition });
}

template <typename Id>
void FinalBoundary<Id>::append(FinalBoundary&& other)
{
  this->Triangles.insert(this->Triangles.end(), other.Triangles.begin(), other.Triangles.end());
  this->HullVertices.insert(
    this->HullVertices.end(), other.HullVertices.begin(), other.HullVertices.end());
  other.Triangles.clear();
  other.HullVertices.clear();
}

void repairHull(std::vector<BoundaryVertex> vertices, const std::vector<BoundaryVertex>& artificial,
  FinalTriangleConsumer& final)
{
  keepUnique(vertices);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  {
    // There may be many vertices, so their copies are freed as soon as possible.
    DelaunayKernel kernel;
    kernel.insert(positionsOf(vertices).data(), vertices.size());
    kernel.forEach(
      [&](DelaunayKernel::Index t)
      {
        if (kernel.isInfinite(t))
        {
          return;
        }
        const auto [u, v, w] = kernel.corners(t);
        const Point2 a = kernel.point(u);
        const Point2 b = kernel.point(v);
        const Point2 c = kernel.point(w);
        const Box2 bounds = Circumdisk(a, b, c).bounds();
        const auto isInConflict = [&](const BoundaryVertex& z)
        {
          const Point2 p = z.Position;
          return bounds.xmin <= p.x && p.x <= bounds.xmax && bounds.ymin <= p.y &&
            p.y <= bounds.ymax && inCirclePerturbed(a, b, c, p);
        };
        if (std::any_of(artificial.begin(), artificial.end(), isInConflict))
        {
          triangles.push_back({ kernel.pointIndex(u), kernel.pointIndex(v), kernel.pointIndex(w) });
        }
      });
  }
  for (const auto& corners : triangles)
  {
    final.add({ vertices[corners[0]], vertices[corners[1]], vertices[corners[2]] });
  }
}

void OutgoingTriangles::clear(std::size_t vertexEnd)
{
  this->Triangles.clear();
  this->SentTo.assign(vertexEnd, ~0U);
}

template <typename VertexOf, typename Deliver>
std::int64_t OutgoingTriangles::send(PartitionIndex sender, std::size_t recipients,
  const VertexOf& vertexOf, const Deliver& deliver, FinalTriangleConsumer& final)
{
  // A counting sort: until the triangles are copied, Ends has the start of each recipient's range.
  this->Ends.assign(recipients + 2, 0);
  for (const Triangle& triangle : this->Triangles)
  {
    ++this->Ends[std::size_t(triangle.Recipient) + 1];
  }
  std::partial_sum(this->Ends.begin(), this->Ends.end(), this->Ends.begin());
  const std::size_t sent = this->Ends[recipients];
  this->Sorted.resize(this->Triangles.size());
  for (const Triangle& triangle : this->Triangles)
  {
    this->Sorted[this->Ends[triangle.Recipient]++] = triangle.Vertices;
  }
  std::size_t at = 0;
  for (std::size_t recipient = 0; at < sent; ++recipient)
  {
    VertexMessage message{ { sender, {} }, std::int64_t(this->Ends[recipient] - at) };
    for (; at < this->Ends[recipient]; ++at)
    {
      for (const DelaunayKernel::Index v : this->Sorted[at])
      {
        if (this->SentTo[std::size_t(v)] != recipient)
        {
          this->SentTo[std::size_t(v)] = static_cast<std::uint32_t>(recipient);
          message.Vertices.push_back(vertexOf(v));
        }
      }
    }
    if (message.Triangles > 0)
    {
      deliver(recipient, std::move(message));
    }
  }
  for (; at < this->Sorted.size(); ++at)
  {
    const Corners& v = this->Sorted[at];
    final.add({ vertexOf(v[0]), vertexOf(v[1]), vertexOf(v[2]) });
  }
  return std::int64_t(sent);
}

template <typename Id>
Routing<Id>::Routing(const PartitionOrder& order, const Regions& regions)
  : Order(order)
  , Boxes(regions)
{
}

template <typename Id>
void Routing<Id>::setPartition(PartitionIndex p)
{
  this->Sender = p;
  this->Later = this->Order.later(p);
}

template <typename Id>
void Routing<Id>::begin(DelaunayKernel::Index vertexEnd)
{
  this->Triangles.clear(std::size_t(vertexEnd));
}

template <typename Id>
void Routing<Id>::add(const std::array<DelaunayKernel::Index, 3>& corners, const Circumdisk& disk)
{
  const auto next = std::find_if(this->Later.begin(), this->Later.end(),
    [&](PartitionIndex q) { return disk.meets(this->Boxes[q]); });
  this->Triangles.add(std::size_t(next - this->Later.begin()), corners);
}

template <typename Id>
std::int64_t Routing<Id>::send(
  const Worker<Id>& worker, const DeliverMessage& deliver, FinalTriangleConsumer& final)
{
  return this->Triangles.send(
    this->Sender, this->Later.size(),
    [&](DelaunayKernel::Index v) { return worker.vertex(this->Sender, v); },
    [&](std::size_t recipient, VertexMessage&& message)
    { deliver(this->Later.begin()[recipient], std::move(message)); },
    final);
}

std::int64_t sendInitialMesh(const BoundaryTriangles& mesh, const PartitionOrder& order,
  const DeliverMessage& deliver, FinalTriangleConsumer& final)
{
  using Index = DelaunayKernel::Index;
  OutgoingTriangles triangles;
  triangles.clear(mesh.Vertices.size());
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    const auto [u, v, w] = mesh.Triangles[i];
    triangles.add(mesh.metBegin(i) == mesh.metEnd(i)
        ? order.partitionCount()
        : std::size_t(order.first(mesh.metBegin(i), mesh.metEnd(i))),
      { Index(u), Index(v), Index(w) });
  }
  return triangles.send(
    -1, order.partitionCount(), [&](Index v) { return mesh.Vertices[std::size_t(v)]; },
    [&](std::size_t recipient, VertexMessage&& message)
    { deliver(static_cast<PartitionIndex>(recipient), std::move(message)); },
    final);
}

template struct FinalBoundary<std::int32_t>;
template struct FinalBoundary<std::int64_t>;
template class Routing<std::int32_t>;
template class Routing<std::int64_t>;

} // namespace tipp

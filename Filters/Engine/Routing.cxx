// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/Routing.h"

#include "Kernel/DelaunayKernel.h"
#include "Predicates/Circumdisk.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>

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
  this->VertexEnd = std::size_t(vertexEnd);
  this->Outgoing.assign(this->Later.size(), {});
  this->Final.clear();
}

template <typename Id>
void Routing<Id>::add(const Corners& corners, const Circumdisk& disk)
{
  const auto next = std::find_if(this->Later.begin(), this->Later.end(),
    [&](PartitionIndex q) { return disk.meets(this->Boxes[q]); });
  std::vector<Corners>& triangles = next == this->Later.end()
    ? this->Final
    : this->Outgoing[std::size_t(next - this->Later.begin())];
  triangles.push_back(corners);
}

template <typename Id>
SentMessages Routing<Id>::send(const Worker<Id>& worker, FinalTriangleConsumer& final) const
{
  const auto vertexAt = [&](DelaunayKernel::Index v) { return worker.vertex(this->Sender, v); };
  SentMessages sent = messagesWith(this->Sender, this->Outgoing, this->VertexEnd, vertexAt);
  for (auto& [to, message] : sent)
  {
    to = this->Later.begin()[to];
  }
  for (const Corners& v : this->Final)
  {
    final.add({ vertexAt(v[0]), vertexAt(v[1]), vertexAt(v[2]) });
  }
  return sent;
}

template struct FinalBoundary<std::int32_t>;
template struct FinalBoundary<std::int64_t>;
template class Routing<std::int32_t>;
template class Routing<std::int64_t>;

} // namespace tipp

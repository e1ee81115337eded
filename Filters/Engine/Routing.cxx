// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/Routing.h"

#include "Triangulation/HullRepair.h"

#include <algorithm>
#include <numeric>

namespace tipp
{
namespace
{

constexpr std::uint32_t Nobody = ~0U;

} // namespace

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

bool takeHullVertices(const BoundaryTriangle& triangle, std::vector<BoundaryVertex>& vertices)
{
  const auto isArtificial = [](const BoundaryVertex& v) { return v.isArtificial(); };
  const bool isHull = std::any_of(triangle.begin(), triangle.end(), isArtificial);
  if (isHull)
  {
    std::remove_copy_if(
      triangle.begin(), triangle.end(), std::back_inserter(vertices), isArtificial);
  }
  return isHull;
}

void keepUnique(std::vector<BoundaryVertex>& vertices)
{
  std::sort(vertices.begin(), vertices.end(),
    [](const BoundaryVertex& a, const BoundaryVertex& b) { return a.Id < b.Id; });
  vertices.erase(std::unique(vertices.begin(), vertices.end(),
                   [](const BoundaryVertex& a, const BoundaryVertex& b) { return a.Id == b.Id; }),
    vertices.end());
}

void repairHull(std::vector<BoundaryVertex> vertices, const std::vector<BoundaryVertex>& artificial,
  FinalTaker& final)
{
  keepUnique(vertices);
  std::vector<Point2> points;
  points.reserve(vertices.size());
  for (const BoundaryVertex& v : vertices)
  {
    points.push_back(v.Position);
  }
  for (const auto& corners : hullTriangles(std::move(points), artificial))
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
  this->Triangles.clear();
  this->SentTo.assign(std::size_t(vertexEnd), Nobody);
}

template <typename Id>
void Routing<Id>::add(const std::array<DelaunayKernel::Index, 3>& corners, const Circumdisk& disk)
{
  const auto next = std::find_if(this->Later.begin(), this->Later.end(),
    [&](PartitionIndex q) { return disk.meets(this->Boxes[q]); });
  this->Triangles.push_back({ static_cast<std::uint32_t>(next - this->Later.begin()), corners });
}

/// Sorts the triangles by recipient, with a counting sort.
template <typename Id>
void Routing<Id>::sortByRecipient()
{
  this->Ends.assign(this->Later.size() + 1, 0);
  for (const Triangle& triangle : this->Triangles)
  {
    ++this->Ends[triangle.Recipient];
  }
  std::partial_sum(this->Ends.begin(), this->Ends.end(), this->Ends.begin());
  this->Sorted.resize(this->Triangles.size());
  for (auto triangle = this->Triangles.rbegin(); triangle != this->Triangles.rend(); ++triangle)
  {
    this->Sorted[--this->Ends[triangle->Recipient]] = triangle->Corners;
  }
  // The entries, ends before, are begins now.
}

template <typename Id>
VertexMessage Routing<Id>::messageTo(std::uint32_t recipient, const Worker<Id>& worker)
{
  const std::size_t end = this->Ends[recipient + 1];
  VertexMessage message{ this->Sender, {}, std::int64_t(end - this->Ends[recipient]) };
  for (std::size_t i = this->Ends[recipient]; i < end; ++i)
  {
    for (const DelaunayKernel::Index v : this->Sorted[i])
    {
      if (this->SentTo[std::size_t(v)] != recipient)
      {
        this->SentTo[std::size_t(v)] = recipient;
        message.Vertices.push_back(worker.vertex(this->Sender, v));
      }
    }
  }
  return message;
}

template <typename Id>
std::int64_t Routing<Id>::send(
  const Worker<Id>& worker, const DeliverMessage& deliver, FinalTaker& final)
{
  this->sortByRecipient();
  const std::size_t nobody = this->Later.size();
  const std::size_t sent = this->Ends[nobody];
  for (std::uint32_t recipient = 0; recipient < nobody; ++recipient)
  {
    if (this->Ends[recipient] < this->Ends[recipient + 1])
    {
      deliver(this->Later.begin()[recipient], this->messageTo(recipient, worker));
    }
  }
  for (std::size_t i = sent; i < this->Sorted.size(); ++i)
  {
    const auto& v = this->Sorted[i];
    final.add({ worker.vertex(this->Sender, v[0]), worker.vertex(this->Sender, v[1]),
      worker.vertex(this->Sender, v[2]) });
  }
  return std::int64_t(sent);
}

std::int64_t sendInitialMesh(const BoundaryTriangles& mesh, const PartitionOrder& order,
  const DeliverMessage& deliver, FinalTaker& final)
{
  std::vector<PartitionIndex> recipients(mesh.size(), -1);
  std::vector<std::size_t> ends(order.partitionCount() + 1, 0); // of each partition's triangles
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    if (mesh.metBegin(i) == mesh.metEnd(i))
    {
      final.add(mesh[i]);
    }
    else
    {
      recipients[i] = order.first(mesh.metBegin(i), mesh.metEnd(i));
      ++ends[std::size_t(recipients[i]) + 1];
    }
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<std::size_t> sent(ends.back()); // triangle indices by recipient
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    if (recipients[i] >= 0)
    {
      sent[ends[std::size_t(recipients[i])]++] = i;
    }
  }
  std::vector<PartitionIndex> sentTo(mesh.Vertices.size(), -1);
  auto at = sent.begin();
  for (PartitionIndex recipient = 0; at != sent.end(); ++recipient)
  {
    VertexMessage message{ -1, {}, 0 };
    for (; at != sent.begin() + std::ptrdiff_t(ends[std::size_t(recipient)]);
         ++at, ++message.Triangles)
    {
      for (const std::uint32_t v : mesh.Triangles[*at])
      {
        if (sentTo[v] != recipient)
        {
          sentTo[v] = recipient;
          message.Vertices.push_back(mesh.Vertices[v]);
        }
      }
    }
    if (message.Triangles > 0)
    {
      deliver(recipient, std::move(message));
    }
  }
  return std::int64_t(sent.size());
}

template struct FinalBoundary<std::int32_t>;
template struct FinalBoundary<std::int64_t>;
template class Routing<std::int32_t>;
template class Routing<std::int64_t>;

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/ShareInitialMesh.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

Bytes bytesOf(const BoundaryTriangles& triangles)
{
  ByteWriter writer;
  writer.array(triangles.Triangles);
  writer.array(triangles.SetOf);
  writer.value(std::uint64_t(triangles.Sets.size()));
  for (std::uint32_t set = 0; set < triangles.Sets.size(); ++set)
  {
    const PartitionIndex* const begin = triangles.Sets.begin(set);
    writer.array(begin, std::size_t(triangles.Sets.end(set) - begin));
  }
  return writer.take();
}

BoundaryTriangles trianglesOf(ByteReader& reader)
{
  BoundaryTriangles triangles;
  triangles.Triangles = reader.array<BoundaryTriangles::Corners>();
  triangles.SetOf = reader.array<std::uint32_t>();
  const auto sets = reader.value<std::uint64_t>();
  for (std::uint64_t i = 0; i < sets; ++i)
  {
    const std::vector<PartitionIndex> members = reader.array<PartitionIndex>();
    triangles.Sets.number(members.data(), members.data() + members.size());
  }
  return triangles;
}

} // namespace

Bytes joinedOnAllRanks(Communicator& ranks, Bytes&& own)
{
  ByteWriter all;
  for (const Bytes& part : ranks.gather(std::move(own)))
  {
    all.raw(part.data(), part.size());
  }
  return ranks.broadcast(all.take());
}

InitialMeshShare shareOf(Communicator& ranks, std::size_t vertices)
{
  constexpr std::size_t leastOfARank = 256;
  if (ranks.size() == 1 || vertices < leastOfARank * std::size_t(ranks.size()))
  {
    return {};
  }
  const auto exchange = [&ranks](BoundaryTriangles&& own)
  {
    std::vector<BoundaryTriangles> all;
    const Bytes together = joinedOnAllRanks(ranks, bytesOf(own));
    for (ByteReader reader(together); reader.left() > 0;)
    {
      all.push_back(trianglesOf(reader));
    }
    return all;
  };
  return { ranks.rank(), ranks.size(), exchange };
}

} // namespace tipp

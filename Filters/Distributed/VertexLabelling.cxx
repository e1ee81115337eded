// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/VertexLabelling.h"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace tipp
{

std::vector<SeamVertex> labelVertices(const Tiling& boxes, std::vector<PlainVertex>& vertices)
{
  std::sort(vertices.begin(), vertices.end(),
    [](const PlainVertex& a, const PlainVertex& b) { return a.Id < b.Id; });
  vertices.erase(std::unique(vertices.begin(), vertices.end(),
                   [](const PlainVertex& a, const PlainVertex& b) { return a.Id == b.Id; }),
    vertices.end());
  constexpr std::size_t most = 1024; // at a time
  std::array<Point2, most> points{};
  std::array<std::uint32_t, most> partitions{};
  std::vector<SeamVertex> labelled;
  labelled.reserve(vertices.size());
  for (std::size_t begin = 0; begin < vertices.size(); begin += most)
  {
    const std::size_t count = std::min(most, vertices.size() - begin);
    for (std::size_t i = 0; i < count; ++i)
    {
      points[i] = vertices[begin + i].Place;
    }
    boxes.locate(points.data(), count, partitions.data());
    for (std::size_t i = 0; i < count; ++i)
    {
      const PlainVertex& v = vertices[begin + i];
      labelled.push_back(
        makeSeamVertex(boxes, static_cast<PartitionIndex>(partitions[i]), v.Place, v.Id));
    }
  }
  return labelled;
}

SeamTriangles labelTriangles(const Tiling& boxes, const std::vector<SeamTriangle>& triangles)
{
  SeamTriangles seams;
  std::unordered_map<std::int64_t, std::uint32_t> places;
  for (const SeamTriangle& triangle : triangles)
  {
    SeamTriangles::Corners corners{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const SeamVertex& v = triangle[i];
      const auto entry = places.emplace(v.Id, std::uint32_t(seams.Vertices.size()));
      if (entry.second)
      {
        seams.Vertices.push_back(makeSeamVertex(boxes, boxes.locate(v.Place), v.Place, v.Id));
      }
      corners[i] = entry.first->second;
    }
    seams.add(boxes, corners, Circumdisk(triangle[0].Place, triangle[1].Place, triangle[2].Place));
  }
  return seams;
}

} // namespace tipp

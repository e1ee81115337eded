// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/VertexLabelling.h"

#include <algorithm>
#include <array>

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

} // namespace tipp

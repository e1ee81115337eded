// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/VertexLabelling.h"

#include <algorithm>

namespace tipp
{

const std::vector<SeamVertex>& VertexLabelling::label(
  const Tiling& boxes, std::vector<PlainVertex>& vertices)
{
  std::sort(vertices.begin(), vertices.end(),
    [](const PlainVertex& a, const PlainVertex& b) { return a.Id < b.Id; });
  vertices.erase(std::unique(vertices.begin(), vertices.end(),
                   [](const PlainVertex& a, const PlainVertex& b) { return a.Id == b.Id; }),
    vertices.end());
  this->Points.clear();
  for (const PlainVertex& v : vertices)
  {
    this->Points.push_back(v.Place);
  }
  this->Partitions.resize(vertices.size());
  boxes.locate(this->Points.data(), this->Points.size(), this->Partitions.data());
  this->Labelled.clear();
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    this->Labelled.push_back(makeSeamVertex(
      boxes, static_cast<PartitionIndex>(this->Partitions[i]), vertices[i].Place, vertices[i].Id));
  }
  return this->Labelled;
}

} // namespace tipp

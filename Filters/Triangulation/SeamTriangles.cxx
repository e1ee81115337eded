// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/SeamTriangles.h"

namespace tipp
{

SeamVertex makeSeamVertex(const Tiling& tiling, PartitionIndex partition, Point2 p, std::int64_t id)
{
  const Box2& box = tiling.box(partition);
  const std::uint32_t right = p.x - box.xmin > box.xmax - p.x;
  const std::uint32_t upper = p.y - box.ymin > box.ymax - p.y;
  return { p, id, 4 * static_cast<std::uint32_t>(partition) + 2 * upper + right };
}

void SeamTriangles::clear()
{
  this->Vertices.clear();
  this->Triangles.clear();
  this->SetOf.clear();
  this->Sets.clear();
  this->AdjacentSets.clear();
}

void SeamTriangles::add(
  const Corners& corners, const PartitionIndex* metBegin, const PartitionIndex* metEnd)
{
  this->Triangles.push_back(corners);
  this->SetOf.push_back(this->Sets.number(metBegin, metEnd));
}

void SeamTriangles::appendTriangles(const SeamTriangles& others)
{
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    this->add(others.Triangles[i], others.metBegin(i), others.metEnd(i));
  }
}

} // namespace tipp

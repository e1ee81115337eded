// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/SeamTriangles.h"

namespace tipp
{

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

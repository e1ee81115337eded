// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/BoundaryTriangles.h"

namespace tipp
{

void BoundaryTriangles::add(
  const Corners& corners, const PartitionIndex* metBegin, const PartitionIndex* metEnd)
{
  this->Triangles.push_back(corners);
  this->SetOf.push_back(this->Sets.number(metBegin, metEnd));
}

void BoundaryTriangles::appendTriangles(const BoundaryTriangles& others)
{
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t set = 0; set < others.Sets.size(); ++set)
  {
    numbers.push_back(this->Sets.number(others.Sets.begin(set), others.Sets.end(set)));
  }
  this->Triangles.insert(this->Triangles.end(), others.Triangles.begin(), others.Triangles.end());
  this->SetOf.reserve(this->SetOf.size() + others.SetOf.size());
  for (const std::uint32_t set : others.SetOf)
  {
    this->SetOf.push_back(numbers[set]);
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/FinalSeams.h"

#include "Triangulation/HullRepair.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

FinalSeams::Triangle fromLowest(const SeamTriangle& triangle)
{
  const auto lowest = std::min_element(triangle.begin(), triangle.end(),
    [](const SeamVertex& a, const SeamVertex& b) { return a.Id < b.Id; });
  const auto first = std::size_t(lowest - triangle.begin());
  return { { lowest->Id, triangle[(first + 1) % 3].Id, triangle[(first + 2) % 3].Id },
    lowest->partition() };
}

} // namespace

void FinalSeams::add(const std::vector<SeamTriangle>& triangles)
{
  for (const SeamTriangle& triangle : triangles)
  {
    if (std::any_of(
          triangle.begin(), triangle.end(), [](const SeamVertex& v) { return v.isArtificial(); }))
    {
      this->AtArtificial.push_back(triangle);
    }
    else
    {
      this->Triangles.push_back(fromLowest(triangle));
    }
  }
}

void FinalSeams::removeArtificialPoints(const std::vector<SeamVertex>& artificial)
{
  tipp::removeArtificialPoints(this->AtArtificial, artificial);
  this->add(std::exchange(this->AtArtificial, {}));
}

} // namespace tipp

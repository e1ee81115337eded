// SPDX-License-Identifier: BSD-3-Clause
#include "Check/RoundedBorder.h"

#include "Check/SnappedLine.h"
#include "Check/SplitChains.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace check
{

void RoundedBorder::add(Position a, Position b, Position p, Position q, bool isMeshLeft)
{
  if (!isMeshLeft)
  {
    std::swap(a, b);
  }
  if (q.x < p.x)
  {
    std::swap(p, q);
  }
  this->Parts.push_back({ a, b, p, q });
  this->Widest = std::max(this->Widest, q.x - p.x + SplitChains::reach(a, b).x);
}

void RoundedBorder::finish()
{
  std::sort(this->Parts.begin(), this->Parts.end(),
    [](const Part& a, const Part& b) { return a.P.x < b.P.x; });
}

bool RoundedBorder::mayCover(Position p) const
{
  const double first = p.x - this->Widest; // no edge that begins before it comes so far
  auto part = std::lower_bound(this->Parts.begin(), this->Parts.end(), first,
    [](const Part& a, double x) { return a.P.x < x; });
  for (; part != this->Parts.end() && part->P.x <= p.x + this->Widest; ++part)
  {
    const auto& [a, b, west, east] = *part;
    const Position reach = SplitChains::reach(a, b);
    const auto [south, north] = std::minmax({ west.y, east.y });
    const bool isBeside = p.x >= west.x - reach.x && p.x <= east.x + reach.x &&
      p.y >= south - reach.y && p.y <= north + reach.y;
    if (isBeside && turn(a, b, p) < 0 && SnappedLine(west, east, reach).reaches(p))
    {
      return true;
    }
  }
  return false;
}

} // namespace check
} // namespace tipp

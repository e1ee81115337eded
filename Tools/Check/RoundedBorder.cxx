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

void RoundedBorder::add(Line line, Position p, Position q, bool isMeshLeft)
{
  if (!isMeshLeft)
  {
    std::swap(line.A, line.B);
    std::swap(line.From, line.To);
  }
  if (q.x < p.x)
  {
    std::swap(p, q);
  }
  this->Edges.push_back({ line, p, q });
  this->Widest = std::max(this->Widest, q.x - p.x + SplitChains::reach(line.A, line.B).x);
}

void RoundedBorder::finish()
{
  std::sort(this->Edges.begin(), this->Edges.end(),
    [](const Edge& a, const Edge& b) { return a.P.x < b.P.x; });
}

bool RoundedBorder::mayCover(Position p) const
{
  const double first = p.x - this->Widest; // no edge that begins before it comes so far
  auto edge = std::lower_bound(this->Edges.begin(), this->Edges.end(), first,
    [](const Edge& a, double x) { return a.P.x < x; });
  for (; edge != this->Edges.end() && edge->P.x <= p.x + this->Widest; ++edge)
  {
    const auto& [on, west, east] = *edge;
    const Position reach = SplitChains::reach(on.A, on.B);
    const auto [south, north] = std::minmax({ west.y, east.y });
    const bool isBeside = p.x >= west.x - reach.x && p.x <= east.x + reach.x &&
      p.y >= south - reach.y && p.y <= north + reach.y;
    if (isBeside && turn(on.From, on.To, p) < 0 && turn(on.A, on.B, p) != 0 &&
      SnappedLine(west, east, reach).reaches(p))
    {
      return true;
    }
  }
  return false;
}

} // namespace check
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/MatchPositions.h"

#include <map>
#include <utility>

namespace tipp
{

MatchedPositions matchPositions(PointsView points, PointsView others)
{
  // The few others are looked up for each of the many points.
  std::map<std::pair<double, double>, PointId> positions;
  constexpr PointId none = -1;
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    if (isFinite(others[i])) // NaN has no place in an order
    {
      positions.emplace(std::make_pair(others[i].x, others[i].y), none);
    }
  }
  points.forEach(0, points.size(),
    [&](std::size_t i, Point2 p)
    {
      const auto position = isFinite(p) ? positions.find({ p.x, p.y }) : positions.end();
      if (position != positions.end() && position->second == none)
      {
        position->second = PointId(i);
      }
    });
  MatchedPositions result;
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    PointId unmatched = none;
    PointId& id =
      isFinite(others[i]) ? positions.find({ others[i].x, others[i].y })->second : unmatched;
    if (id == none)
    {
      id = PointId(points.size() + result.New.size());
      result.New.push_back(i);
    }
    result.Ids.push_back(id);
  }
  return result;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/ForeignPoint.h"

#include <algorithm>
#include <tuple>

namespace tipp
{

void makeDistinct(std::vector<ForeignPoint>& points)
{
  const auto keyOf = [](const ForeignPoint& p)
  { return std::make_tuple(p.Point, p.Piece, p.GhostOnly); };
  std::sort(points.begin(), points.end(),
    [&](const ForeignPoint& a, const ForeignPoint& b) { return keyOf(a) < keyOf(b); });
  points.erase(std::unique(points.begin(), points.end(),
                 [](const ForeignPoint& a, const ForeignPoint& b)
                 { return a.Point == b.Point && a.Piece == b.Piece; }),
    points.end());
}

} // namespace tipp

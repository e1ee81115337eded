// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CutPolygon.h"

#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace tipp
{
namespace
{

/// Whether c, on the line of a and b, lies between them or at one of them.
bool isBetween(Point2 a, Point2 b, Point2 c)
{
  const auto [low, high] = lexicographicLess(a, b) ? std::pair(a, b) : std::pair(b, a);
  return !lexicographicLess(c, low) && !lexicographicLess(high, c);
}

/// Whether two segments have a point in common.
bool meet(Point2 a, Point2 b, Point2 c, Point2 d)
{
  const auto touches = [](Point2 p, Point2 q, Point2 r)
  { return orientation(p, q, r) == 0 && isBetween(p, q, r); };
  return crossProperly(a, b, c, d) || touches(a, b, c) || touches(a, b, d) || touches(c, d, a) ||
    touches(c, d, b);
}

/// Whether edges meet only at the corner between them.
bool isSimple(const std::vector<Point2>& corners)
{
  const std::size_t n = corners.size();
  const auto at = [&](std::size_t i) { return corners[i % n]; };
  for (std::size_t i = 0; i < n; ++i)
  {
    if (at(i) == at(i + 1) ||
      (orientation(at(i), at(i + 1), at(i + 2)) == 0 &&
        (isBetween(at(i), at(i + 1), at(i + 2)) || isBetween(at(i + 1), at(i + 2), at(i)))))
    {
      return false; // an edge of no length, or one that turns back along the edge before
    }
    for (std::size_t j = i + 2; j < n; ++j)
    {
      if ((j + 1) % n != i && meet(at(i), at(i + 1), at(j), at(j + 1)))
      {
        return false;
      }
    }
  }
  return true;
}

double squaredLength(Point2 a, Point2 b)
{
  const Point2 d = a - b;
  return d.x * d.x + d.y * d.y;
}

/// A simple polygon from which ears are cut off.
class EarCutter
{
public:
  explicit EarCutter(const std::vector<Point2>& corners)
    : Corners(corners)
    , Left(corners.size())
  {
    std::iota(this->Left.begin(), this->Left.end(), std::size_t(0));
    const auto lowest = std::min_element(
      corners.begin(), corners.end(), [](Point2 a, Point2 b) { return lexicographicLess(a, b); });
    const auto first = std::size_t(lowest - corners.begin());
    // The corner of lowest coordinates is on the convex hull, so it shows the direction; it is not
    // on a straight edge of a simple polygon.
    const std::size_t n = corners.size();
    if (orientation(corners[(first + n - 1) % n], corners[first], corners[(first + 1) % n]) < 0)
    {
      std::reverse(this->Left.begin(), this->Left.end());
    }
  }

  /// Returns false if there is no ear, which no simple polygon lacks.
  bool cut(std::vector<CornerTriangle>& triangles)
  {
    while (this->Left.size() > 3)
    {
      const std::size_t ear = this->findEar();
      if (ear == this->Left.size())
      {
        return false;
      }
      triangles.push_back(this->triangleAt(ear));
      this->Left.erase(this->Left.begin() + std::ptrdiff_t(ear));
    }
    triangles.push_back(this->triangleAt(1));
    return true;
  }

private:
  /// The corner and its neighbours, in order.
  CornerTriangle triangleAt(std::size_t i) const
  {
    const std::size_t n = this->Left.size();
    return { this->Left[(i + n - 1) % n], this->Left[i], this->Left[(i + 1) % n] };
  }

  bool isEar(const CornerTriangle& t) const
  {
    const Point2 a = this->Corners[t[0]];
    const Point2 b = this->Corners[t[1]];
    const Point2 c = this->Corners[t[2]];
    if (orientation(a, b, c) <= 0)
    {
      return false;
    }
    return std::none_of(this->Left.begin(), this->Left.end(),
      [&](std::size_t other)
      {
        const Point2 p = this->Corners[other];
        return other != t[0] && other != t[1] && other != t[2] && orientation(a, b, p) >= 0 &&
          orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
      });
  }

  std::size_t findEar() const
  {
    std::size_t best = this->Left.size();
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < this->Left.size(); ++i)
    {
      const CornerTriangle t = this->triangleAt(i);
      const double length = squaredLength(this->Corners[t[0]], this->Corners[t[2]]);
      const bool isBetter = best == this->Left.size() || length < shortest ||
        (length == shortest &&
          lexicographicLess(this->Corners[t[1]], this->Corners[this->Left[best]]));
      if (isBetter && this->isEar(t))
      {
        best = i;
        shortest = length;
      }
    }
    return best;
  }

  const std::vector<Point2>& Corners;
  std::vector<std::size_t> Left; ///< the corners that have not been cut off, counter-clockwise
};

} // namespace

bool cutPolygon(const std::vector<Point2>& corners, std::vector<CornerTriangle>& triangles)
{
  if (corners.size() < 3 || corners.size() > mostCorners || !isSimple(corners))
  {
    return false;
  }
  return EarCutter(corners).cut(triangles);
}

} // namespace tipp

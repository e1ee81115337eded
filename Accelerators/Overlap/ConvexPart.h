// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConvexPart_h
#define tippConvexPart_h

#include "Predicates/Geometry.h"
#include "Predicates/Vectors.h"

#include <algorithm>

namespace tipp
{

/// A corner of a ConvexPart: its position, and values that are linear over the part.
template <int Values>
struct PartCorner
{
  Point2 At;
  double Value[Values];
};

/// A convex polygon, counter-clockwise, that half planes cut. The values of new corners are
/// interpolated along the edge that is cut. So they stay between those of its ends, and no division
/// by the area of a thin triangle is needed.
///
/// A cut adds one corner to a convex polygon. Rounding could make a polygon that is not quite
/// convex, of which a cut may add half as many corners as there are. So a part of a triangle that
/// is cut n times has at most 3, 4, 6, 9, 13, 19, 28, 42, 63 corners. `Most` must be at least that.
template <int Values, int Most = 20>
class ConvexPart
{
public:
  using Corner = PartCorner<Values>;

  int size() const { return this->Count; }
  const Corner& operator[](int i) const { return this->Corners[i]; }
  void clear() { this->Count = 0; }
  void add(const Corner& corner) { this->Corners[this->Count++] = corner; }

  /// Keeps the side where sideOf(corner) is positive, in `inside`, and appends the other side to
  /// `outside` unless that is null. sideOf() is linear. New corners are the same in both, with
  /// onLine(corner) applied to remove their rounding error.
  template <typename SideOf, typename OnLine>
  void cut(
    const SideOf& sideOf, const OnLine& onLine, ConvexPart& inside, ConvexPart* outside) const
  {
    inside.Count = 0;
    const Corner* from = this->Corners + this->Count - 1;
    double ofFrom = this->Count > 0 ? sideOf(*from) : 0;
    for (int i = 0; i < this->Count; ++i)
    {
      const Corner* const to = this->Corners + i;
      const double ofTo = sideOf(*to);
      if ((ofFrom > 0 && ofTo < 0) || (ofFrom < 0 && ofTo > 0))
      {
        Corner& crossing = inside.Corners[inside.Count++];
        between(*from, *to, ofFrom / (ofFrom - ofTo), crossing);
        onLine(crossing);
        if (outside)
        {
          outside->add(crossing);
        }
      }
      if (ofTo >= 0)
      {
        inside.Corners[inside.Count++] = *to;
      }
      if (outside && ofTo <= 0)
      {
        outside->add(*to);
      }
      from = to;
      ofFrom = ofTo;
    }
  }

  double area() const
  {
    double twice = 0;
    for (int i = 2; i < this->Count; ++i)
    {
      twice += this->twiceArea(i);
    }
    return std::max(twice / 2, 0.0);
  }

  /// Returns the area, and the integral of each of the values `first` to `first` + `count` - 1.
  double integrate(int first, int count, double* integrals) const
  {
    std::fill_n(integrals, count, 0.0);
    double twice = 0;
    for (int i = 2; i < this->Count; ++i)
    {
      const double ofTriangle = this->twiceArea(i);
      twice += ofTriangle;
      for (int k = 0; k < count; ++k)
      {
        integrals[k] += ofTriangle *
          (this->Corners[0].Value[first + k] + this->Corners[i - 1].Value[first + k] +
            this->Corners[i].Value[first + k]);
      }
    }
    for (int k = 0; k < count; ++k)
    {
      integrals[k] /= 6;
    }
    return std::max(twice / 2, 0.0);
  }

  /// Twice the area of the triangle of the corners 0, i - 1 and i.
  double twiceArea(int i) const
  {
    return cross(
      this->Corners[i - 1].At - this->Corners[0].At, this->Corners[i].At - this->Corners[0].At);
  }

private:
  static void between(const Corner& a, const Corner& b, double share, Corner& to)
  {
    to.At = { a.At.x + share * (b.At.x - a.At.x), a.At.y + share * (b.At.y - a.At.y) };
    for (int k = 0; k < Values; ++k)
    {
      to.Value[k] = a.Value[k] + share * (b.Value[k] - a.Value[k]);
    }
  }

  int Count = 0;
  Corner Corners[Most];
};

} // namespace tipp

#endif

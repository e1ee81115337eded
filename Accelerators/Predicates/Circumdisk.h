// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCircumdisk_h
#define tippCircumdisk_h

#include "Predicates/Points.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>

namespace tipp
{

/// The closed disk through the corners of a triangle, computed once and tested exactly against many
/// boxes.
///
/// Stores its centre and radius as intervals of doubles; if these leave a test undecided,
/// arbitrary-precision integers decide. Corners must be finite and in counter-clockwise order.
class VTKTIPPACCELERATORS_EXPORT Circumdisk
{
public:
  Circumdisk(Point2 a, Point2 b, Point2 c);

  /// Whether disk and box share a point; touching counts.
  bool meets(const Box2& box) const
  {
    // Lower and upper bound of the distance from the centre to the nearest point of the box.
    const double xNear = gap(box.xmin - this->Centre.xmax, this->Centre.xmin - box.xmax);
    const double yNear = gap(box.ymin - this->Centre.ymax, this->Centre.ymin - box.ymax);
    if (xNear * xNear + yNear * yNear > this->LargestSquare)
    {
      return false;
    }
    const double xFar = gap(box.xmin - this->Centre.xmin, this->Centre.xmax - box.xmax);
    const double yFar = gap(box.ymin - this->Centre.ymin, this->Centre.ymax - box.ymax);
    return xFar * xFar + yFar * yFar <= this->SmallestSquare || this->meetsExactly(box);
  }

  /// Whether the disk lies in the box; touching the box's border from inside counts.
  bool inside(const Box2& box) const
  {
    if (box.xmin <= this->Outer.xmin && this->Outer.xmax <= box.xmax &&
      box.ymin <= this->Outer.ymin && this->Outer.ymax <= box.ymax)
    {
      return true;
    }
    const bool reachesOut = this->Inner.xmin < box.xmin || box.xmax < this->Inner.xmax ||
      this->Inner.ymin < box.ymin || box.ymax < this->Inner.ymax;
    return !reachesOut && this->liesInsideExactly(box);
  }

  /// A box that contains the disk: rounded outward, and infinite if doubles cannot bound it.
  Box2 bounds() const { return this->Outer; }

private:
  static double gap(double before, double behind)
  {
    return std::max(std::max(before, behind), 0.0);
  }
  bool computeIntervals();
  void leaveOpen();
  bool meetsExactly(const Box2& box) const;
  bool liesInsideExactly(const Box2& box) const;

  Point2 A;
  Point2 B;
  Point2 C;
  Box2 Centre;           // interval that contains the centre
  Box2 Outer;            // contains the disk's bounding box
  Box2 Inner;            // the disk reaches or crosses each side
  double SmallestSquare; // interval of the squared radius,
  double LargestSquare;  // widened by the rounding of the squared distances in meets()
};

} // namespace tipp

#endif

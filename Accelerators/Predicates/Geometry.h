// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGeometry_h
#define tippGeometry_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace tipp
{

/// @file
/// Points and axis-aligned boxes in the plane and in space.

/// +1, 0 or -1, without a branch.
template <typename Number>
int signOf(Number value)
{
  return (value > 0) - (value < 0);
}

/// A point, or a vector, in D dimensions: D consecutive doubles.
template <int D>
struct Point;

template <>
struct Point<2>
{
  double x;
  double y;

  double& operator[](std::size_t axis) { return reinterpret_cast<double*>(this)[axis]; }
  double operator[](std::size_t axis) const { return reinterpret_cast<const double*>(this)[axis]; }
};

template <>
struct Point<3>
{
  double x;
  double y;
  double z;

  double& operator[](std::size_t axis) { return reinterpret_cast<double*>(this)[axis]; }
  double operator[](std::size_t axis) const { return reinterpret_cast<const double*>(this)[axis]; }
};

using Point2 = Point<2>;
using Point3 = Point<3>;

///@{
/// True for 0 and -0, false for NaN.
inline bool operator==(Point2 a, Point2 b)
{
  return a.x == b.x && a.y == b.y;
}
inline bool operator==(const Point3& a, const Point3& b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
///@}

inline Point2 operator-(Point2 a, Point2 b)
{
  return { a.x - b.x, a.y - b.y };
}
inline Point3 operator-(const Point3& a, const Point3& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}

inline bool isFinite(Point2 p)
{
  return std::isfinite(p.x) && std::isfinite(p.y);
}
inline bool isFinite(const Point3& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

///@{
/// The order that all tie rules of the project use.
inline bool lexicographicLess(Point2 a, Point2 b)
{
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}
inline bool lexicographicLess(const Point3& a, const Point3& b)
{
  return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}
///@}

/// Returns the first D coordinates of a point in space.
template <int D>
Point<D> projected(const Point3& p)
{
  if constexpr (D == 2)
  {
    return { p.x, p.y };
  }
  else
  {
    return p;
  }
}

/// A closed axis-aligned box. Its bounds may be infinite, and it may be flat.
template <int D>
struct Box
{
  Point<D> Min{};
  Point<D> Max{};

  /// Returns a box without points, which extend() makes the bounding box of points.
  static Box empty()
  {
    Box box;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      box.Min[axis] = std::numeric_limits<double>::infinity();
      box.Max[axis] = -std::numeric_limits<double>::infinity();
    }
    return box;
  }
  static Box of(const Point<D>& p) { return { p, p }; }
  /// Returns the bounding box of two points.
  static Box of(const Point<D>& p, const Point<D>& q)
  {
    Box box = of(p);
    box.extend(q);
    return box;
  }

  ///@{
  /// Extends the box by a point or by the points of a box. NaN is ignored.
  void extend(const Point<D>& p) { this->extend(of(p)); }
  void extend(const Box& other)
  {
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      this->Min[axis] = std::min(this->Min[axis], other.Min[axis]);
      this->Max[axis] = std::max(this->Max[axis], other.Max[axis]);
    }
  }
  ///@}

  /// Returns whether the box has no point. A box with a NaN has none.
  bool isEmpty() const
  {
    bool hasPoints = true;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      hasPoints = hasPoints && this->Min[axis] <= this->Max[axis];
    }
    return !hasPoints;
  }

  bool contains(const Point<D>& p) const
  {
    bool isInside = true;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      isInside = isInside && this->Min[axis] <= p[axis] && p[axis] <= this->Max[axis];
    }
    return isInside;
  }
  bool contains(const Box& other) const
  {
    bool isInside = true;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      isInside =
        isInside && this->Min[axis] <= other.Min[axis] && other.Max[axis] <= this->Max[axis];
    }
    return isInside;
  }

  /// Returns whether the boxes have a common point.
  bool meets(const Box& other) const
  {
    bool doMeet = true;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      doMeet = doMeet && this->Min[axis] <= other.Max[axis] && other.Min[axis] <= this->Max[axis];
    }
    return doMeet;
  }

  double width(std::size_t axis) const { return this->Max[axis] - this->Min[axis]; }
  /// Returns the largest magnitude of a bound.
  double largest() const
  {
    double largest = 0;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      largest = std::max({ largest, std::fabs(this->Min[axis]), std::fabs(this->Max[axis]) });
    }
    return largest;
  }
  /// Returns the centre, also where the sum of bounds would overflow.
  Point<D> center() const
  {
    Point<D> center;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      center[axis] = this->Min[axis] / 2 + this->Max[axis] / 2;
    }
    return center;
  }
  /// Returns the parts below and above a cut across an axis.
  std::pair<Box, Box> cut(std::size_t axis, double at) const
  {
    std::pair<Box, Box> parts{ *this, *this };
    parts.first.Max[axis] = at;
    parts.second.Min[axis] = at;
    return parts;
  }
};

using Box2 = Box<2>;
using Box3 = Box<3>;

// OpenCL kernels and files have points and boxes as consecutive doubles.
static_assert(std::is_trivially_copyable_v<Point2> && std::is_trivially_copyable_v<Point3>);
static_assert(std::is_trivially_copyable_v<Box2> && std::is_trivially_copyable_v<Box3>);
static_assert(std::is_standard_layout_v<Point2> && std::is_standard_layout_v<Point3>);
static_assert(std::is_standard_layout_v<Box2> && std::is_standard_layout_v<Box3>);
static_assert(sizeof(Point2) == 2 * sizeof(double) && sizeof(Point3) == 3 * sizeof(double));
static_assert(sizeof(Box2) == 4 * sizeof(double) && sizeof(Box3) == 6 * sizeof(double));

/// Returns whether a box has points, and finite bounds.
template <int D>
bool isFinite(const Box<D>& box)
{
  return !box.isEmpty() && isFinite(box.Min) && isFinite(box.Max);
}

template <int D>
Box<D> scaled(Box<D> box, double factor)
{
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    box.Min[axis] *= factor;
    box.Max[axis] *= factor;
  }
  return box;
}

/// Returns the box's projection to the first D axes.
template <int D>
Box<D> projected(const Box3& box)
{
  return { projected<D>(box.Min), projected<D>(box.Max) };
}

///@{
/// Returns a box of the plane as one in space with z = 0, or a box in space itself.
inline Box3 inSpace(const Box2& box)
{
  return { { box.Min.x, box.Min.y, 0 }, { box.Max.x, box.Max.y, 0 } };
}
inline Box3 inSpace(const Box3& box)
{
  return box;
}
///@}

/// @name VTK's order of bounds: xmin, xmax, ymin, ymax, zmin, zmax
///@{
template <int D>
std::array<double, 2 * D> vtkBoundsOf(const Box<D>& box)
{
  std::array<double, 2 * D> bounds;
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    bounds[2 * axis] = box.Min[axis];
    bounds[2 * axis + 1] = box.Max[axis];
  }
  return bounds;
}

template <int D>
Box<D> boxOfVtkBounds(const double* bounds)
{
  Box<D> box;
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    box.Min[axis] = bounds[2 * axis];
    box.Max[axis] = bounds[2 * axis + 1];
  }
  return box;
}
///@}

} // namespace tipp

#endif

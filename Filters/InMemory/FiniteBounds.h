// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFiniteBounds_h
#define tippFiniteBounds_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tipp
{

/// The bounding box of the points whose three coordinates are finite, so that a single NaN or
/// infinity does not determine a tolerance or a bounding circle. All zero if there are no such
/// points.
struct FiniteBounds
{
  std::array<double, 3> Low{ 0, 0, 0 };
  std::array<double, 3> High{ 0, 0, 0 };

  double center(int axis) const
  {
    return 0.5 * this->Low[std::size_t(axis)] + 0.5 * this->High[std::size_t(axis)];
  }
  double diagonal() const
  {
    return std::hypot(
      this->High[0] - this->Low[0], this->High[1] - this->Low[1], this->High[2] - this->Low[2]);
  }
};

/// The bounds of `count` points; pointAt(index, xyz) writes a point's coordinates and is called by
/// several threads.
template <typename PointAt>
FiniteBounds finiteBounds(std::int64_t count, const PointAt& pointAt)
{
  const double infinity = std::numeric_limits<double>::infinity();
  double low0 = infinity, low1 = infinity, low2 = infinity;
  double high0 = -infinity, high1 = -infinity, high2 = -infinity;
#pragma omp parallel for reduction(min : low0, low1, low2) reduction(max : high0, high1, high2)
  for (std::int64_t i = 0; i < count; ++i)
  {
    double p[3];
    pointAt(i, p);
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
    {
      low0 = std::min(low0, p[0]);
      low1 = std::min(low1, p[1]);
      low2 = std::min(low2, p[2]);
      high0 = std::max(high0, p[0]);
      high1 = std::max(high1, p[1]);
      high2 = std::max(high2, p[2]);
    }
  }
  return low0 <= high0 ? FiniteBounds{ { low0, low1, low2 }, { high0, high1, high2 } }
                       : FiniteBounds{};
}

/// Eight points on a circle around the centre of a box, at its middle height. The radius is
/// `offset` times the box's diagonal.
inline std::array<std::array<double, 3>, 8> boundingCircle(
  const FiniteBounds& bounds, double offset)
{
  const double radius = offset * bounds.diagonal();
  const double pi = std::acos(-1.0);
  std::array<std::array<double, 3>, 8> circle;
  for (std::size_t i = 0; i < circle.size(); ++i)
  {
    const double angle = 2 * pi * double(i) / double(circle.size());
    circle[i] = { bounds.center(0) + radius * std::cos(angle),
      bounds.center(1) + radius * std::sin(angle), bounds.center(2) };
  }
  return circle;
}

} // namespace tipp

#endif

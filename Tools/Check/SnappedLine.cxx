// SPDX-License-Identifier: BSD-3-Clause
#include "Check/SnappedLine.h"

#include "Check/ExactNumber.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tipp
{
namespace check
{
namespace
{

/// The distances from a coordinate to the next doubles below and above it.
struct Gaps
{
  Gaps(double below, double above)
    : Below(below)
    , Above(above)
  {
  }
  explicit Gaps(double value)
    : Below(value - std::nextafter(value, -HUGE_VAL))
    , Above(std::nextafter(value, HUGE_VAL) - value)
  {
    // Infinity is beside the largest double.
    this->Below = std::isfinite(this->Below) ? this->Below : this->Above;
    this->Above = std::isfinite(this->Above) ? this->Above : this->Below;
  }
  double Below;
  double Above;
};

/// The sum of both is at least the distance of any two neighbouring doubles up to `a` or `b`.
Gaps gapsAtLarger(double a, double b)
{
  return Gaps(std::max(std::fabs(a), std::fabs(b)));
}

/// The values of the equation of the line through a and b in the box around p that extends in each
/// direction by `units` times a gap. `Size` is the sum of all products' sizes: the result has an
/// error of a few roundings of it, if a Number has any.
template <typename Number>
struct LineInBox
{
  LineInBox(Position a, Position b, Position p, Gaps x, Gaps y, double units)
  {
    using std::abs;
    const Number dx = Number(b.x) - Number(a.x);
    const Number dy = Number(b.y) - Number(a.y);
    const Number toY = dx * (Number(p.y) - Number(a.y));
    const Number toX = dy * (Number(p.x) - Number(a.x));
    const Number up = Number(units) * dx * Number(dx > 0 ? y.Above : -y.Below);
    const Number down = Number(units) * dx * Number(dx > 0 ? y.Below : -y.Above);
    const Number left = Number(units) * dy * Number(dy > 0 ? x.Below : -x.Above);
    const Number right = Number(units) * dy * Number(dy > 0 ? x.Above : -x.Below);
    this->Highest = toY - toX + up + left;
    this->Lowest = toY - toX - down - right;
    this->Size = abs(toY) + abs(toX) + up + down + left + right;
  }
  Number Highest;
  Number Lowest;
  Number Size;
};

bool meets(Position a, Position b, Position p, Gaps x, Gaps y, double units)
{
  using Fast = long double; // its exponents hold all products
  const LineInBox<Fast> fast(a, b, p, x, y, units);
  const Fast error = 16 * std::numeric_limits<Fast>::epsilon() * fast.Size;
  if (fast.Highest < -error || fast.Lowest > error)
  {
    return false;
  }
  if (fast.Highest > error && fast.Lowest < -error)
  {
    return true;
  }
  const LineInBox<ExactNumber> exact(a, b, p, x, y, units);
  return exact.Highest >= 0 && exact.Lowest <= 0;
}

} // namespace

bool SnappedLine::isBefore(Position p, Position q) const
{
  const bool isForwardX = this->B.x < this->A.x ? q.x <= p.x : p.x <= q.x;
  const bool isForwardY = this->B.y < this->A.y ? q.y <= p.y : p.y <= q.y;
  return isForwardX && isForwardY && !(p.x == q.x && p.y == q.y);
}

bool SnappedLine::roundsTo(Position p) const
{
  constexpr double half = 0.5;
  return meets(this->A, this->B, p, Gaps(p.x), Gaps(p.y), half);
}

bool SnappedLine::reaches(Position p) const
{
  if (this->WideReach)
  {
    const auto [x, y] = *this->WideReach;
    return meets(this->A, this->B, p, { x, x }, { y, y }, 1);
  }
  constexpr double units = 64;
  return meets(this->A, this->B, p, gapsAtLarger(this->A.x, this->B.x),
    gapsAtLarger(this->A.y, this->B.y), units);
}

} // namespace check
} // namespace tipp

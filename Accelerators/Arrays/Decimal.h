// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDecimal_h
#define tippDecimal_h

#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tipp
{

/// @name Decimal grids
/// A user writes 0.1, and the nearest double is slightly more. The functions for grids therefore
/// compute with the shortest decimal number that stands for a double, which is the number as it was
/// written. The results are exact unless the numbers have too many digits or too distant exponents;
/// then doubles are used.
///@{

/// Returns origin + halves / 2 * step, rounded once.
VTKTIPPACCELERATORS_EXPORT double gridPosition(double origin, double step, std::int64_t halves);

/// Returns the largest whole k with origin + k * step <= v + slack. `step` is above 0.
VTKTIPPACCELERATORS_EXPORT double stepsUpTo(double origin, double step, double v, double slack);

/// Returns the smallest whole k with origin + k * step >= v - slack. `step` is above 0.
inline double stepsToReach(double origin, double step, double v, double slack)
{
  return -stepsUpTo(-origin, step, -v, slack);
}

/// Returns (high - low) / count, rounded once.
VTKTIPPACCELERATORS_EXPORT double partOfRange(double low, double high, int count);

/// The numbers origin + i * step, rounded once if start, step and scale are whole numbers of at
/// most 53 bits. This needs no wide integers, so devices can do it, too.
struct VTKTIPPACCELERATORS_EXPORT GridSteps
{
  GridSteps(double origin, double step);

  double operator[](double i) const { return (this->Start + i * this->Step) / this->Scale; }

  double Start;
  double Step;
  double Scale; ///< a power of ten; 1 if Start and Step are the origin and the step themselves
};

///@}

/// Returns by how much rounding may move coordinates of up to this absolute value, when they are
/// read, scaled or computed from an origin and a step.
inline double roundingOf(double largest)
{
  return 0x1p-50 * largest;
}

/// Returns by how much rounding may move coordinates from `low` to `high`.
inline double roundingOf(double low, double high)
{
  return roundingOf(std::max(std::fabs(low), std::fabs(high)));
}

} // namespace tipp

#endif

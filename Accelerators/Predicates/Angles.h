// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAngles_h
#define tippAngles_h

#include "vtkTIPPAcceleratorsModule.h"

namespace tipp
{

// Angles in degrees, from additions, multiplications and divisions alone, which IEEE 754 rounds
// everywhere alike. The C library's functions differ in their last bit between libraries, and
// between processors with and without fused multiplication; results of this software must not.
// Each value is within four units in the last digit of the exact one.

/// Returns the sine of an angle in degrees; NaN for NaN and infinite angles.
VTKTIPPACCELERATORS_EXPORT double sineOfDegrees(double degrees);

/// Returns the cosine of an angle in degrees; NaN for NaN and infinite angles.
VTKTIPPACCELERATORS_EXPORT double cosineOfDegrees(double degrees);

/// Returns the angle of the vector (x, y) with the x axis, counter-clockwise, in degrees from -180
/// to 180, as std::atan2(y, x) does in radians: 0 for the vector (0, 0), NaN if x or y is NaN.
VTKTIPPACCELERATORS_EXPORT double degreesOf(double x, double y);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDegeneratePoints_h
#define tippDegeneratePoints_h

#include "PointSets.h"

#include <random>

namespace tipp
{
namespace test
{

using Engine = std::mt19937_64;

/// Draws 0 to 60 points of a random kind: small lattices (scaled, moved, sheared), mixed exponents,
/// lines, points an ulp away from a line or a circle. Some are duplicates, and some are not finite.
Coordinates drawDegeneratePoints(Engine& random);

/// The same in space, with x, y and z of each point: lattices, mixed exponents, and points an ulp
/// away from a plane, a line or a sphere.
Coordinates drawDegeneratePointsInSpace(Engine& random);

} // namespace test
} // namespace tipp

#endif

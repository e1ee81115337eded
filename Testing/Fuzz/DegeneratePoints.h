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

/// 0 to 60 points of a kind drawn too: small lattices (scaled, moved, sheared), mixed exponents,
/// points an ulp beside a line or a circle, lines, with duplicates and now and then a point that is
/// not finite.
Coordinates drawDegeneratePoints(Engine& random);

/// The same in space, x, y and z of each: lattices, mixed exponents, points an ulp beside a plane,
/// a line or a sphere.
Coordinates drawDegeneratePointsInSpace(Engine& random);

} // namespace test
} // namespace tipp

#endif

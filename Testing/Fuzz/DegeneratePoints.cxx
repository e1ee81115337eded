// SPDX-License-Identifier: BSD-3-Clause
#include "DegeneratePoints.h"

#include <cmath>

namespace tipp
{
namespace test
{
namespace
{

int below(Engine& random, int n)
{
  return int(random() % std::uint64_t(n));
}

double unit(Engine& random)
{
  return double(random() >> 11) * 0x1p-53;
}

/// A random scale, from denormal coordinates to coordinates whose squares overflow.
double drawScale(Engine& random)
{
  const double scales[] = { 1, 1, 1, 0.1, 1.0 / 3, 1e-3, 1e7, 1e12, 0x1p-1074, 1e-310, 1e-300,
    1e-160, 1e150, 1e300 };
  return scales[below(random, 14)];
}

Coordinates lattice(Engine& random, int count)
{
  const int side = 1 + below(random, 9);
  const int shear = below(random, 3);
  const double scale = drawScale(random);
  const double offsets[] = { 0, 0, 1, -3, 1e12, 1e-3 };
  const double offset = scale * offsets[below(random, 6)];
  Coordinates xy;
  for (int i = 0; i < count; ++i)
  {
    const int x = below(random, side);
    const int y = below(random, side);
    xy.push_back(offset + scale * (x + shear * y));
    xy.push_back(offset + scale * y);
  }
  return xy;
}

Coordinates mixedExponents(Engine& random, int count)
{
  const int range = 1 + below(random, 1000);
  Coordinates xy;
  for (int i = 0; i < 2 * count; ++i)
  {
    const double mantissa = below(random, 4) == 0 ? below(random, 3) - 1 : 2 * unit(random) - 1;
    xy.push_back(std::ldexp(mantissa, below(random, range) - range / 2));
  }
  return xy;
}

/// Moves a coordinate by up to `ulps` units in the last place, up or down.
double nudge(Engine& random, double value, int ulps)
{
  for (int i = below(random, 2 * ulps + 1) - ulps; i != 0; i += i < 0 ? 1 : -1)
  {
    value = std::nextafter(value, i < 0 ? -HUGE_VAL : HUGE_VAL);
  }
  return value;
}

Coordinates nearLine(Engine& random, int count)
{
  const double slope = below(random, 5) / 3.0;
  const double scale = drawScale(random);
  const int ulps = below(random, 3);
  Coordinates xy;
  for (int i = 0; i < count; ++i)
  {
    const double x = scale * (below(random, 2) ? below(random, 20) : unit(random));
    xy.push_back(nudge(random, x, ulps));
    xy.push_back(nudge(random, slope * x, ulps));
  }
  return xy;
}

/// Points exactly on circles of integer radius, then moved by a few ulps.
Coordinates nearCircle(Engine& random, int count)
{
  const int triples[][2] = { { 65, 0 }, { 63, 16 }, { 60, 25 }, { 56, 33 }, { 52, 39 } };
  const double scale = drawScale(random) / (below(random, 2) ? 64 : 65);
  const int ulps = below(random, 3);
  Coordinates xy;
  for (int i = 0; i < count; ++i)
  {
    const int* triple = triples[below(random, 5)];
    const int swapped = below(random, 2);
    for (int axis = 0; axis < 2; ++axis)
    {
      const int sign = below(random, 2) ? 1 : -1;
      xy.push_back(nudge(random, scale * (sign * triple[axis ^ swapped]), ulps));
    }
  }
  return xy;
}

Coordinates twoScales(Engine& random, int count)
{
  Coordinates xy = lattice(random, count);
  const double scale = std::ldexp(1, below(random, 100) - 50);
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    xy[i] *= scale;
  }
  return xy;
}

void spoil(Engine& random, Coordinates& coordinates, std::size_t dimension)
{
  const double never[] = { std::nan(""), HUGE_VAL, -HUGE_VAL };
  if (!coordinates.empty() && below(random, 8) == 0)
  {
    coordinates[random() % coordinates.size()] = never[below(random, 3)];
  }
  if (!coordinates.empty() && below(random, 4) == 0)
  {
    const std::size_t from = dimension * (random() % (coordinates.size() / dimension));
    const Coordinates point(coordinates.begin() + std::ptrdiff_t(from),
      coordinates.begin() + std::ptrdiff_t(from + dimension));
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  }
}

Coordinates latticeInSpace(Engine& random, int count)
{
  const int side = 1 + below(random, 5);
  const int shear = below(random, 3);
  const double scale = drawScale(random);
  const double offsets[] = { 0, 0, 1, -3, 1e12, 1e-3 };
  const double offset = scale * offsets[below(random, 6)];
  Coordinates xyz;
  for (int i = 0; i < count; ++i)
  {
    const int x = below(random, side);
    const int y = below(random, side);
    const int z = below(random, side);
    for (const int coordinate : { x + shear * z, y, z })
    {
      xyz.push_back(offset + scale * coordinate);
    }
  }
  return xyz;
}

/// Points in a plane, or on a line in it, then moved by a few ulps.
Coordinates nearPlane(Engine& random, int count)
{
  const double slopes[] = { below(random, 5) / 3.0, below(random, 3) / 7.0 };
  const bool isLine = below(random, 4) == 0;
  const double scale = drawScale(random);
  const int ulps = below(random, 3);
  Coordinates xyz;
  for (int i = 0; i < count; ++i)
  {
    const double x = scale * (below(random, 2) ? below(random, 8) : unit(random));
    const double y = isLine ? 2 * x : scale * (below(random, 2) ? below(random, 8) : unit(random));
    for (const double coordinate : { x, y, slopes[0] * x + slopes[1] * y })
    {
      xyz.push_back(nudge(random, coordinate, ulps));
    }
  }
  return xyz;
}

/// Points exactly on a sphere of radius 9 and sometimes its centre, then scaled and moved by a few
/// ulps.
Coordinates nearSphere(Engine& random, int count)
{
  const int squaresAddTo81[][3] = { { 9, 0, 0 }, { 8, 4, 1 }, { 7, 4, 4 }, { 6, 6, 3 } };
  const double scale = drawScale(random) / (below(random, 2) ? 8 : 9);
  const int ulps = below(random, 3);
  Coordinates xyz;
  for (int i = 0; i < count; ++i)
  {
    const int* const triple = squaresAddTo81[below(random, 4)];
    const int first = below(random, 3);
    const int swapped = below(random, 2);
    const int isCentre = below(random, 20) == 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int at = (first + (swapped ? 3 - axis : axis)) % 3;
      const int sign = isCentre ? 0 : (below(random, 2) ? 1 : -1);
      xyz.push_back(nudge(random, scale * (sign * triple[at]), ulps));
    }
  }
  return xyz;
}

Coordinates mixedExponentsInSpace(Engine& random, int count)
{
  Coordinates xyz = mixedExponents(random, 3 * count / 2 + 1);
  xyz.resize(std::size_t(3 * count));
  return xyz;
}

} // namespace

Coordinates drawDegeneratePoints(Engine& random)
{
  Coordinates (*const kinds[])(
    Engine&, int) = { lattice, mixedExponents, nearLine, nearCircle, twoScales };
  const int count = below(random, below(random, 4) == 0 ? 61 : 13);
  Coordinates xy = kinds[below(random, 5)](random, count);
  spoil(random, xy, 2);
  return xy;
}

Coordinates drawDegeneratePointsInSpace(Engine& random)
{
  Coordinates (*const kinds[])(
    Engine&, int) = { latticeInSpace, nearPlane, nearSphere, mixedExponentsInSpace };
  const int count = below(random, below(random, 4) == 0 ? 61 : 13);
  Coordinates xyz = kinds[below(random, 4)](random, count);
  spoil(random, xyz, 3);
  return xyz;
}

} // namespace test
} // namespace tipp

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

/// One of many scales; the last are denormal, and so large that squares overflow.
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

/// Moves a coordinate by up to `ulps` to either side.
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

/// Exactly on circles of integer radius, then nudged.
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

void spoil(Engine& random, Coordinates& xy)
{
  const double never[] = { std::nan(""), HUGE_VAL, -HUGE_VAL };
  if (!xy.empty() && below(random, 8) == 0)
  {
    xy[random() % xy.size()] = never[below(random, 3)];
  }
  if (!xy.empty() && below(random, 4) == 0)
  {
    const std::size_t from = 2 * (random() % (xy.size() / 2));
    const double point[2] = { xy[from], xy[from + 1] };
    xy.insert(xy.end(), point, point + 2);
  }
}

} // namespace

Coordinates drawDegeneratePoints(Engine& random)
{
  Coordinates (*const kinds[])(
    Engine&, int) = { lattice, mixedExponents, nearLine, nearCircle, twoScales };
  const int count = below(random, below(random, 4) == 0 ? 61 : 13);
  Coordinates xy = kinds[below(random, 5)](random, count);
  spoil(random, xy);
  return xy;
}

} // namespace test
} // namespace tipp

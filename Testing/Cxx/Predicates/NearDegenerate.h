// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearDegenerate_h
#define tippNearDegenerate_h

#include "Predicates/Geometry.h"

#include <array>
#include <cstdint>
#include <ostream>
#include <random>

namespace tipp
{
void PrintTo(const Point2& point, std::ostream* out);
}

/// Draws points that are degenerate or differ from that by about an ulp. The same seed gives the
/// same points on every machine.
class NearDegenerate
{
public:
  using Points = std::array<tipp::Point2, 4>;

  explicit NearDegenerate(unsigned seed)
    : Engine(seed)
  {
  }

  /// Random nodes of a size x size lattice, which may be equal. `step` is the spacing.
  Points lattice(int size, double step, tipp::Point2 offset);
  /// Four points on a circle around a lattice node, rounded and then moved by up to two ulps each.
  Points cocircular(double step, tipp::Point2 offset);
  /// Four points on a line, rounded and then moved by up to two ulps each.
  Points collinear(double step, tipp::Point2 offset);
  /// Every coordinate has its own exponent, between the two given ones.
  Points mixedExponents(int lowest, int highest);
  /// Every coordinate is a small integer times one of a few powers of two between the given ones:
  /// ties between numbers of very different magnitude.
  Points fewMagnitudes(int lowest, int highest);
  /// Points at four random angles on the unit circle, rounded to doubles: all digits are in use.
  Points unitCircle();

  int integer(int low, int high)
  {
    return std::uniform_int_distribution<int>(low, high)(this->Engine);
  }
  double real(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Engine);
  }
  std::int64_t bits(int count);
  tipp::Point2 nudged(tipp::Point2 point);

private:
  std::mt19937_64 Engine;
};

/// Multiplies all coordinates by 2^exponent.
NearDegenerate::Points scaled(NearDegenerate::Points points, int exponent);

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearDegenerate_h
#define tippNearDegenerate_h

#include "Predicates/Points.h"

#include <array>
#include <cstdint>
#include <ostream>
#include <random>

namespace tipp
{
void PrintTo(const Point2& point, std::ostream* out);
}

/// Draws points that are degenerate, or an ulp or so beside it. The same seed gives the same
/// points.
class NearDegenerate
{
public:
  using Points = std::array<tipp::Point2, 4>;

  explicit NearDegenerate(unsigned seed)
    : Engine(seed)
  {
  }

  /// Distinct or equal nodes of a lattice of size x size around an offset, spaced by step.
  Points lattice(int size, double step, tipp::Point2 offset);
  /// Four points of one circle around a node, before rounding; then each moved by up to two ulps.
  Points cocircular(double step, tipp::Point2 offset);
  /// Four points of one line, before rounding; then each moved by up to two ulps.
  Points collinear(double step, tipp::Point2 offset);
  /// Every coordinate with an exponent of its own between the given powers of two.
  Points mixedExponents(int lowest, int highest);
  /// Every coordinate one of a few powers of two between the given ones, times a small integer:
  /// ties between numbers far apart.
  Points fewMagnitudes(int lowest, int highest);
  /// The unit circle's points in doubles, four random angles: all digits in use.
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

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSweepStrips_h
#define tippSweepStrips_h

#include "Predicates/Geometry.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Vertical strips with about the same number of points each, from left to right. Points with equal
/// x are in the same strip.
class SweepStrips
{
public:
  SweepStrips(const Point2* points, std::size_t count, std::size_t pointsInStrip);

  std::size_t size() const { return this->Starts.size() - 1; }
  /// The indices of all points, strip by strip, and ascending in each strip.
  const std::vector<std::uint32_t>& order() const { return this->Order; }
  /// The position in order() where a strip begins; for size(), the end.
  std::size_t start(std::size_t strip) const { return this->Starts[strip]; }

  /// A closed box that contains the points of this strip and of all later ones, but none of earlier
  /// ones.
  Box2 boxFrom(std::size_t strip) const;

  std::size_t bytes() const;

private:
  Box2 Bounds{};
  std::vector<double> Cuts; ///< the least x of each strip except the first
  std::vector<std::uint32_t> Order;
  std::vector<std::size_t> Starts;
};

} // namespace tipp

#endif

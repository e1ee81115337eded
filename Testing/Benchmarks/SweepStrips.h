// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSweepStrips_h
#define tippSweepStrips_h

#include "Predicates/Points.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Points in vertical strips of about equally many, from left to right; points of one x are in one
/// strip.
class SweepStrips
{
public:
  SweepStrips(const Point2* points, std::size_t count, std::size_t pointsInStrip);

  std::size_t size() const { return this->Starts.size() - 1; }
  /// The places of all points, strip by strip; ascending in each.
  const std::vector<std::uint32_t>& order() const { return this->Order; }
  /// The first place of a strip in the order; one more at the end.
  std::size_t start(std::size_t strip) const { return this->Starts[strip]; }

  /// A closed box that holds this strip's points and all behind it, and none before it.
  Box2 boxFrom(std::size_t strip) const;

  std::size_t bytes() const;

private:
  Box2 Bounds{};
  std::vector<double> Cuts; ///< the least x that each strip but the first may have
  std::vector<std::uint32_t> Order;
  std::vector<std::size_t> Starts;
};

} // namespace tipp

#endif

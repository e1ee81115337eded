// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippThinning_h
#define tippThinning_h

#include <string>

namespace tipp
{

/// One point is kept in each square of a grid whose lines are at multiples of the cell size.
struct Thinning
{
  enum class Rule
  {
    Lowest,
    Highest,
    Nearest ///< to the middle of the square
  };

  double Cell = 0; ///< 0: all points are kept
  Rule Keep = Rule::Nearest;
  /// How the path of a temporary file begins, where the squares may not fit in memory; empty: they
  /// are kept in memory.
  std::string File;

  bool isGiven() const { return this->Cell > 0; }
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSnappedLine_h
#define tippSnappedLine_h

#include "Check/ExactTests.h"

#include <optional>

namespace tipp
{
namespace check
{

/// Tests of a vertex against the line of a constraint, or of a part of one, which rounding may have
/// moved. All are exact.
class SnappedLine
{
public:
  /// `a` and `b`: the ends, which are finite and differ. `wideReach`: how far from the line
  /// reaches() looks in x and y; by default as far as 16 rounds of rounding lead a constraint.
  SnappedLine(Position a, Position b, std::optional<Position> wideReach = {})
    : A(a)
    , B(b)
    , WideReach(wideReach)
  {
  }

  /// Returns whether p precedes q on the way from a to b, in both coordinates. Rounding keeps this
  /// order.
  bool isBefore(Position p, Position q) const;

  /// Returns whether a point of the line rounds to p: the line meets the box around p that ends
  /// half-way to the next doubles.
  bool roundsTo(Position p) const;

  /// Returns whether p is on the line.
  bool holds(Position p) const { return turn(this->A, this->B, p) == 0; }

  /// Returns whether p may be on the constraint after many rounds of rounding. The first ten rounds
  /// move a constraint by half a unit in the last place each, and the next ones by at most 1/2, 1,
  /// 2, 4 ... units. So after 16 rounds it is less than 64 units of the larger end away in each
  /// coordinate.
  bool reaches(Position p) const;

private:
  Position A;
  Position B;
  std::optional<Position> WideReach;
};

} // namespace check
} // namespace tipp

#endif

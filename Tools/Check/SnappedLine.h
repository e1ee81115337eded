// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSnappedLine_h
#define tippSnappedLine_h

#include "Check/ExactTests.h"

namespace tipp
{
namespace check
{

/// Tests of a vertex against the line of a constraint, or of a part of one, which rounding may have
/// moved. All are exact.
class SnappedLine
{
public:
  /// `a` and `b`: the ends, which are finite and differ.
  SnappedLine(Position a, Position b)
    : A(a)
    , B(b)
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

  /// Returns whether p may be on the constraint after up to 16 rounds of rounding: it is at most 64
  /// units in the last place of the larger end away in each coordinate. The first ten rounds move a
  /// constraint by half a unit each, and the next six by at most 1/2, 1, 2, 4, 8 and 16 units.
  bool reaches(Position p) const;

private:
  Position A;
  Position B;
};

} // namespace check
} // namespace tipp

#endif

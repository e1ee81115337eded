// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRoundedBorder_h
#define tippRoundedBorder_h

#include "Check/ExactTests.h"

#include <vector>

namespace tipp
{
namespace check
{

/// The edges of a refined mesh's border that are on segments of the input. Split points are
/// rounded, so that such an edge may lie beyond its segment, and have a point of the input on its
/// wrong side: one that is outside of the segment, by less than SplitChains::reach().
class RoundedBorder
{
public:
  /// Adds the edge from p to q, which is on the segment from a to b and has its direction.
  /// `isMeshLeft`: whether the mesh is to the left of it.
  void add(Position a, Position b, Position p, Position q, bool isMeshLeft);
  /// Call this after the last edge.
  void finish();

  /// Returns whether a point is strictly outside of a segment, but rounding may have led an edge
  /// there beyond the point.
  bool mayCover(Position p) const;

private:
  struct Part
  {
    Position A; ///< the mesh is to the left of the segment from A to B
    Position B;
    Position P; ///< the western end of the edge
    Position Q;
  };

  std::vector<Part> Parts; ///< sorted by x of P
  double Widest = 0;       ///< the largest difference of the ends' x, and the largest reach
};

} // namespace check
} // namespace tipp

#endif

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
  /// A straight part of a segment.
  struct Line
  {
    Position A; ///< the segment's ends
    Position B;
    Position From; ///< the part's ends, which may be rounded crossings
    Position To;
  };

  /// Adds the edge from p to q, which is on the part and has its direction. `isMeshLeft`: whether
  /// the mesh is to the left of it.
  void add(Line line, Position p, Position q, bool isMeshLeft);
  /// Call this after the last edge.
  void finish();

  /// Returns whether a point is strictly outside of a part of a segment, and not on the segment,
  /// but rounding may have led an edge there beyond the point.
  bool mayCover(Position p) const;

private:
  struct Edge
  {
    Line On;    ///< its mesh is to the left
    Position P; ///< the western end
    Position Q;
  };

  std::vector<Edge> Edges; ///< sorted by x of P
  double Widest = 0;       ///< the largest difference of the ends' x, with the reach of rounding
};

} // namespace check
} // namespace tipp

#endif

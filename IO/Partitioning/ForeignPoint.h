// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippForeignPoint_h
#define tippForeignPoint_h

#include <cstdint>
#include <vector>

namespace tipp
{

/// A ghost point: a vertex that a piece needs but does not own.
struct ForeignPoint
{
  std::int64_t Point;
  std::int32_t Piece;
  std::int32_t GhostOnly; ///< 1 if only borrowed cells use it, else 0
};

/// Sorts by point, then piece, and removes duplicates: several cells may need a point. A point that
/// an owned cell uses is not GhostOnly.
void makeDistinct(std::vector<ForeignPoint>& points);

} // namespace tipp

#endif

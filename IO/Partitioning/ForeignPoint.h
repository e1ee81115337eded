// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippForeignPoint_h
#define tippForeignPoint_h

#include <cstdint>
#include <vector>

namespace tipp
{

/// A vertex that a piece needs beside those in its box.
struct ForeignPoint
{
  std::int64_t Point;
  std::int32_t Piece;
  std::int32_t GhostOnly; ///< 0 or 1
};

/// Sorts them by point, then piece, and keeps one of each; several cells may have asked for it, and
/// one that is owned outweighs all borrowed ones.
void makeDistinct(std::vector<ForeignPoint>& points);

} // namespace tipp

#endif

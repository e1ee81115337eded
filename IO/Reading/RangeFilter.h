// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRangeFilter_h
#define tippRangeFilter_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Predicates/Box3.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A closed box that cells must share a point with, decided exactly; triangles by x and y alone.
class RangeFilter
{
public:
  RangeFilter(const PartitionedMesh& mesh, const Bounds& range);

  /// The pieces whose partition the range meets, ascending.
  const std::vector<std::size_t>& pieces() const { return this->Open; }

  /// The cells of a piece that meet the range, and their points. The piece comes with its borrowed
  /// cells: one whose owner is not among pieces() belongs to the lowest of those that it meets, and
  /// likewise a point. `borrowed`: the other borrowed ones stay, as ghosts.
  Piece apply(const Piece& piece, std::size_t number, bool borrowed) const;

private:
  bool meets(const Piece& piece, std::int64_t cell, const Box3& box) const;
  /// A bit of each point for each side of the range that it lies beyond.
  std::vector<std::uint8_t> sidesOfPoints(const Piece& piece) const;
  bool meetsRange(
    const Piece& piece, std::int64_t cell, const std::vector<std::uint8_t>& sides) const;
  bool isLowerPieceMet(const Piece& piece, std::int64_t cell, std::size_t number) const;
  void setPointGhosts(Piece& piece, std::size_t number) const;

  const PartitionedMesh& Mesh;
  Box3 Range;
  std::vector<std::size_t> Open;
};

/// A piece's box; in the plane with nothing along z.
Box3 boxOf(const PartitionedMesh& mesh, const Bounds& bounds);

} // namespace tipp

#endif

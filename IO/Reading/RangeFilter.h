// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRangeFilter_h
#define tippRangeFilter_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Predicates/Point3.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Selects cells that share a point with a closed box, decided exactly; triangles by x and y alone.
class RangeFilter
{
public:
  RangeFilter(const PartitionedMesh& mesh, const Bounds& range);

  /// The indices of the pieces whose partition meets the range, ascending.
  const std::vector<std::size_t>& pieces() const { return this->Open; }

  /// Returns the cells of a piece that meet the range, and their points. `piece` must include its
  /// borrowed cells: a cell whose owner is not among pieces() is assigned to the lowest of those
  /// that it meets; likewise a point. `borrowed`: keep the other borrowed cells as ghosts.
  Piece apply(const Piece& piece, std::size_t number, bool borrowed) const;

private:
  bool meets(const Piece& piece, std::int64_t cell, const Box3& box) const;
  /// For each point a bit mask of the sides of the range that it lies outside of.
  std::vector<std::uint8_t> sidesOfPoints(const Piece& piece) const;
  bool meetsRange(
    const Piece& piece, std::int64_t cell, const std::vector<std::uint8_t>& sides) const;
  bool isLowerPieceMet(const Piece& piece, std::int64_t cell, std::size_t number) const;
  void setPointGhosts(Piece& piece, std::size_t number) const;

  const PartitionedMesh& Mesh;
  Box3 Range;
  std::vector<std::size_t> Open;
};

/// Converts a piece's bounds to a box; in 2D the z range is [0, 0].
Box3 boxOf(const PartitionedMesh& mesh, const Bounds& bounds);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceTable_h
#define tippPieceTable_h

#include "Partitioned/PartitionedMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Cells, or points, that the same other pieces borrow. They lie together in their owner's arrays.
struct LentGroup
{
  std::vector<std::int32_t> To; ///< ascending
  std::int64_t Count = 0;
};

/// A group of another piece.
struct BorrowedGroup
{
  std::int32_t Owner = 0;
  std::int32_t Group = 0;
};

/// What a reader needs to know of one piece beyond its summary. Every array of the piece consists
/// of parts: the tuples that no other piece borrows, a part for each lent group in this order, and,
/// where borrowed cells are duplicated, what belongs to borrowed cells alone.
struct PieceTable
{
  std::vector<std::uint64_t> Offsets; ///< of each array's data in the piece's file
  std::vector<LentGroup> PointGroups;
  std::vector<LentGroup> CellGroups;
  std::vector<BorrowedGroup> BorrowedPoints; ///< by owner, then group
  std::vector<BorrowedGroup> BorrowedCells;
  std::vector<std::vector<std::uint64_t>> Checksums; ///< of each array, one a part
  std::uint64_t HeaderBytes = 0;
  std::uint64_t HeaderChecksum = 0;

  /// Tuples of each part of the arrays of points, or of cells.
  VTKTIPPIO_EXPORT std::vector<std::int64_t> parts(
    const PartitionedMesh& mesh, const PieceSummary& piece, bool ofPoints) const;
};

/// The table as it stands in tables.bin: 64-bit words.
VTKTIPPIO_EXPORT std::vector<std::uint64_t> packTable(const PieceTable& table);

/// Takes such words, which are those of a piece whose summary the mesh has, and checks every
/// number in them; throws IOError.
PieceTable unpackTable(
  const PartitionedMesh& mesh, std::size_t piece, std::vector<std::uint64_t> words);

/// Reads a piece's table from tables.bin and unpacks it; throws IOError.
VTKTIPPIO_EXPORT PieceTable readPieceTable(const PartitionedMesh& mesh, std::size_t piece);

} // namespace tipp

#endif

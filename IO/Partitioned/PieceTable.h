// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceTable_h
#define tippPieceTable_h

#include "Partitioned/PartitionedMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Cells, or points, with the same set of borrowers. They are contiguous in their owner's arrays.
struct LentGroup
{
  std::vector<std::int32_t> To; ///< the borrowing pieces, ascending
  std::int64_t Count = 0;
};

/// A group of another piece.
struct BorrowedGroup
{
  std::int32_t Owner = 0;
  std::int32_t Group = 0;
};

/// What a reader needs to know of a piece beyond its summary. Every array of the piece consists of
/// parts: the tuples that no other piece borrows, then one part per lent group in this order, and,
/// if borrowed cells are duplicated, the tuples of borrowed cells.
struct PieceTable
{
  std::vector<std::uint64_t> Offsets; ///< in bytes, of each array's data in the piece's file
  std::vector<LentGroup> PointGroups;
  std::vector<LentGroup> CellGroups;
  std::vector<BorrowedGroup> BorrowedPoints; ///< sorted by owner, then group
  std::vector<BorrowedGroup> BorrowedCells;
  std::vector<std::vector<std::uint64_t>> Checksums; ///< per array, one for each part
  std::uint64_t HeaderBytes = 0;
  std::uint64_t HeaderChecksum = 0;

  /// The number of tuples in each part of the arrays of points, or of cells.
  VTKTIPPIO_EXPORT std::vector<std::int64_t> parts(
    const PartitionedMesh& mesh, const PieceSummary& piece, bool ofPoints) const;
};

/// Converts a table to the 64-bit words that tables.bin holds.
VTKTIPPIO_EXPORT std::vector<std::uint64_t> packTable(const PieceTable& table);

/// Parses such words, for a piece whose summary the mesh has, and checks every number; throws
/// IOError.
PieceTable unpackTable(
  const PartitionedMesh& mesh, std::size_t piece, std::vector<std::uint64_t> words);

/// Reads a piece's table from tables.bin and parses it; throws IOError.
VTKTIPPIO_EXPORT PieceTable readPieceTable(const PartitionedMesh& mesh, std::size_t piece);

} // namespace tipp

#endif

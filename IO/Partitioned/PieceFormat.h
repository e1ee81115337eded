// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceFormat_h
#define tippPieceFormat_h

#include "Hdf/HdfObjects.h"
#include "Partitioned/PartitionedMesh.h"
#include "Ranks/Archive.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Cells, or points, with the same set of borrowers. They are contiguous in their owner's arrays.
struct SharedGroup
{
  std::vector<std::int32_t> Borrowers; ///< pieces, ascending
  std::int64_t Count = 0;              ///< number of cells or points
};

template <typename Archive>
void serialize(Archive& archive, SharedGroup& group)
{
  archive(group.Borrowers, group.Count);
}

/// A group of another piece.
struct BorrowedGroup
{
  std::int32_t Owner = 0; ///< index of the piece that owns the group
  std::int32_t Group = 0; ///< index of the group among the owner's
};

/// What a reader needs to know of a piece beyond its summary. Every array of the piece consists of
/// parts: the tuples that no other piece borrows, then one part per shared group in this order,
/// and, if borrowed cells are duplicated, the tuples of borrowed cells.
struct PieceTable
{
  std::vector<std::uint64_t> Offsets; ///< offset in bytes of each array's data in the piece's file
  std::vector<SharedGroup> PointGroups;              ///< own points that other pieces borrow
  std::vector<SharedGroup> CellGroups;               ///< own cells that other pieces borrow
  std::vector<BorrowedGroup> BorrowedPoints;         ///< sorted by owner, then group
  std::vector<BorrowedGroup> BorrowedCells;          ///< sorted by owner, then group
  std::vector<std::vector<std::uint64_t>> Checksums; ///< per array, one for each part
  std::uint64_t HeaderBytes = 0;    ///< size of the file's XML header and HDF5 part
  std::uint64_t HeaderChecksum = 0; ///< XXH3 of both, 64 bits

  /// The first tuple of each part of the arrays of points, or of cells, and the end of the last.
  VTKTIPPIO_EXPORT std::vector<std::int64_t> partStarts(
    const PartitionedMesh& mesh, const PieceSummary& piece, bool ofPoints) const;
};

/// The table as tables.bin holds it: numbers of 64 bits.
VTKTIPPIO_EXPORT Bytes packTable(const PieceTable& table);

/// Reads a piece's table from tables.bin and checks every number; throws IOError.
VTKTIPPIO_EXPORT PieceTable readPieceTable(const PartitionedMesh& mesh, std::size_t piece);

/// The content of an array of a piece's file.
enum class PieceRole
{
  Points,
  PointIds,
  PointGhosts,
  PointData,
  Connectivity,
  Offsets,
  Types,
  CellIds,
  CellGhosts,
  CellData
};

/// An array in a piece's file.
struct PieceArray
{
  PieceRole Role;
  std::string Name;
  Scalar Type;
  int Components;
  std::int64_t Attribute = -1; ///< for Role Data: index in PartitionedMesh::Arrays

  bool ofPoints() const { return this->Role <= PieceRole::PointData; }
  std::size_t tupleBytes() const { return std::size_t(this->Components) * scalarSize(this->Type); }
};

/// The index of the array with a role other than data.
std::size_t findArray(const std::vector<PieceArray>& arrays, PieceRole role);

/// The index of the array of an attribute, given by its index in PartitionedMesh::Arrays.
std::size_t findArrayOf(const std::vector<PieceArray>& arrays, std::int64_t attribute);

/// Writes the tuples of the array `offsets` or `types` of `count` cells from index `first` on.
void fillShapes(
  const PieceArray& array, int cellSize, std::int64_t first, std::int64_t count, char* to);

/// Names of the arrays that every piece has.
extern const char* const pointIdsName;
extern const char* const cellIdsName;
extern const char* const ghostsName;

/// An attribute's name in the pieces: "level step 7" for a step of one that varies in time. VTK's
/// own attribute TimeStep is not used: its reader, up to version 9.2 at least, appends the cells
/// again for each step that it reads.
std::string storedName(const StoredArray& array);

/// The first stored name that two arrays of points, or two of cells, have, or that every piece uses
/// for an array of its own. Empty if all names differ.
VTKTIPPIO_EXPORT std::string repeatedName(const std::vector<StoredArray>& arrays);

/// Whether the piece's local ids need 64 bits: a point index or the length of the connectivity
/// exceeds 31 bits.
bool hasWideIds(const PartitionedMesh& mesh, const PieceSummary& piece);

/// The arrays of a piece in the order of its file.
VTKTIPPIO_EXPORT std::vector<PieceArray> pieceArrays(
  const PartitionedMesh& mesh, const PieceSummary& piece);

/// The number of points, or of cells, in the piece's file, including those of duplicated borrowed
/// cells.
std::int64_t storedTuples(const PartitionedMesh& mesh, const PieceSummary& piece, bool ofPoints);

/// The name of an array, by its index in pieceArrays(), among the HDF5 arrays of a piece's file.
std::string hdfNameOf(std::size_t array);

/// The shape of that HDF5 array. The corners of all cells are one list.
HdfShape hdfShapeOf(const PieceArray& array, std::uint64_t tuples);

/// The offsets, in bytes, of all sections of a piece's file.
struct PieceLayout
{
  std::string Header;                 ///< the XML and the HDF5 part, up to the first array's size
  std::vector<PieceArray> Arrays;     ///< in the order of the file
  std::vector<std::uint64_t> Offsets; ///< of each array's data; the 8 bytes before hold its size
  std::uint64_t End = 0;              ///< end of the last array, where the footer begins
};

/// The text after the last array.
extern const char* const pieceFooter;

/// If `room` is given, the arrays are laid out for these counts, which must be no smaller: so the
/// first tuples can be written before the final counts are known.
PieceLayout layOutPiece(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& piece,
  const PieceSummary* room = nullptr);

/// The text of the .pvtu file that lists all pieces.
std::string pvtuText(const PartitionedMesh& mesh);

} // namespace tipp

#endif

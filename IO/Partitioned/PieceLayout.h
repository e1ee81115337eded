// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceLayout_h
#define tippPieceLayout_h

#include "Partitioned/PartitionedMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// What an array of a piece's file holds.
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

struct PieceArray
{
  PieceRole Role;
  std::string Name;
  Scalar Type;
  int Components;
  std::int64_t Attribute = -1; ///< of PartitionedMesh::Arrays, for data

  bool ofPoints() const { return this->Role <= PieceRole::PointData; }
  std::size_t tupleBytes() const { return std::size_t(this->Components) * scalarSize(this->Type); }
};

/// Names of the arrays that every piece has.
extern const char* const pointIdsName;
extern const char* const cellIdsName;
extern const char* const ghostsName;

/// An attribute's name in the pieces: "level step 7" for a step of one that varies in time. VTK's
/// own attribute TimeStep is of no use: its reader, up to version 9.2 at least, adds the cells once
/// more for each step that it reads.
std::string storedName(const StoredArray& array);

/// Whether the piece's own ids need 64 bits: where a point's number or the connectivity's length
/// does not fit in 31.
bool hasWideIds(const PartitionedMesh& mesh, const PieceSummary& piece);

/// The arrays of a piece in the order in which its file has them.
VTKTIPPIO_EXPORT std::vector<PieceArray> pieceArrays(
  const PartitionedMesh& mesh, const PieceSummary& piece);

/// How many tuples an array of the piece has, those of borrowed cells that lie in it too.
std::int64_t storedTuples(
  const PartitionedMesh& mesh, const PieceSummary& piece, const PieceArray& array);

/// Where everything lies in a piece's file.
struct PieceLayout
{
  std::string Header; ///< the XML up to the first array's size
  std::vector<PieceArray> Arrays;
  std::vector<std::uint64_t> Offsets; ///< of each array's data; its size, 8 bytes, is before it
  std::uint64_t End = 0;              ///< of the last array, where the footer begins
};

/// What follows the last array.
extern const char* const pieceFooter;

/// With `room`, arrays begin where they would in a piece of those counts, which are no smaller: so
/// the first tuples can be written before the last are known.
PieceLayout layOutPiece(const PartitionedMesh& mesh, std::size_t number, const PieceSummary& piece,
  const PieceSummary* room = nullptr);

/// The .pvtu over all pieces.
std::string pvtuText(const PartitionedMesh& mesh);

} // namespace tipp

#endif

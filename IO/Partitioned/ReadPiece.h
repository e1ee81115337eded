// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadPiece_h
#define tippReadPiece_h

#include "Arrays/Buffer.h"
#include "Partitioned/PartitionedMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

struct Piece;

/// Options of readPiece().
struct PieceOptions
{
  bool Borrowed = true; ///< also read the borrowed cells, as ghosts
  /// Selects cells of the piece's file: called for `count` cells from index `first` on, appends the
  /// indices of the wanted ones to `chosen`. `ids` are the cells' corners, piece-local point
  /// indices, std::int64_t if `wide`, else std::int32_t. The piece's coordinates are already read.
  /// Returning false stops reading. Null selects all cells.
  using Choose = std::function<bool(const Piece& piece, std::int64_t first, std::int64_t count,
    const void* ids, bool wide, std::vector<std::int64_t>& chosen)>;
  Choose Cells; ///< null: all cells
  /// For each of PartitionedMesh::Arrays whether to read it; empty: all.
  std::vector<bool> Wanted;
  int Step = 0; ///< the step to read of arrays that vary in time

  /// Whether the mesh's array with this index is to be read.
  bool wants(const PartitionedMesh& mesh, std::size_t attribute) const;
};

/// A piece in memory. Within each of a piece's parts, points and cells are in ascending order of
/// their global ids; borrowed cells, and the points that only these use, come last.
struct Piece
{
  /// A point or cell array of the piece.
  struct Attribute
  {
    StoredArray Description;
    Buffer<char> Values; ///< tuples in the order of the piece's points or cells
  };

  int CellSize = 3;
  Scalar PointType = Scalar::Float64;
  /// connectivity: std::int64_t if true, else std::int32_t; indices within the piece
  bool WideIds = false;
  std::int64_t Points = 0;      ///< all points, including those that only borrowed cells use
  std::int64_t OwnedPoints = 0; ///< the points before those that only borrowed cells use
  std::int64_t Cells = 0;       ///< all cells, including borrowed ones
  std::int64_t OwnedCells = 0;  ///< the cells before the borrowed ones
  bool IsStopped = false;       ///< PieceOptions::Cells ended the reading; there are no cells
  Buffer<char> Coordinates;     ///< 3 per point
  Buffer<char> PointIds;        ///< global ids, std::int64_t
  Buffer<char> PointGhosts;     ///< std::uint8_t; 1: another piece owns the point
  Buffer<char> Connectivity;    ///< CellSize piece-local point indices per cell
  Buffer<char> CellIds;         ///< global ids, std::int64_t; cells from OwnedCells on are ghosts
  std::vector<Attribute> Attributes;
  std::int64_t BytesRead = 0; ///< from the files

  /// Returns the piece-local point index of corner `number` of a cell.
  std::int64_t corner(std::int64_t cell, int number) const
  {
    const auto at = std::size_t(cell * this->CellSize + number);
    return this->WideIds ? this->Connectivity.as<std::int64_t>()[at]
                         : this->Connectivity.as<std::int32_t>()[at];
  }
};

/// Reads a piece, each requested array with one read. Borrowed cells that are stored by reference
/// are read from their owners' files, where they and their points are contiguous; the result is the
/// same as with duplicated ones. If options.Cells selects cells, the piece has only those and the
/// borrowed ones, and all points, but not their ids and ghost marks; arrays that are not needed are
/// not verified. Throws IOError. Several threads may read pieces of a mesh at once.
VTKTIPPIO_EXPORT Piece readPiece(
  const PartitionedMesh& mesh, std::size_t number, const PieceOptions& options = {});

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadPiece_h
#define tippReadPiece_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/RawBuffer.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

struct PieceOptions
{
  bool Borrowed = true; ///< the cells that the piece borrows too, as ghosts
  /// Which of PartitionedMesh::Arrays are read; empty: all.
  std::vector<bool> Wanted;
  int Step = 0; ///< of arrays that vary in time, only this step is read

  /// Whether it asks for that one of the mesh's arrays.
  bool wants(const PartitionedMesh& mesh, std::size_t attribute) const;
};

/// A piece in memory. Points and cells each come in ascending order of their global ids within the
/// parts of which a piece consists; borrowed cells and the points that only they have come last.
struct Piece
{
  struct Attribute
  {
    StoredArray Description;
    RawBuffer Values;
  };

  int CellSize = 3;
  Scalar PointType = Scalar::Float64;
  bool WideIds = false; ///< connectivity: std::int64_t or std::int32_t
  std::int64_t Points = 0;
  std::int64_t OwnedPoints = 0; ///< those before the points of borrowed cells alone
  std::int64_t Cells = 0;
  std::int64_t OwnedCells = 0;
  RawBuffer Coordinates; ///< 3 a point
  RawBuffer PointIds;    ///< global, std::int64_t
  RawBuffer PointGhosts; ///< std::uint8_t; 1: the point belongs to another piece
  RawBuffer Connectivity;
  RawBuffer CellIds; ///< global, std::int64_t; cells from OwnedCells on are ghosts
  std::vector<Attribute> Attributes;
  ReadCounters Counters;

  /// The point of the piece that is the corner of that number of a cell.
  std::int64_t corner(std::int64_t cell, int number) const
  {
    const auto at = std::size_t(cell * this->CellSize + number);
    return this->WideIds ? this->Connectivity.as<std::int64_t>()[at]
                         : this->Connectivity.as<std::int32_t>()[at];
  }
};

/// Reads a piece: each of its arrays that is wanted in one go. Borrowed cells that are stored by
/// reference are read from their owners' files, which keep them and their points together; the
/// result is the same as of duplicated ones. Throws IOError. Any number of threads may read pieces
/// of one mesh at once.
VTKTIPPIO_EXPORT Piece readPiece(
  const PartitionedMesh& mesh, std::size_t number, const PieceOptions& options = {});

} // namespace tipp

#endif

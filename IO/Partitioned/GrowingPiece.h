// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGrowingPiece_h
#define tippGrowingPiece_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceBorder.h"
#include "Partitioned/PieceWriter.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// @file
/// The file of a piece of triangles or tetrahedra, written in two steps: the interior as soon as
/// the piece's own points are triangulated, and the border once its neighbours are. `number` is the
/// piece's index in the mesh. If a mesh of triangles has no path, no file is written: they are only
/// counted and hashed. All functions throw IOError.

/// Suffix of the file that will replace a piece's file.
constexpr const char* nextPieceSuffix = ".next";

/// A piece whose own points are triangulated. Points are identified by row, except for `First`.
struct InteriorContent
{
  std::int64_t First = 0;       ///< index of the first own point among those of all pieces
  std::int64_t Points = 0;      ///< number of own points
  const double* Rows = nullptr; ///< their rows, see PointRowLayout; not owned
  const std::uint8_t* IsOnInterface = nullptr; ///< by point: not 0 if it is on the interface
  std::vector<TriangleRange> Triangles;        ///< or tetrahedra; all except the border's
  /// Duplicates: maps a point to the one with the same coordinates that represents it.
  const std::unordered_map<std::int32_t, std::int32_t>* Representatives = nullptr;
  bool IsSummed = true; ///< whether to hash triangles for which there is no file
};

/// The first step.
VTKTIPPIO_EXPORT PieceInterior writeInterior(const PartitionedMesh& mesh, std::size_t number,
  const PointRowLayout& layout, const InteriorContent& content);

/// The second step, once all triangles have been added to the border: completes the file, except
/// for the global ids of cells and of their neighbours. May be repeated.
VTKTIPPIO_EXPORT FinishedPiece writeBorder(const PartitionedMesh& mesh, std::size_t number,
  const PointRowLayout& layout, const PieceInterior& interior, const PieceBorder& border);

/// Writes the global ids of a finished piece's cells, consecutive from `first` on, and completes
/// its file and table, except for a NeighborWriter's array. May be repeated.
VTKTIPPIO_EXPORT void writeCellIds(
  const PartitionedMesh& mesh, std::size_t number, std::int64_t first, FinishedPiece& piece);

/// Writes a cell array of a finished piece whose values are only known at the end. `values` has its
/// bytes, in the order of the piece's cells; `attribute` is its index in PartitionedMesh::Arrays.
/// May be repeated.
VTKTIPPIO_EXPORT void writeLateArray(const PartitionedMesh& mesh, std::size_t number,
  std::int64_t attribute, const char* values, FinishedPiece& piece);

/// @name A file that an earlier process has left
/// @{
/// After the first step: verifies the interior's part of the file. Then replaces the file by one of
/// the interior alone, because the earlier process may have written parts of the border, and other
/// parts may be damaged.
VTKTIPPIO_EXPORT void verifyInterior(
  const PartitionedMesh& mesh, std::size_t number, const PieceInterior& interior);
/// After the second step: verifies every byte of the file, except for the global ids of cells and
/// of their neighbours.
VTKTIPPIO_EXPORT void verifyFinished(
  const PartitionedMesh& mesh, std::size_t number, const FinishedPiece& piece);
///@}

} // namespace tipp

#endif

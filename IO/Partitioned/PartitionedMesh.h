// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionedMesh_h
#define tippPartitionedMesh_h

#include "Flat/RawArray.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// x from, x to, y from, y to, z from, z to.
using Bounds = std::array<double, 6>;

/// That a mesh can have.
constexpr std::int64_t mostPieces = 1 << 24;

/// What is known of one piece without opening its file.
struct PieceSummary
{
  Bounds Box{};                   ///< the partition: a closed box
  Bounds Extent{};                ///< of the piece's own points; from > to if there is none
  std::int64_t Points = 0;        ///< without those of borrowed cells alone
  std::int64_t Cells = 0;         ///< owned
  std::int64_t BorrowedCells = 0; ///< by reference, or at the end of the piece
  std::int64_t GhostPoints = 0;   ///< at the end of the piece, of borrowed cells alone
  std::uint64_t FileBytes = 0;    ///< of the piece's .vtu
  std::uint64_t TableOffset = 0;  ///< of its table in tables.bin
  std::uint64_t TableBytes = 0;
  std::uint64_t TableChecksum = 0; ///< XXH3, 64 bits
};

/// An attribute as every piece stores it. An array that varies in time is one of these a step.
struct StoredArray
{
  std::string Name;
  bool OfPoints = true; ///< or of cells
  Scalar Type = Scalar::Float64;
  int Components = 1;
  int Step = -1; ///< the time step, or -1: the same at all times
};

/// A partitioned mesh on disk, as its index describes it; Documentation/PartitionedMesh.md tells
/// the format byte for byte.
///
/// Each cell is owned by one piece, the first whose closed box it meets; the others it meets borrow
/// it. Each point belongs to the first piece whose box holds it, and is a ghost in the others.
struct PartitionedMesh
{
  std::string Path; ///< the folder
  int CellSize = 3; ///< 3: triangles, 4: tetrahedra
  Scalar PointType = Scalar::Float64;
  bool Duplicated = false; ///< borrowed cells are copied to the borrowers' pieces
  std::int64_t Points = 0;
  std::int64_t Cells = 0;
  Bounds Domain{};
  std::string Tiling; ///< as it was asked for: "grid:4x4", "quadtree:100000"
  std::vector<double> Times;
  std::vector<StoredArray> Arrays; ///< those of points first
  std::vector<PieceSummary> Pieces;
  std::uint64_t PvtuBytes = 0; ///< of mesh.pvtu, once it is there
  std::uint64_t PvtuChecksum = 0;

  std::string piecePath(std::size_t piece) const;
  std::string tablesPath() const;
  std::string indexPath() const;
  std::string pvtuPath() const;
};

/// As "pieces/000012.vtu".
VTKTIPPIO_EXPORT std::string pieceName(std::size_t piece);

/// Reads the index of the folder `path`, or the index that `path` is, and checks every count of it
/// and the sizes of all files. Throws IOError naming the file and the fact.
VTKTIPPIO_EXPORT PartitionedMesh openPartitionedMesh(const std::string& path);

/// Throws IOError unless mesh.pvtu, which opening the mesh does not read, has its checksum.
VTKTIPPIO_EXPORT void verifyPvtu(const PartitionedMesh& mesh);

/// Whether the path looks like a partitioned mesh or its index; opening it may still fail.
VTKTIPPIO_EXPORT bool isPartitionedMesh(const std::string& path);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGrowingPiece_h
#define tippGrowingPiece_h

#include "Files/OutputFile.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceLayout.h"
#include "Partitioned/PublishPieces.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <unordered_map>
#include <vector>

namespace tipp
{

/// How points stand in rows of 8-byte words: x, y, further columns, and at last the id.
struct PointRowLayout
{
  std::size_t Words = 3;
  int Z = -1;                  ///< the word that is the third coordinate, or -1: it is 0
  std::vector<int> Attributes; ///< of the mesh's arrays: the word, or -1: the representative's id

  std::int64_t id(const double* row) const
  {
    std::int64_t id = 0;
    std::memcpy(&id, row + this->Words - 1, sizeof(id));
    return id;
  }
};

/// A piece of triangles whose file is written in two goes: nearly all as soon as the piece's own
/// points are triangulated, and the rest, which concerns the border alone, when its neighbours are.
/// In between it keeps the border.
///
/// Without a file, where the mesh has no path, the triangles are counted and summed up only.
///
/// *Rim* points are own points that the border's triangles have; the caller tells which. Points go
/// by places here: the own ones have those from `first` on.
class VTKTIPPIO_EXPORT GrowingPiece
{
public:
  /// What follows the name of a piece's file in that of a file that is to take its place.
  static constexpr const char* NextName = ".next";

  GrowingPiece() = default;
  GrowingPiece(std::int64_t first, std::int64_t points)
    : First(first)
    , OwnPoints(points)
  {
  }

  bool owns(std::int64_t place) const
  {
    return place >= this->First && place < this->First + this->OwnPoints;
  }

  /// @name The border
  ///@{
  /// A triangle that the piece owns and these other pieces borrow, ascending; perhaps none.
  void addTriangle(
    const std::array<std::int64_t, 3>& places, const std::vector<std::int32_t>& borrowers);
  /// Whether a row is missing, that of another piece's point.
  bool needsRow(std::int64_t place) const
  {
    return !this->owns(place) && this->Ghosts.count(place) == 0;
  }
  /// Makes room for the row, and fills it.
  void addRow(std::int64_t place, const PointRowLayout& rows);
  void setRow(std::int64_t place, const double* row, const PointRowLayout& rows);

  struct BorderMesh
  {
    std::vector<double> Rows;
    std::vector<std::int32_t> Corners; ///< three a triangle: which row
  };
  /// The triangles that were added, when all rows are there.
  BorderMesh borderMesh(const PointRowLayout& rows) const;
  ///@}

  struct Corners
  {
    const std::int32_t* Begin; ///< three a triangle, counted from the first own point
    std::size_t Triangles;
  };
  struct Interior
  {
    const double* Rows = nullptr;      ///< of the own points
    const std::uint8_t* Rim = nullptr; ///< of each own point: 1 if it is one of the rim's
    std::vector<Corners> Triangles;    ///< all but the border's
    /// Own points at the place of another: for each, that other; counted from the first.
    const std::unordered_map<std::int32_t, std::int32_t>* Representatives = nullptr;
  };
  /// The first go. Throws IOError.
  void writeInterior(const PartitionedMesh& mesh, std::size_t number, const PointRowLayout& rows,
    const Interior& interior);

  /// Of a triangle by its points' ids, whichever comes first.
  static std::uint64_t hashTriangle(std::int64_t a, std::int64_t b, std::int64_t c);

  /// The row of an own rim point, after the first go.
  const double* rimRow(std::int64_t place, const PointRowLayout& rows) const;

  /// The second go, when no triangle will be added any more. All of the file is there but the
  /// global ids of cells and of their neighbours. May be done again. Throws IOError.
  FinishedPiece writeBorder(
    const PartitionedMesh& mesh, std::size_t number, const PointRowLayout& rows) const;

  /// @name A file that an earlier process has left after the first go
  ///@{
  /// Checks what it holds of the interior; throws IOError.
  void verifyInterior(const PartitionedMesh& mesh, std::size_t number) const;
  /// Replaces it by a file of the interior alone: that process may have written parts of the
  /// border, and what damage there is elsewhere would stay. Throws IOError.
  void isolateInterior(const PartitionedMesh& mesh, std::size_t number) const;
  ///@}

  /// Shows what it keeps of the interior, after the first go, to archive(), which takes numbers and
  /// vectors of them, to save or to restore it.
  template <typename Archive>
  void exchangeInterior(Archive& archive)
  {
    archive(this->Room);
    archive(this->InteriorPoints);
    archive(this->InteriorCells);
    archive(this->InteriorSum);
    archive(this->Extent);
    archive(this->Checksums);
    archive(this->RimPlaces);
    archive(this->RimRows);
    archive(this->RimTriangles);
  }

private:
  struct SharedTriangle
  {
    std::array<std::int64_t, 3> Places;
    std::uint64_t BorrowerEnd; ///< in Borrowers
  };
  struct Border;
  friend struct Border;

  void numberPoints(
    const Interior& interior, const PointRowLayout& rows, std::vector<std::int32_t>& numbers);
  std::int64_t countInterior(const Interior& interior, const std::vector<std::int32_t>& numbers);
  void sumInterior(const Interior& interior, const PointRowLayout& rows);
  std::uint64_t sumBorder(const PointRowLayout& rows) const;
  void makeRoom(const PartitionedMesh& mesh, std::size_t number);
  void writeInteriorArray(const OutputFile& file, const PieceArray& array, std::uint64_t offset,
    const PointRowLayout& rows, const Interior& interior, const std::vector<std::int32_t>& numbers,
    std::vector<std::uint64_t>& checksums) const;
  void copyInterior(const std::string& path, const PieceLayout& from, const PieceLayout& to) const;

  std::int64_t First = 0;
  std::int64_t OwnPoints = 0;

  // Of the interior, after the first go.
  PieceSummary Room;                    ///< counts that the file has room for
  std::int64_t InteriorPoints = 0;      ///< own points but the rim's
  std::uint64_t InteriorSum = 0;        ///< of hashes, without a file: of RimTriangles too
  std::int64_t InteriorCells = 0;       ///< triangles of these alone
  Bounds Extent{};                      ///< of the own points
  std::vector<std::uint64_t> Checksums; ///< of each array's first part
  std::vector<std::int64_t> RimPlaces;  ///< ascending
  std::vector<double> RimRows;
  /// Triangles of the interior at the rim: numbers in the piece, or -1 - k for the k-th rim point.
  std::vector<std::array<std::int32_t, 3>> RimTriangles;

  // Of the border.
  std::vector<SharedTriangle> Shared;
  std::vector<std::int32_t> Borrowers;
  std::vector<std::int64_t> GhostPlaces;
  std::unordered_map<std::int64_t, std::int64_t> Ghosts; ///< of places: which row
  std::vector<double> GhostRows;
};

/// Checks every byte of a finished piece's file, which an earlier process has left, but for global
/// ids of cells and of their neighbours. Throws IOError.
VTKTIPPIO_EXPORT void verifyFinished(
  const PartitionedMesh& mesh, std::size_t number, const FinishedPiece& piece);

/// Writes the global ids of a finished piece's cells, which follow each other from `first` on, and
/// completes its file and table, but for a NeighborWriter's array. May be done again. Throws
/// IOError.
VTKTIPPIO_EXPORT void writeCellIds(
  const PartitionedMesh& mesh, std::size_t number, std::int64_t first, FinishedPiece& piece);

} // namespace tipp

#endif

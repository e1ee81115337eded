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

/// The layout of points in rows of 8-byte words: x, y, further columns, and last the global id.
struct PointRowLayout
{
  std::size_t Words = 3;
  int Z = -1; ///< the word that is the third coordinate; -1: it is 0
  /// the word of each of the mesh's point arrays; -1: the representative's id
  std::vector<int> Attributes;

  std::int64_t id(const double* row) const
  {
    std::int64_t id = 0;
    std::memcpy(&id, row + this->Words - 1, sizeof(id));
    return id;
  }
};

/// A piece of triangles whose file is written in two steps: the interior as soon as the piece's own
/// points are triangulated, and the border once its neighbours are. In between the object keeps the
/// border in memory.
///
/// If the mesh has no path, no file is written: the triangles are only counted and hashed.
///
/// *Rim* points are own points that the border's triangles use; the caller says which. Points are
/// identified by index: the own ones have consecutive indices from `first` on.
class VTKTIPPIO_EXPORT GrowingPiece
{
public:
  /// Suffix of the file that will replace a piece's file.
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
  /// @{
  /// Adds a triangle that the piece owns and the other pieces `borrowers`, ascending, borrow; the
  /// list may be empty.
  void addTriangle(
    const std::array<std::int64_t, 3>& places, const std::vector<std::int32_t>& borrowers);
  /// Whether the row of another piece's point is missing.
  bool needsRow(std::int64_t place) const
  {
    return !this->owns(place) && this->Ghosts.count(place) == 0;
  }
  /// Allocates the row, and fills it.
  void addRow(std::int64_t place, const PointRowLayout& rows);
  void setRow(std::int64_t place, const double* row, const PointRowLayout& rows);

  struct BorderMesh
  {
    std::vector<double> Rows;
    std::vector<std::int32_t> Corners; ///< three row indices per triangle
  };
  /// Returns the triangles that were added; all rows must have been added.
  BorderMesh borderMesh(const PointRowLayout& rows) const;
  ///@}

  struct Corners
  {
    const std::int32_t* Begin; ///< three per triangle: indices from the first own point
    std::size_t Triangles;
  };
  struct Interior
  {
    const double* Rows = nullptr;      ///< of the own points
    const std::uint8_t* Rim = nullptr; ///< per own point: 1 if it is a rim point
    std::vector<Corners> Triangles;    ///< all except the border's
    /// Duplicates: maps an own point to the own point with the same coordinates that represents it;
    /// indices from the first own point.
    const std::unordered_map<std::int32_t, std::int32_t>* Representatives = nullptr;
  };
  /// The first step: writes the interior. Throws IOError.
  void writeInterior(const PartitionedMesh& mesh, std::size_t number, const PointRowLayout& rows,
    const Interior& interior);

  /// Returns a hash of a triangle's point ids that is independent of which corner comes first.
  static std::uint64_t hashTriangle(std::int64_t a, std::int64_t b, std::int64_t c);

  /// Returns the row of an own rim point; only after writeInterior().
  const double* rimRow(std::int64_t place, const PointRowLayout& rows) const;

  /// The second step, once all triangles have been added: completes the file, except for the global
  /// ids of cells and of their neighbours. May be repeated. Throws IOError.
  FinishedPiece writeBorder(
    const PartitionedMesh& mesh, std::size_t number, const PointRowLayout& rows) const;

  /// @name A file that an earlier process has left after the first step
  /// @{
  /// Verifies the interior's part of the file; throws IOError.
  void verifyInterior(const PartitionedMesh& mesh, std::size_t number) const;
  /// Replaces the file by one of the interior alone, because the earlier process may have written
  /// parts of the border, and other parts may be damaged. Throws IOError.
  void isolateInterior(const PartitionedMesh& mesh, std::size_t number) const;
  ///@}

  /// Serialises what the object keeps of the interior, after the first step: archive() saves or
  /// restores numbers and vectors of them.
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
    std::uint64_t BorrowerEnd; ///< end of its range in Borrowers
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

  // Of the interior, after the first step.
  PieceSummary Room;                    ///< counts that the file has room for
  std::int64_t InteriorPoints = 0;      ///< own points without the rim's
  std::uint64_t InteriorSum = 0;        ///< of hashes; without a file, including RimTriangles
  std::int64_t InteriorCells = 0;       ///< triangles of these points alone
  Bounds Extent{};                      ///< of the own points
  std::vector<std::uint64_t> Checksums; ///< of each array's first part
  std::vector<std::int64_t> RimPlaces;  ///< indices of rim points, ascending
  std::vector<double> RimRows;
  /// Interior triangles that use rim points: indices in the piece, or -1 - k for the k-th rim
  /// point.
  std::vector<std::array<std::int32_t, 3>> RimTriangles;

  // Of the border.
  std::vector<SharedTriangle> Shared;
  std::vector<std::int32_t> Borrowers;
  std::vector<std::int64_t> GhostPlaces;
  std::unordered_map<std::int64_t, std::int64_t> Ghosts; ///< row of each point index
  std::vector<double> GhostRows;
};

/// Verifies every byte of a finished piece's file that an earlier process has left, except for the
/// global ids of cells and of their neighbours. Throws IOError.
VTKTIPPIO_EXPORT void verifyFinished(
  const PartitionedMesh& mesh, std::size_t number, const FinishedPiece& piece);

/// Writes the global ids of a finished piece's cells, consecutive from `first` on, and completes
/// its file and table, except for a NeighborWriter's array. May be repeated. Throws IOError.
VTKTIPPIO_EXPORT void writeCellIds(
  const PartitionedMesh& mesh, std::size_t number, std::int64_t first, FinishedPiece& piece);

} // namespace tipp

#endif

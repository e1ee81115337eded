// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFinishedPieces_h
#define tippFinishedPieces_h

#include "Files/PendingOutput.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceFormat.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

class PieceFile;

/// The folders that a new mesh may replace: partitioned meshes.
VTKTIPPIO_EXPORT extern const Replaceable replaceableMesh;

/// A piece whose file is complete, with its summary and table except for what it borrows.
struct FinishedPiece
{
  PieceSummary Summary;          ///< the piece's entry in the index
  PieceTable Table;              ///< without checksums of arrays that are not written yet
  std::uint64_t TriangleSum = 0; ///< without a file: sum of hashTriangle()

  /// The number of parts of its arrays of cells.
  std::size_t cellParts() const { return 1 + this->Table.CellGroups.size(); }
};

template <typename Archive>
void serialize(Archive& archive, FinishedPiece& piece)
{
  PieceTable& table = piece.Table;
  archive(piece.Summary, table.Offsets, table.PointGroups, table.CellGroups, table.Checksums,
    table.HeaderBytes, table.HeaderChecksum, piece.TriangleSum);
}

/// Suffix of the file that will replace a piece's file.
constexpr const char* nextPieceSuffix = ".next";

/// Moves the file with that suffix to this path, if there is one. Throws IOError.
void takeNextFile(const std::string& path);

/// Writes the global ids of a finished piece's cells, consecutive from `first` on, and completes
/// its file and table, except for a NeighborWriter's array. May be repeated. Throws IOError.
VTKTIPPIO_EXPORT void writeCellIds(
  const PartitionedMesh& mesh, std::size_t number, std::int64_t first, FinishedPiece& piece);

/// Writes a cell array of a finished piece whose values are only known at the end. `values` has its
/// bytes, in the order of the piece's cells; `attribute` is its index in PartitionedMesh::Arrays.
/// May be repeated. Throws IOError.
VTKTIPPIO_EXPORT void writeLateArray(const PartitionedMesh& mesh, std::size_t number,
  std::int64_t attribute, const char* values, FinishedPiece& piece);

/// Verifies every byte of the file that an earlier process has left after writeBorder(), except for
/// the global ids of cells and of their neighbours. Throws IOError.
VTKTIPPIO_EXPORT void verifyFinished(
  const PartitionedMesh& mesh, std::size_t number, const FinishedPiece& piece);

/// A cell array of triangles: for each corner the global id of the cell across the opposite edge;
/// -1 if there is none. That of tetrahedra, with facets for edges, has four components.
VTKTIPPIO_EXPORT extern const StoredArray neighborIdsArray;

/// Its index among the mesh's arrays, or -1.
VTKTIPPIO_EXPORT std::int64_t findNeighborIds(const PartitionedMesh& mesh);

/// Writes that array into the files of growing pieces once their cells have global ids: the mesh
/// must list the array, and each file must have room for it.
///
/// Cells of two pieces share only facets of the pieces' borders (of triangles: edges). Such a facet
/// is kept until the other piece is added, and with it the border's values of the array.
class VTKTIPPIO_EXPORT NeighborWriter
{
public:
  /// Cell ids must be consecutive, piece by piece.
  NeighborWriter(const PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces);

  /// Adds a piece. Each piece must be added once, by any thread. If neighbouring pieces are added
  /// soon after each other, few facets are in memory. Throws IOError.
  void add(std::size_t number);
  /// Call once all pieces are added: the facets that are still open are the hull's. Throws IOError.
  void finish();

  /// The memory that add() needs for a piece of the mesh, in bytes.
  static std::uint64_t bytesFor(const PartitionedMesh& mesh, const FinishedPiece& piece);

private:
  /// Global ids of points, ascending; the first of an edge is -1.
  using Facet = std::array<std::int64_t, 3>;
  struct OpenFacet
  {
    Facet Points;
    std::size_t At; ///< index in the border's values
  };
  /// A piece border's values of the array.
  struct Border
  {
    std::int64_t FirstCell = 0;
    std::vector<std::int64_t> Values;
    std::size_t Open = 0; ///< number of open facets

    void set(std::size_t at, std::int64_t cell)
    {
      this->Values[at] = cell;
      --this->Open;
    }
  };
  struct Waiting
  {
    std::size_t Piece;
    std::size_t At;
  };

  std::int64_t cellOf(const Border& border, std::size_t at) const
  {
    return border.FirstCell + std::int64_t(at / this->Corners);
  }
  std::vector<OpenFacet> findOpenFacets(const PieceFile& file,
    const std::vector<std::int32_t>& corners, const std::vector<std::int32_t>& neighbors) const;
  std::vector<std::pair<std::size_t, Border>> match(
    std::size_t number, Border border, const std::vector<OpenFacet>& open);
  void writeBorder(std::size_t number, const Border& border);
  template <typename Next>
  void write(std::size_t number, std::pair<std::size_t, std::size_t> parts, Next next);

  const PartitionedMesh& Mesh;
  const std::size_t Corners; ///< of a cell
  std::vector<FinishedPiece>& Pieces;
  std::vector<std::int64_t> FirstCells; ///< global id of each piece's first cell
  std::mutex Mutex;
  std::map<std::size_t, Border> Borders; ///< borders of the pieces with open facets
  std::map<Facet, Waiting> Facets;
};

/// The result of publishPieces().
struct PublishedMesh
{
  std::uint64_t Bytes = 0;       ///< size of all files
  std::uint64_t Fingerprint = 0; ///< checksum of the index, which identifies the mesh
};

/// Writes tables, .pvtu, .vtkhdf and, last, the index into the mesh's folder, and completes
/// mesh.Pieces. The pieces' files must have been synced. Throws IOError if writing fails or one of
/// them does not have its expected size.
VTKTIPPIO_EXPORT PublishedMesh publishPieces(
  PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces);

/// Whether the folder holds the mesh with this fingerprint, and each of its files has its expected
/// size.
VTKTIPPIO_EXPORT bool holdsMesh(const std::string& path, std::uint64_t fingerprint);

/// Throws IOError unless the folder holds the mesh with this fingerprint and every byte of its
/// files is intact.
VTKTIPPIO_EXPORT void verifyMesh(const std::string& path, std::uint64_t fingerprint, int threads);

} // namespace tipp

#endif

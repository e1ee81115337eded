// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNeighborIds_h
#define tippNeighborIds_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceWriter.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace tipp
{

class PieceFile;

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

} // namespace tipp

#endif

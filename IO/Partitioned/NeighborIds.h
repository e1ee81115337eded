// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNeighborIds_h
#define tippNeighborIds_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PieceWriter.h"
#include "vtkTIPPIOModule.h"

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
/// -1 if there is none.
VTKTIPPIO_EXPORT extern const StoredArray neighborIdsArray;

/// Its index among the mesh's arrays, or -1.
VTKTIPPIO_EXPORT std::int64_t findNeighborIds(const PartitionedMesh& mesh);

/// Writes that array into the files of growing pieces once their cells have global ids: the mesh
/// must list the array, and each file must have room for it.
///
/// Triangles of two pieces meet only at edges of the pieces' borders. Such an edge is kept until
/// the other piece is added, and with it the border's values of the array.
class VTKTIPPIO_EXPORT NeighborWriter
{
public:
  /// Cell ids must be consecutive, piece by piece.
  NeighborWriter(const PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces);

  /// Adds a piece. Each piece must be added once, by any thread. If neighbouring pieces are added
  /// soon after each other, few edges are in memory. Throws IOError.
  void add(std::size_t number);
  /// Call once all pieces are added: the edges that are still open are the hull's. Throws IOError.
  void finish();

  /// The memory that add() needs, in bytes.
  static std::uint64_t bytesFor(const FinishedPiece& piece);

private:
  using Edge = std::pair<std::int64_t, std::int64_t>; ///< global ids of points, the lower first
  struct OpenEdge
  {
    Edge Ends;
    std::size_t At; ///< index in the border's values
  };
  /// A piece border's values of the array.
  struct Border
  {
    std::int64_t FirstCell = 0;
    std::vector<std::int64_t> Values;
    std::size_t Open = 0; ///< number of open edges

    std::int64_t cellOf(std::size_t at) const { return this->FirstCell + std::int64_t(at / 3); }
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

  static std::vector<OpenEdge> findOpenEdges(const PieceFile& file,
    const std::vector<std::int32_t>& corners, const std::vector<std::int32_t>& neighbors);
  std::vector<std::pair<std::size_t, Border>> match(
    std::size_t number, Border border, const std::vector<OpenEdge>& open);
  void writeBorder(std::size_t number, const Border& border);
  template <typename Next>
  void write(std::size_t number, std::size_t begin, std::size_t end, Next next);

  const PartitionedMesh& Mesh;
  std::vector<FinishedPiece>& Pieces;
  std::vector<std::int64_t> FirstCells; ///< global id of each piece's first cell
  std::mutex Mutex;
  std::map<std::size_t, Border> Borders; ///< of pieces with open edges
  std::map<Edge, Waiting> Edges;
};

} // namespace tipp

#endif

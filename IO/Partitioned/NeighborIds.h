// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNeighborIds_h
#define tippNeighborIds_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/PublishPieces.h"
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

/// An array of triangles: for each corner the global id of the cell over the edge opposite to it,
/// or -1 where there is none.
VTKTIPPIO_EXPORT extern const StoredArray neighborIdsArray;

/// Its number among the mesh's arrays, or -1.
VTKTIPPIO_EXPORT std::int64_t findNeighborIds(const PartitionedMesh& mesh);

/// Writes that array into the files of growing pieces, when their cells are numbered: the array is
/// one of the mesh's, and there is room for it in each file.
///
/// Two pieces' triangles meet at edges of their borders only. Such an edge waits for the other
/// piece, and with it what the piece's border holds of the array.
class VTKTIPPIO_EXPORT NeighborWriter
{
public:
  /// The pieces' cells have ids that follow each other, piece by piece.
  NeighborWriter(const PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces);

  /// Each piece once, by any number of threads together. Near ones after each other keep little
  /// waiting. Throws IOError.
  void add(std::size_t number);
  /// When all are added: what has waited in vain is the hull. Throws IOError.
  void finish();

  /// What add() takes.
  static std::uint64_t bytesFor(const FinishedPiece& piece);

private:
  using Edge = std::pair<std::int64_t, std::int64_t>; ///< global ids of points, the lower first
  struct OpenEdge
  {
    Edge Ends;
    std::size_t At; ///< in the border's values
  };
  /// What a piece's border has of the array.
  struct Border
  {
    std::int64_t FirstCell = 0;
    std::vector<std::int64_t> Values;
    std::size_t Open = 0; ///< so many wait

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
  std::vector<std::int64_t> FirstCells; ///< of each piece
  std::mutex Mutex;
  std::map<std::size_t, Border> Borders; ///< of pieces with edges that wait
  std::map<Edge, Waiting> Edges;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceSource_h
#define tippPieceSource_h

#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/MeshTiling.h"
#include "Predicates/Geometry.h"
#include "Ranks/Communicator.h"
#include "Series/MeshSeries.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// Options of openPieceSource().
struct SourceOptions
{
  TilingChoice Tiling; ///< for a flat mesh; a partitioned one has its own
  std::uint64_t MemoryLimit = std::uint64_t(2)
    << 30;                  ///< in bytes, not counting the pieces themselves
  int Threads = 0;          ///< 0: defaultThreads()
  SeriesOptions Model = {}; ///< how the output of a model is read
};

/// A source of pieces: a partitioned mesh on disk, a flat mesh that is partitioned as it is read,
/// or the output of a model, of one piece. The first two give the same pieces, except for the order
/// of points and cells in them.
class PieceSource
{
public:
  PieceSource() = default;
  virtual ~PieceSource();
  PieceSource(const PieceSource&) = delete;
  PieceSource& operator=(const PieceSource&) = delete;

  /// Arrays and times are known after construction, pieces after prepare().
  const PartitionedMesh& mesh() const { return this->Mesh; }

  /// Collective; must precede weights() and read(). Throws IOError.
  virtual void prepare(Communicator& ranks) = 0;
  /// The work that each piece takes, for load balancing.
  virtual std::vector<std::int64_t> weights() const = 0;
  /// Returns the pieces with these indices. Throws IOError.
  virtual std::vector<Piece> read(
    const std::vector<std::size_t>& numbers, const PieceOptions& options) = 0;

protected:
  PartitionedMesh Mesh;
};

/// Opens a partitioned or a flat mesh, or the output of a model; throws IOError. The first two take
/// no options of a model.
std::unique_ptr<PieceSource> openPieceSource(
  const std::string& path, const SourceOptions& options = {});

/// Throws IOError on all ranks unless they have opened the same mesh. Collective.
VTKTIPPIO_EXPORT void requireSameMesh(Communicator& ranks, const PartitionedMesh& mesh);

/// An LRU cache of the pieces of one mesh.
class PieceCache
{
public:
  /// Identifies a cached piece, and what was read of it.
  struct Key
  {
    std::size_t Number;
    bool Borrowed;
    std::vector<bool> Wanted;
    int Step;

    bool operator==(const Key& other) const
    {
      return this->Number == other.Number && this->Borrowed == other.Borrowed &&
        this->Wanted == other.Wanted && this->Step == other.Step;
    }
  };

  /// Null if the piece is not cached.
  std::shared_ptr<const Piece> find(const Key& key)
  {
    const auto piece = std::find_if(this->Pieces.begin(), this->Pieces.end(),
      [&key](const CachedPiece& one) { return one.Identity == key; });
    if (piece == this->Pieces.end())
    {
      return nullptr;
    }
    this->Pieces.splice(this->Pieces.begin(), this->Pieces, piece);
    return piece->Held;
  }
  void keep(const Key& key, std::shared_ptr<const Piece> piece)
  {
    this->Pieces.push_front({ key, std::move(piece) });
  }
  /// Drops the least recently used pieces until `pieces` are left.
  void shrink(std::size_t pieces) { this->Pieces.resize(std::min(pieces, this->Pieces.size())); }
  void clear() { this->Pieces.clear(); }

private:
  struct CachedPiece
  {
    Key Identity;
    std::shared_ptr<const Piece> Held;
  };
  std::list<CachedPiece> Pieces; ///< the most recently used one first
};

/// A cell of one of several pieces, by its index in the piece.
struct CellOfPiece
{
  std::size_t Piece; ///< index among the given pieces
  std::int64_t Cell; ///< index of the cell within the piece
};

/// Builds one piece from cells of several pieces, with each point once, identified by its global
/// id. A point is a ghost only if it is one in all pieces that have it. `allPoints` also keeps the
/// pieces' own points that no cell uses.
Piece gatherCells(const std::vector<const Piece*>& pieces, const std::vector<CellOfPiece>& owned,
  const std::vector<CellOfPiece>& ghosts, bool allPoints);

/// Merges pieces; cells are in the pieces' order. A cell that one of them owns is no ghost.
Piece mergePieces(const std::vector<const Piece*>& pieces);
Piece mergePieces(const std::vector<Piece>& pieces);

/// Throws IOError if a range is probably a mistake: see requireSensible() of Predicates.
void requireSensible(const PartitionedMesh& mesh, const Box3& range);

/// Selects cells that share a point with a closed box, decided exactly; triangles by x and y alone.
class RangeFilter
{
public:
  RangeFilter(const PartitionedMesh& mesh, const Box3& range);

  /// The indices of the pieces whose partition meets the range, ascending.
  const std::vector<std::size_t>& pieces() const { return this->Open; }

  /// Returns the cells of a piece that meet the range, and their points. `piece` must include its
  /// borrowed cells: a cell or point whose owner is not among pieces() is assigned to the lowest of
  /// pieces() that it meets. `borrowed` keeps the other borrowed cells as ghosts.
  Piece apply(const Piece& piece, std::size_t number, bool borrowed) const;

private:
  /// The partition of a piece as a box; in 2D the z range is [0, 0].
  Box3 boxOfPiece(std::size_t number) const
  {
    return boundedBox(this->Mesh.Pieces[number].Box, this->Mesh.CellSize - 1);
  }
  bool meets(const Piece& piece, std::int64_t cell, const Box3& box) const;
  /// For each point a bit mask of the sides of the range that it lies outside of.
  std::vector<std::uint8_t> sidesOfPoints(const Piece& piece) const;
  bool meetsRange(
    const Piece& piece, std::int64_t cell, const std::vector<std::uint8_t>& sides) const;
  bool isLowerPieceMet(const Piece& piece, std::int64_t cell, std::size_t number) const;
  void setPointGhosts(Piece& piece, std::size_t number) const;

  const PartitionedMesh& Mesh;
  Box3 Range;
  std::vector<std::size_t> Open;
};

} // namespace tipp

#endif

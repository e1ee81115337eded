// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceSource_h
#define tippPieceSource_h

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "Partition/BoxTiling.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/MeshTiling.h"
#include "Predicates/Points.h"
#include "Ranks/Communicator.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
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
    << 30;         ///< in bytes, not counting the pieces themselves
  int Threads = 0; ///< 0: OpenMP's default
};

/// A source of pieces: a partitioned mesh on disk, or a flat mesh that is partitioned as it is
/// read. Both give the same pieces, except for the order of points and cells in them.
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

/// Opens a partitioned or a flat mesh; throws IOError.
std::unique_ptr<PieceSource> openPieceSource(
  const std::string& path, const SourceOptions& options = {});

/// The pieces of a flat mesh, made in memory: chunk by chunk, Direct Load loads the coordinates of
/// cells, and the cells are classified; those of the requested pieces are kept.
class FlatPieces : public PieceSource
{
public:
  FlatPieces(FlatMesh mesh, const SourceOptions& options);

  void prepare(Communicator& ranks) override;
  std::vector<std::int64_t> weights() const override { return this->PointCounts; }
  std::vector<Piece> read(
    const std::vector<std::size_t>& numbers, const PieceOptions& options) override;

private:
  /// A piece before its arrays are loaded. Ids are indices in the flat mesh.
  struct Draft
  {
    std::vector<std::int64_t> Cells;   ///< owned cells
    std::vector<std::int64_t> Corners; ///< CellSize point ids for each of these cells
    std::vector<std::int64_t> Borrowed;
    std::vector<std::int64_t> BorrowedCorners;
    std::vector<std::int64_t> OwnPoints; ///< ascending, as all the others
  };

  void collectCells(
    const std::vector<std::int32_t>& draftOf, bool borrowed, std::vector<Draft>& drafts) const;
  template <typename Visit>
  void forEachOwner(std::int64_t first, std::int64_t last, const Visit& visit) const;
  Piece finish(const Draft& draft, const PieceOptions& options) const;
  void loadData(const std::vector<std::int64_t>& ids, bool ofPoints, const PieceOptions& options,
    Piece& piece) const;
  int dimension() const { return this->Flat.CellSize - 1; }
  LoaderOptions loading() const;
  std::int64_t chunkCells() const;

  FlatMesh Flat;
  SourceOptions Options;
  std::vector<RawArray> Arrays; ///< the data of Mesh.Arrays
  std::optional<BoxTiling> Tiling;
  std::vector<std::int64_t> PointCounts; ///< number of points of each piece
};

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
    const auto entry = std::find_if(
      this->Entries.begin(), this->Entries.end(), [&key](const Entry& e) { return e.What == key; });
    if (entry == this->Entries.end())
    {
      return nullptr;
    }
    this->Entries.splice(this->Entries.begin(), this->Entries, entry);
    return entry->Held;
  }
  void keep(const Key& key, std::shared_ptr<const Piece> piece)
  {
    this->Entries.push_front({ key, std::move(piece) });
  }
  /// Drops the least recently used pieces until `pieces` are left.
  void shrink(std::size_t pieces) { this->Entries.resize(std::min(pieces, this->Entries.size())); }
  void clear() { this->Entries.clear(); }

private:
  struct Entry
  {
    Key What;
    std::shared_ptr<const Piece> Held;
  };
  std::list<Entry> Entries; ///< the most recently used one first
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

/// Selects cells that share a point with a closed box, decided exactly; triangles by x and y alone.
class RangeFilter
{
public:
  RangeFilter(const PartitionedMesh& mesh, const Bounds& range);

  /// The indices of the pieces whose partition meets the range, ascending.
  const std::vector<std::size_t>& pieces() const { return this->Open; }

  /// Returns the cells of a piece that meet the range, and their points. `piece` must include its
  /// borrowed cells: a cell or point whose owner is not among pieces() is assigned to the lowest of
  /// pieces() that it meets. `borrowed` keeps the other borrowed cells as ghosts.
  Piece apply(const Piece& piece, std::size_t number, bool borrowed) const;

private:
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

/// Converts a piece's bounds to a box; in 2D the z range is [0, 0].
Box3 boxOf(const PartitionedMesh& mesh, const Bounds& bounds);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatPieces_h
#define tippFlatPieces_h

#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "Partition/BoxTiling.h"
#include "Reading/PieceSource.h"

#include <optional>

namespace tipp
{

/// The pieces of a flat mesh, made in memory: chunk by chunk, Direct Load loads the coordinates of
/// cells, and the cells are classified; those of the requested pieces are kept.
class FlatPieces : public PieceSource
{
public:
  FlatPieces(FlatMesh mesh, const SourceOptions& options);

  void prepare(const Ranks& ranks) override;
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
  void loadPoints(
    const std::vector<std::int64_t>& ids, const PieceOptions& options, Piece& piece) const;
  void loadCellData(const PieceOptions& options, Piece& piece) const;
  int dimension() const { return this->Flat.CellSize - 1; }
  LoaderOptions loading() const;
  std::int64_t chunkCells() const;

  FlatMesh Flat;
  SourceOptions Options;
  std::vector<RawArray> Arrays; ///< the data of Mesh.Arrays
  std::optional<BoxTiling> Tiling;
  std::vector<std::int64_t> PointCounts; ///< of each piece
};

} // namespace tipp

#endif

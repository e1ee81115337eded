// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/PieceSource.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Reading/FlatPieces.h"

namespace tipp
{
namespace
{

class StoredPieces : public PieceSource
{
public:
  explicit StoredPieces(const std::string& path) { this->Mesh = openPartitionedMesh(path); }

  void prepare(const Ranks&) override {}

  std::vector<std::int64_t> weights() const override
  {
    std::vector<std::int64_t> cells;
    cells.reserve(this->Mesh.Pieces.size());
    for (const PieceSummary& piece : this->Mesh.Pieces)
    {
      cells.push_back(piece.Cells + piece.BorrowedCells);
    }
    return cells;
  }

  std::vector<Piece> read(
    const std::vector<std::size_t>& numbers, const PieceOptions& options) override
  {
    std::vector<Piece> pieces;
    pieces.reserve(numbers.size());
    for (const std::size_t number : numbers)
    {
      pieces.push_back(readPiece(this->Mesh, number, options));
    }
    return pieces;
  }
};

} // namespace

PieceSource::~PieceSource() = default;

std::unique_ptr<PieceSource> openPieceSource(const std::string& path, const SourceOptions& options)
{
  if (isPartitionedMesh(path))
  {
    return std::make_unique<StoredPieces>(path);
  }
  if (isFlatMesh(path))
  {
    return std::make_unique<FlatPieces>(openFlatMesh(path), options);
  }
  throw IOError(path,
    "is neither a partitioned mesh (its folder or index) nor a flat one (a folder of .npy arrays, "
    "or a .vtu file of appended, raw, uncompressed data).");
}

} // namespace tipp

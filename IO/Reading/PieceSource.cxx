// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/PieceSource.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Reading/FlatPieces.h"

namespace tipp
{
namespace
{

class StoredPieces : public PieceSource
{
public:
  StoredPieces(const std::string& path, int threads)
    : Threads(threads)
  {
    this->Mesh = openPartitionedMesh(path);
  }

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
    std::vector<Piece> pieces(numbers.size());
    parallelFor(std::int64_t(numbers.size()), this->Threads,
      [&](std::int64_t i)
      {
        poll();
        pieces[std::size_t(i)] = readPiece(this->Mesh, numbers[std::size_t(i)], options);
      });
    return pieces;
  }

private:
  int Threads;
};

} // namespace

PieceSource::~PieceSource() = default;

std::unique_ptr<PieceSource> openPieceSource(const std::string& path, const SourceOptions& options)
{
  if (isPartitionedMesh(path))
  {
    return std::make_unique<StoredPieces>(path, options.Threads);
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

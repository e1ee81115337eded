// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/PieceSource.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Reading/FlatPieces.h"

#include <algorithm>

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

std::vector<std::size_t> runsByWeight(const std::vector<std::int64_t>& weights, int runs)
{
  std::vector<double> sums{ 0 };
  for (const std::int64_t weight : weights)
  {
    // An empty piece weighs a little, so that those are shared, too.
    sums.push_back(sums.back() + double(std::max<std::int64_t>(weight, 0)) + 1);
  }
  std::vector<std::size_t> starts;
  for (int run = 0; run <= runs; ++run)
  {
    const double share = sums.back() * run / runs;
    // The end of a piece that is nearest to the share.
    auto at = std::lower_bound(sums.begin(), sums.end(), share);
    if (at == sums.end() || (at != sums.begin() && share - at[-1] < *at - share))
    {
      --at;
    }
    starts.push_back(std::size_t(at - sums.begin()));
  }
  return starts;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore3D/PieceRun3.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

class PieceFinisher3 : public PieceFinisherOf<PieceWork3, 4>
{
public:
  /// `limit`: bytes of memory for the hull repair.
  PieceFinisher3(const PieceWork3& work, std::uint64_t limit)
    : PieceFinisherOf(work)
  {
    std::vector<Vertex3> hull = this->readHullVertices();
    const std::uint64_t bytes = MemoryPlan3::bytesOf(std::int64_t(hull.size()), 0, 0);
    constexpr std::uint64_t always = std::uint64_t(64) << 20;
    if (bytes > std::max(limit, always))
    {
      throw IOError("There are " + std::to_string(hull.size()) +
        " points at the convex hull, which take " + std::to_string(bytes / 1000000 + 1) +
        " MB; allow more memory.");
    }
    BorderSorter3 sorter(work.Plan);
    repairHull(std::move(hull), work.Plan.artificial(),
      [&](const std::array<Vertex3, 4>& corners)
      { sorter.add(corners, sorter.findMet(corners), this->Late); });
  }

protected:
  FinishedPiece make(PartitionIndex piece) const override
  {
    const PieceInterior interior = this->readInterior(piece);
    PieceBorder border(interior, this->Work.Rows, 4);
    this->forEachBorder(
      piece, [&border](const BorderCells3& cells) { addCells(cells, {}, border); });
    return this->write(piece, interior, border);
  }
};

} // namespace

std::vector<FinishedPiece> finishPieces(const PieceWork3& work, std::uint64_t limit, int threads,
  const Report& report, PieceFigures& figures)
{
  const PieceFinisher3 finisher(work, limit);
  figures = finisher.figures();
  return finisher.finish(threads, report);
}

} // namespace tipp

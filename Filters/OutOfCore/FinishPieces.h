// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFinishPieces_h
#define tippFinishPieces_h

#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PieceResult.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/GrowingPiece.h"
#include "Triangulation/Dimension.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

namespace tipp
{

// Point ids in this header are indices among all spilled points (see SpilledPoints).

/// Adds each border cell to its owner, which is the first piece, in the order of the mesh, that the
/// cell meets. The other pieces that it meets borrow it.
template <typename Plan>
class BorderSorterOf : public FinalCellConsumer<Plan::Dimensions>
{
public:
  static constexpr int D = Plan::Dimensions;

  /// `longest`: in the plane, triangles with a longer edge are left out; 0: all are added. `plan`
  /// and `borders` must outlive this object.
  BorderSorterOf(const Plan& plan, BordersOf<D + 1>& borders, double longest = 0)
    : Pieces(plan)
    , Borders(borders)
    , Longest(longest)
  {
  }

  /// Returns the pieces that the cell meets, as indices in the mesh, ascending. Valid until the
  /// next call. Throws std::runtime_error if there is none.
  const std::vector<std::int32_t>& findMet(const BoundaryCell<D>& cell)
  {
    const std::array<Point<D>, D + 1> corners = positionsOf(cell);
    Box<D> bounds = Box<D>::empty();
    std::for_each(corners.begin(), corners.end(), [&](const Point<D>& p) { bounds.extend(p); });
    this->Met.clear();
    this->Pieces.Pieces.visitNear(bounds,
      [&](PartitionIndex piece)
      {
        if (Dimension<D>::meetsBox(corners, this->Pieces.box(piece)))
        {
          this->Met.push_back(std::int32_t(this->Pieces.number(piece)));
        }
      });
    std::sort(this->Met.begin(), this->Met.end());
    if (this->Met.empty())
    {
      throw std::runtime_error("Points are outside of the bounds that the first pass found: the "
                               "input has changed; start again.");
    }
    return this->Met;
  }

  /// Adds the cell. `met`: the result of findMet().
  void add(const BoundaryCell<D>& cell, const std::vector<std::int32_t>& met)
  {
    this->Borders[PartitionIndex(this->Pieces.number(met.front()))].add(idsOf(cell), met);
  }
  void add(const BoundaryCell<D>& cell) override
  {
    if constexpr (D == 2)
    {
      const auto [a, b, c] = positionsOf(cell);
      if (this->Longest > 0 && hasLongEdge(a, b, c, this->Longest))
      {
        return;
      }
    }
    this->add(cell, this->findMet(cell));
  }

private:
  const Plan& Pieces;
  BordersOf<D + 1>& Borders;
  const double Longest;
  std::vector<std::int32_t> Met;
};

using BorderSorter = BorderSorterOf<PiecePlan>;
using BorderSorter3 = BorderSorterOf<PiecePlan3>;

/// Appends the triangles of `from` to those of `to`.
void append(BordersByOwner&& from, BordersByOwner& to);

/// Returns the result of a piece that is done.
using ResultOf = std::function<const StoredResult&(PartitionIndex)>;

/// Calls visit(point, row) for points at borders, which are interface points of their pieces.
/// `points` must be ascending. results(piece) returns the result of a piece. Throws IOError.
template <typename Work, typename Results, typename Visit>
void visitBorderRows(const Work& work, const std::vector<std::int64_t>& points,
  const Results& results, const Visit& visit)
{
  PartitionIndex piece = -1;
  PieceInterior owner;
  for (const std::int64_t point : points)
  {
    const PartitionIndex of = work.Points.pieceOf(point);
    if (of != piece)
    {
      piece = of;
      owner = results(piece).readInterior(work.Points, piece, false);
    }
    visit(point, owner.interfaceRow(point, work.Rows));
  }
}

/// Sets the rows of the points that a border's cells use and that other pieces own. Throws IOError.
template <typename Work, typename Results>
void setGhosts(const Work& work, const Results& results, PieceBorder& border)
{
  std::vector<std::int64_t> ghosts = border.ghosts();
  std::sort(ghosts.begin(), ghosts.end());
  visitBorderRows(work, ghosts, results,
    [&](std::int64_t point, const double* row) { border.setGhost(point, row); });
}

/// Completes the files of all pieces once all results exist: adds the borders to the interiors.
/// `CornerCount`: of a cell.
template <typename WorkType, std::size_t CornerCount>
class PieceFinisherOf
{
public:
  using Result = typename WorkType::Result;

  /// Sets `figures` to the sum of all pieces' figures. `work` must outlive this object. Throws
  /// IOError.
  PieceFinisherOf(const WorkType& work, PieceFigures& figures)
    : Work(work)
  {
    figures = PieceFigures();
    for (PartitionIndex piece = 0; piece < work.Plan.pieces(); ++piece)
    {
      this->Results.push_back(std::make_unique<Result>(work.resultPath(piece)));
      figures.add(this->Results.back()->readFigures());
    }
  }
  virtual ~PieceFinisherOf() = default;

  /// Completes the pieces' files, unless an earlier process did so. Then only the global ids of
  /// cells and of their neighbours are missing. Returns the pieces in the order of the mesh.
  /// `report` throws to stop the run. Throws IOError.
  std::vector<FinishedPiece> finish(int threads, const Report& report) const
  {
    std::vector<FinishedPiece> finished(this->Results.size());
    forChunks(std::int64_t(finished.size()), 1, threads, report,
      [&](std::int64_t at, std::int64_t, int)
      {
        const auto piece = static_cast<PartitionIndex>(at);
        finished[this->Work.Plan.number(piece)] =
          finishOnce(this->Work.finishedPath(piece), [&] { return this->make(piece); });
      });
    return finished;
  }

protected:
  virtual FinishedPiece make(PartitionIndex piece) const = 0;

  /// Visits the cells that a piece owns at its border, from all results, and those made after all
  /// pieces were done.
  template <typename Visit>
  void forEachBorder(PartitionIndex piece, const Visit& visit) const
  {
    for (const auto& result : this->Results)
    {
      if (result->hasBorder(piece))
      {
        visit(result->readBorder(piece));
      }
    }
    const auto late = this->Late.find(piece);
    if (late != this->Late.end())
    {
      visit(late->second);
    }
  }

  /// Adds cells to a border. `isKept`: by cell; empty: all are added.
  static void addCells(
    const BorderCells<CornerCount>& cells, const std::vector<char>& isKept, PieceBorder& border)
  {
    auto begin = cells.Borrowers.begin();
    for (std::size_t i = 0; i < cells.Corners.size(); ++i)
    {
      const auto end = cells.Borrowers.begin() + std::ptrdiff_t(cells.BorrowerEnds.at(i));
      if (isKept.empty() || isKept[i])
      {
        border.addCell(cells.Corners[i].data(), { begin, end });
      }
      begin = end;
    }
  }

  /// Writes the border of a piece.
  FinishedPiece write(
    PartitionIndex piece, const PieceInterior& interior, PieceBorder& border) const
  {
    setGhosts(this->Work, this->results(), border);
    return writeBorder(
      this->Work.Mesh, this->Work.Plan.number(piece), this->Work.Rows, interior, border);
  }

  PieceInterior readInterior(PartitionIndex piece) const
  {
    return this->Results[std::size_t(piece)]->readInterior(this->Work.Points, piece, true);
  }

  /// Returns the true corners of all cells with artificial corners.
  auto readHullVertices() const
  {
    std::vector<typename Result::Content::Vertex> vertices;
    for (const auto& result : this->Results)
    {
      const auto more = result->readHullVertices();
      vertices.insert(vertices.end(), more.begin(), more.end());
    }
    return vertices;
  }

  auto results() const
  {
    return
      [this](PartitionIndex piece) -> const Result& { return *this->Results[std::size_t(piece)]; };
  }

  const WorkType& Work;
  std::vector<std::unique_ptr<Result>> Results; ///< of each piece
  BordersOf<CornerCount> Late;                  ///< cells made after all pieces were done
};

/// Passes to the consumer the triangles between pieces that became final with the last partitions
/// of `piece`, unless this or an earlier process did so. All pieces that conflict with it must be
/// done, because their points may be corners. Throws IOError.
void takeBorder(const PieceWork& work, PartitionIndex piece, const ResultOf& results);

/// Finds the pieces whose borders can be passed to the consumer. Pieces may become done in any
/// order.
class BorderQueue
{
public:
  /// `order`: of all partitions; pieces with conflicting partitions are neighbours.
  BorderQueue(const PiecePlan& plan, const PartitionOrder& order);

  /// Call this once for each piece that becomes done. Returns the pieces whose neighbours are now
  /// all done: takeBorder() can be called for them.
  std::vector<PartitionIndex> setDone(PartitionIndex piece);

private:
  std::vector<std::vector<PartitionIndex>> Neighbours; ///< by piece: neighbours, and itself
  std::vector<std::size_t> Open; ///< by piece: the number of its Neighbours that are not done
};

/// Completes the files of all pieces once all results exist: repairs the hull (Lemma 3), and adds
/// the borders to the interiors. Then only the global ids of cells and of their neighbours are
/// missing. Returns the pieces in the order of the mesh. `report` throws to stop the run. Throws
/// IOError.
std::vector<FinishedPiece> finishPieces(
  const PieceWork& work, int threads, const Report& report, PieceFigures& figures);
/// The same for pieces of tetrahedra. `limit`: bytes of memory for the hull repair.
VTKTIPPFILTERS_EXPORT std::vector<FinishedPiece> finishPieces(const PieceWork3& work,
  std::uint64_t limit, int threads, const Report& report, PieceFigures& figures);

/// Writes the global ids of all cells, and sets mesh.Cells to their number. Throws IOError.
void numberCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, const Report& report);

/// Writes the cell array that marks edges of constraints; call it after numberCells(). `array`: its
/// index among the mesh's arrays. `constraints`: null if there are none. Throws IOError.
void markCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::int64_t array,
  const SpilledSegments* constraints, int threads, const Report& report);

/// Writes the cell array NeighborIds; call it after numberCells(). Uses as many of the threads as
/// `memory` bytes allow. Throws IOError.
void linkCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::uint64_t memory,
  int threads, const Report& report);

} // namespace tipp

#endif

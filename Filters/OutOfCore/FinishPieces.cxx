// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/FinishPieces.h"

#include "Arrays/SortUnique.h"
#include "Files/IOError.h"
#include "OutOfCore/ScratchFiles.h"
#include "OutOfCore/StoredPieces.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioned/NeighborIds.h"
#include "Partitioned/PieceFile.h"
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace tipp
{
namespace
{

/// Reads the segments near the triangles, by the bounding box of each `together` consecutive
/// triangles. `corners` are indices into `points`.
ConstraintSegments readNear(const PieceSegments& segments, PointsView points,
  const std::int32_t* corners, std::size_t triangles, std::size_t together)
{
  std::vector<Box2> boxes;
  for (std::size_t c = 0; c < 3 * triangles; ++c)
  {
    const Point2 p = points[std::size_t(corners[c])];
    const Box2 box{ p.x, p.y, p.x, p.y };
    c % (3 * together) == 0 ? boxes.push_back(box)
                            : void(boxes.back() = unionOf(boxes.back(), box));
  }
  return segments.readNear(boxes);
}

class PieceFinisher
{
public:
  PieceFinisher(const PieceWork& work, int threads)
    : Work(work)
  {
    for (PartitionIndex piece = 0; piece < work.Plan.pieces(); ++piece)
    {
      this->Results.push_back(std::make_unique<StoredResult>(work.resultPath(piece)));
      this->Figures.add(this->Results.back()->readFigures());
    }
    this->repairHull();
    if (work.Constraints)
    {
      this->constrain(threads);
    }
    if (work.takesBordersEarly())
    {
      takeTriangles(work, "hull", this->Late, this->results());
    }
  }

  const PieceFigures& figures() const { return this->Figures; }

  FinishedPiece finish(PartitionIndex piece) const
  {
    return finishOnce(this->Work.finishedPath(piece), [&] { return this->make(piece); });
  }

private:
  FinishedPiece make(PartitionIndex piece) const
  {
    const std::size_t number = this->Work.Plan.number(piece);
    const PieceInterior interior = this->interiorOf(piece);
    PieceBorder border(interior, this->Work.Rows);
    this->forEachBorder(
      piece, [&](const BorderTriangles& triangles) { this->addTriangles(triangles, border); });
    FinishedPiece finished;
    if (this->Work.Consumer)
    {
      finished.Summary = this->Work.Mesh.Pieces[number];
      finished.Summary.Cells =
        interior.Cells + std::int64_t(interior.InterfaceCells.size() + border.cells());
      this->take(piece, border);
    }
    else
    {
      setGhosts(this->Work, this->results(), border);
      finished = writeBorder(this->Work.Mesh, number, this->Work.Rows, interior, border);
    }
    return finished;
  }

  /// Passes the border of a piece to the consumer, unless that was done earlier. `border`: the
  /// triangles that the piece owns.
  void take(PartitionIndex piece, PieceBorder& border) const
  {
    if (!this->Work.takesBordersEarly())
    {
      takeBorder(this->Work, piece, border, this->results());
    }
    else if (!isBorderTaken(this->Work, piece))
    {
      takeBorder(this->Work, piece, this->results());
    }
  }

  PieceInterior interiorOf(PartitionIndex piece) const
  {
    return readInterior(this->Work, piece, *this->Results[std::size_t(piece)]);
  }

  /// Makes the triangles that replace those at artificial points. They also belong to borders.
  void repairHull()
  {
    std::vector<BoundaryVertex> vertices;
    for (const auto& result : this->Results)
    {
      const std::vector<BoundaryVertex> more = result->readHullVertices();
      vertices.insert(vertices.end(), more.begin(), more.end());
    }
    BorderSorter sorter(this->Work, this->Late);
    tipp::repairHull(std::move(vertices), this->Work.Plan.Artificial, sorter);
  }

  /// Inserts the constraints that no piece's interior contains completely: retriangulates all
  /// triangles that they cross, in interiors and borders, together.
  void constrain(int threads)
  {
    const PartitionIndex pieces = this->Work.Plan.pieces();
    std::vector<CrossedPart> ofBorders(static_cast<std::size_t>(pieces));
    forChunks(pieces, 1, threads, {},
      [&](std::int64_t piece, std::int64_t, int)
      { ofBorders[std::size_t(piece)] = this->takeCrossedBorder(PartitionIndex(piece)); });
    CrossedPart all;
    for (PartitionIndex piece = 0; piece < pieces; ++piece)
    {
      const CrossedPart& border = ofBorders[std::size_t(piece)];
      this->Replaced.insert(this->Replaced.end(), border.Triangles.begin(), border.Triangles.end());
      append(std::move(ofBorders[std::size_t(piece)]), all);
      append(this->Results[std::size_t(piece)]->readCrossed(), all);
    }
    std::sort(this->Replaced.begin(), this->Replaced.end());
    retriangulate(all, threads);
    BorderSorter sorter(this->Work, this->Late);
    for (std::size_t t = 0; t < all.Triangles.size(); ++t)
    {
      BoundaryTriangle triangle;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const Point2 p = all.Positions[t][i];
        triangle[i] = { { p.x * this->Work.Factor, p.y * this->Work.Factor }, all.Triangles[t][i],
          -1 };
      }
      sorter.add(triangle);
    }
  }

  /// Returns the triangles that the piece owns at its border and that constraints cross.
  CrossedPart takeCrossedBorder(PartitionIndex piece) const
  {
    std::vector<CrossedPart::Corners> triangles;
    this->forEachBorder(piece,
      [&](const BorderTriangles& border)
      { triangles.insert(triangles.end(), border.Corners.begin(), border.Corners.end()); });
    const std::vector<std::int64_t> points = pointsOf(triangles);
    const std::vector<Point2> positions = this->positionsOf(points);
    std::vector<std::int32_t> corners;
    for (const CrossedPart::Corners& triangle : triangles)
    {
      for (const std::int64_t point : triangle)
      {
        corners.push_back(
          std::int32_t(std::lower_bound(points.begin(), points.end(), point) - points.begin()));
      }
    }
    CrossedPart part;
    takeCrossed(PointsView(positions),
      readNear(*this->Work.Constraints, PointsView(positions), corners.data(), triangles.size(), 1),
      0, corners.data(), triangles.size(), part);
    part.rename([&points](std::int64_t index) { return points[std::size_t(index)]; });
    return part;
  }

  /// Returns for each triangle of a border whether it is kept although there are constraints.
  std::vector<char> findKept(const BorderTriangles& triangles) const
  {
    std::vector<char> isKept;
    isKept.reserve(triangles.Corners.size());
    const ConstraintSegments& cutting = this->Work.Constraints->cutting();
    const bool filters = cutting.cuts() || this->Work.MaximumEdge > 0;
    const std::vector<std::int64_t> points =
      filters ? pointsOf(triangles.Corners) : std::vector<std::int64_t>();
    const std::vector<Point2> positions = this->positionsOf(points);
    for (const CrossedPart::Corners& triangle : triangles.Corners)
    {
      bool keeps = !std::binary_search(this->Replaced.begin(), this->Replaced.end(), triangle);
      if (keeps && filters)
      {
        std::array<Point2, 3> p;
        std::transform(triangle.begin(), triangle.end(), p.begin(),
          [&](std::int64_t point)
          {
            return positions[std::size_t(
              std::lower_bound(points.begin(), points.end(), point) - points.begin())];
          });
        keeps = cutting.keeps(p) &&
          !(this->Work.MaximumEdge > 0 && hasLongEdge(p[0], p[1], p[2], this->Work.MaximumEdge));
      }
      isKept.push_back(char(keeps));
    }
    return isKept;
  }

  /// Returns the corners of the triangles, each once, ascending.
  static std::vector<std::int64_t> pointsOf(const std::vector<CrossedPart::Corners>& triangles)
  {
    std::vector<std::int64_t> points;
    for (const CrossedPart::Corners& triangle : triangles)
    {
      points.insert(points.end(), triangle.begin(), triangle.end());
    }
    sortUnique(points);
    return points;
  }

  /// Visits the triangles that a piece owns at its border, from all results, and those made after
  /// all pieces were done.
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

  void addTriangles(const BorderTriangles& triangles, PieceBorder& border) const
  {
    const std::vector<char> isKept =
      this->Work.Constraints ? this->findKept(triangles) : std::vector<char>();
    auto begin = triangles.Borrowers.begin();
    for (std::size_t i = 0; i < triangles.Corners.size(); ++i)
    {
      const auto end = triangles.Borrowers.begin() + std::ptrdiff_t(triangles.BorrowerEnds.at(i));
      if (isKept.empty() || isKept[i])
      {
        border.addTriangle(triangles.Corners[i], { begin, end });
      }
      begin = end;
    }
  }

  ResultOf results() const
  {
    return [this](PartitionIndex piece) -> const StoredResult&
    { return *this->Results[std::size_t(piece)]; };
  }

  std::vector<Point2> positionsOf(const std::vector<std::int64_t>& points) const
  {
    std::vector<Point2> positions;
    positions.reserve(points.size());
    visitBorderRows(this->Work, points, this->results(),
      [&](std::int64_t, const double* row) {
        positions.push_back({ row[0], row[1] });
      });
    return positions;
  }

  const PieceWork& Work;
  std::vector<std::unique_ptr<StoredResult>> Results; ///< of each piece
  PieceFigures Figures;
  BordersByOwner Late;                        ///< triangles made after all pieces were done
  std::vector<CrossedPart::Corners> Replaced; ///< triangles that constraints cross; sorted
};

} // namespace

std::vector<char> verifyResults(const PieceWork& work, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn)
{
  return verifyPieces(
    work.Mesh, storedPieces(work),
    [&](PartitionIndex piece)
    { return readInterior(work, piece, StoredResult(work.resultPath(piece))); },
    threads, report, warn);
}

std::vector<FinishedPiece> finishPieces(
  const PieceWork& work, int threads, const Report& report, PieceFigures& figures)
{
  const PieceFinisher finisher(work, threads);
  figures = finisher.figures();
  std::vector<FinishedPiece> finished(std::size_t(work.Plan.pieces()));
  const bool isDone = forChunks(work.Plan.pieces(), 1, threads, report,
    [&](std::int64_t at, std::int64_t, int)
    {
      const auto piece = static_cast<PartitionIndex>(at);
      finished[work.Plan.number(piece)] = finisher.finish(piece);
    });
  return isDone ? std::move(finished) : std::vector<FinishedPiece>();
}

void numberCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, const Report& report)
{
  for (std::size_t number = 0; number < pieces.size(); ++number)
  {
    writeCellIds(mesh, number, mesh.Cells, pieces[number]);
    mesh.Cells += pieces[number].Summary.Cells;
    report(double(number) / double(pieces.size()));
  }
}

void markCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::int64_t array,
  const PieceSegments* constraints, int threads, const Report& report)
{
  forChunks(std::int64_t(pieces.size()), 1, threads, report,
    [&](std::int64_t at, std::int64_t, int)
    {
      const auto number = std::size_t(at);
      FinishedPiece& piece = pieces[number];
      const PieceFile file(mesh, number, piece.Summary, piece.Table);
      const auto read = [&file](PieceRole role, void* to)
      {
        const std::size_t a = file.find(role);
        const std::vector<std::int64_t>& parts = file.partStarts(file.arrays()[a].ofPoints());
        file.read(a, 0, parts.size() - 1, to);
      };
      std::vector<double> xyz(3 * std::size_t(piece.Summary.Points));
      std::vector<std::int32_t> corners(3 * std::size_t(piece.Summary.Cells));
      read(PieceRole::Points, xyz.data());
      read(PieceRole::Connectivity, corners.data());
      std::vector<std::uint8_t> marks(corners.size(), 0);
      if (constraints && !corners.empty())
      {
        const PointsView points(xyz.data(), xyz.size() / 3, 3);
        constexpr std::size_t together = 64;
        markEdges(points,
          readNear(*constraints, points, corners.data(), corners.size() / 3, together),
          corners.data(), corners.size() / 3, marks.data());
      }
      writeLateArray(mesh, number, array, reinterpret_cast<const char*>(marks.data()), piece);
    });
}

void linkCells(PartitionedMesh& mesh, std::vector<FinishedPiece>& pieces, std::uint64_t memory,
  int threads, const Report& report)
{
  std::uint64_t most = 1;
  for (const FinishedPiece& piece : pieces)
  {
    most = std::max(most, NeighborWriter::bytesFor(mesh, piece));
  }
  NeighborWriter neighbors(mesh, pieces);
  forChunks(std::int64_t(pieces.size()), 1,
    int(std::clamp<std::uint64_t>(memory / most, 1, std::uint64_t(threads))), report,
    [&](std::int64_t number, std::int64_t, int) { neighbors.add(std::size_t(number)); });
  neighbors.finish();
}

} // namespace tipp

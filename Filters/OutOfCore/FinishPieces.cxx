// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/FinishPieces.h"

#include "Files/OutputFile.h"
#include "Parallel/Sort.h"
#include "Partitioned/FinishedPieces.h"
#include "Partitioned/PieceFile.h"

#include <utility>

namespace tipp
{
namespace
{

/// Returns the path of an empty file that exists once the consumer has the piece's border.
std::string takenPath(const PieceWork& work, PartitionIndex piece)
{
  return work.resultPath(piece) + ".taken";
}

void takeMesh(
  const PieceWork& work, const std::string& name, PieceBorder& border, const ResultOf& results)
{
  setGhosts(work, results, border);
  const PieceBorder::Mesh mesh = border.mesh();
  work.Consumer->take(
    name, mesh.Rows.data(), work.Rows, mesh.Rows.size() / work.Rows.Words, { mesh.triangles() });
}

std::string borderName(const PieceWork& work, PartitionIndex piece)
{
  return std::to_string(work.Plan.number(piece)) + ".border";
}

/// Passes triangles at the borders of any pieces to the consumer; `name` identifies this part (see
/// TriangleConsumer::take()).
void takeTriangles(const PieceWork& work, const std::string& name, const BordersByOwner& triangles,
  const ResultOf& results)
{
  const PieceInterior none;
  PieceBorder border(none, work.Rows);
  for (const auto& [owner, cells] : triangles)
  {
    for (const std::array<std::int64_t, 3>& corners : cells.Corners)
    {
      border.addCell(corners.data(), {});
    }
  }
  takeMesh(work, name, border, results);
}

} // namespace

void append(BordersByOwner&& from, BordersByOwner& to)
{
  for (auto& [owner, added] : from)
  {
    BorderTriangles& border = to[owner];
    const std::uint64_t before = border.Borrowers.size();
    border.Corners.insert(border.Corners.end(), added.Corners.begin(), added.Corners.end());
    border.Borrowers.insert(border.Borrowers.end(), added.Borrowers.begin(), added.Borrowers.end());
    for (const std::uint64_t end : added.BorrowerEnds)
    {
      border.BorrowerEnds.push_back(before + end);
    }
  }
}

void takeBorder(const PieceWork& work, PartitionIndex piece, const ResultOf& results)
{
  if (pathExists(takenPath(work, piece)))
  {
    return;
  }
  BordersByOwner borders;
  for (PartitionIndex owner = 0; owner < work.Plan.pieces(); ++owner)
  {
    if (results(piece).hasBorder(owner))
    {
      borders.emplace(owner, results(piece).readBorder(owner));
    }
  }
  takeTriangles(work, borderName(work, piece), borders, results);
  OutputFile(takenPath(work, piece)).close();
}

BorderQueue::BorderQueue(const PiecePlan& plan, const PartitionOrder& order)
  : Neighbours(std::size_t(plan.pieces()))
  , Open(std::size_t(plan.pieces()))
{
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    std::vector<PartitionIndex>& neighbours = this->Neighbours[std::size_t(piece)];
    neighbours.push_back(piece);
    const PartitionIndex end = plan.FirstPartition[std::size_t(piece) + 1];
    for (PartitionIndex p = plan.FirstPartition[std::size_t(piece)]; p < end; ++p)
    {
      if (order.isTotal())
      {
        continue; // finishPieces() passes their borders on
      }
      for (const PartitionIndex q : order.conflicts().neighbours(p))
      {
        neighbours.push_back(plan.PieceOf[std::size_t(q)]);
      }
    }
    sortUnique(neighbours);
    this->Open[std::size_t(piece)] = neighbours.size() + (order.isTotal() ? 1 : 0);
  }
}

std::vector<PartitionIndex> BorderQueue::setDone(PartitionIndex piece)
{
  std::vector<PartitionIndex> ready;
  for (const PartitionIndex other : this->Neighbours[std::size_t(piece)])
  {
    if (--this->Open[std::size_t(other)] == 0)
    {
      ready.push_back(other);
    }
  }
  return ready;
}

namespace
{

/// Reads the segments near the triangles, by the bounding box of each `together` consecutive
/// triangles. `corners` are indices into `points`.
ConstraintSegments readNear(const SpilledSegments& segments, PointsView points,
  const std::int32_t* corners, std::size_t triangles, std::size_t together)
{
  std::vector<Box2> boxes;
  for (std::size_t c = 0; c < 3 * triangles; ++c)
  {
    const Point2 p = points[std::size_t(corners[c])];
    if (c % (3 * together) == 0)
    {
      boxes.push_back(Box2::empty());
    }
    boxes.back().extend(p);
  }
  return segments.readNear(boxes);
}

class PieceFinisher : public PieceFinisherOf<PieceWork, 3>
{
public:
  PieceFinisher(const PieceWork& work, int threads, PieceFigures& figures)
    : PieceFinisherOf(work, figures)
  {
    BorderSorter sorter(work.Plan, this->Late, work.longestAtBorder());
    repairHull(this->readHullVertices(), work.Plan.Artificial, sorter);
    if (work.Constraints)
    {
      this->constrain(threads, sorter);
    }
    if (work.takesBordersEarly())
    {
      takeTriangles(work, "hull", this->Late, this->results());
    }
  }

protected:
  FinishedPiece make(PartitionIndex piece) const override
  {
    const PieceInterior interior = this->readInterior(piece);
    PieceBorder border(interior, this->Work.Rows);
    this->forEachBorder(piece,
      [&](const BorderTriangles& triangles)
      {
        this->addCells(triangles,
          this->Work.Constraints ? this->findKept(triangles) : std::vector<char>(), border);
      });
    if (!this->Work.Consumer)
    {
      return this->write(piece, interior, border);
    }
    FinishedPiece finished;
    finished.Summary = this->Work.Mesh.Pieces[this->Work.Plan.number(piece)];
    finished.Summary.Cells =
      interior.Cells + std::int64_t(interior.InterfaceCells.size() + border.cells());
    if (this->Work.takesBordersEarly())
    {
      takeBorder(this->Work, piece, this->results());
    }
    else
    {
      takeMesh(this->Work, borderName(this->Work, piece), border, this->results());
    }
    return finished;
  }

private:
  /// Inserts the constraints that no piece's interior contains completely: retriangulates all
  /// triangles that they cross, in interiors and borders, together.
  void constrain(int threads, BorderSorter& sorter)
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

  /// The points at the corners of triangles, each once.
  struct CornerPoints
  {
    std::vector<std::int64_t> Points; ///< ascending
    std::vector<Point2> Positions;    ///< of these points

    /// Returns the index of a point, which must be among them.
    std::size_t find(std::int64_t point) const
    {
      return std::size_t(
        std::lower_bound(this->Points.begin(), this->Points.end(), point) - this->Points.begin());
    }
  };

  /// Reads the positions of the triangles' corners from the results.
  CornerPoints cornersOf(const std::vector<CrossedPart::Corners>& triangles) const
  {
    CornerPoints corners;
    for (const CrossedPart::Corners& triangle : triangles)
    {
      corners.Points.insert(corners.Points.end(), triangle.begin(), triangle.end());
    }
    sortUnique(corners.Points);
    corners.Positions.reserve(corners.Points.size());
    visitBorderRows(this->Work, corners.Points, this->results(),
      [&](std::int64_t, const double* row) {
        corners.Positions.push_back({ row[0], row[1] });
      });
    return corners;
  }

  /// Returns the triangles that the piece owns at its border and that constraints cross.
  CrossedPart takeCrossedBorder(PartitionIndex piece) const
  {
    std::vector<CrossedPart::Corners> triangles;
    this->forEachBorder(piece,
      [&](const BorderTriangles& border)
      { triangles.insert(triangles.end(), border.Corners.begin(), border.Corners.end()); });
    const CornerPoints corners = this->cornersOf(triangles);
    std::vector<std::int32_t> indices;
    for (const CrossedPart::Corners& triangle : triangles)
    {
      for (const std::int64_t point : triangle)
      {
        indices.push_back(std::int32_t(corners.find(point)));
      }
    }
    CrossedPart part;
    const PointsView positions(corners.Positions);
    takeCrossed(positions,
      readNear(*this->Work.Constraints, positions, indices.data(), triangles.size(), 1), 0,
      indices.data(), triangles.size(), part);
    part.rename([&corners](std::int64_t index) { return corners.Points[std::size_t(index)]; });
    return part;
  }

  /// Returns for each triangle of a border whether it is kept although there are constraints.
  std::vector<char> findKept(const BorderTriangles& triangles) const
  {
    std::vector<char> isKept;
    isKept.reserve(triangles.Corners.size());
    const ConstraintSegments& cutting = this->Work.Constraints->cutting();
    const bool filters = cutting.cuts() || this->Work.MaximumEdge > 0;
    const CornerPoints corners = filters ? this->cornersOf(triangles.Corners) : CornerPoints();
    for (const CrossedPart::Corners& triangle : triangles.Corners)
    {
      bool keeps = !std::binary_search(this->Replaced.begin(), this->Replaced.end(), triangle);
      if (keeps && filters)
      {
        std::array<Point2, 3> p;
        std::transform(triangle.begin(), triangle.end(), p.begin(),
          [&](std::int64_t point) { return corners.Positions[corners.find(point)]; });
        keeps = cutting.keeps(p) &&
          !(this->Work.MaximumEdge > 0 && hasLongEdge(p[0], p[1], p[2], this->Work.MaximumEdge));
      }
      isKept.push_back(char(keeps));
    }
    return isKept;
  }

  std::vector<CrossedPart::Corners> Replaced; ///< triangles that constraints cross; sorted
};

} // namespace

std::vector<FinishedPiece> finishPieces(
  const PieceWork& work, int threads, const Report& report, PieceFigures& figures)
{
  return PieceFinisher(work, threads, figures).finish(threads, report);
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
  const SpilledSegments* constraints, int threads, const Report& report)
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

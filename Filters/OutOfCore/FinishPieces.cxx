// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/FinishPieces.h"

#include "Files/IOError.h"
#include "OutOfCore/Checkpoint.h"
#include "OutOfCore/PieceBorders.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <mutex>
#include <utility>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

bool exists(const std::string& path)
{
  std::error_code ignored;
  return fs::exists(path, ignored);
}

FinishedPiece readFinished(const std::string& path)
{
  const Bytes bytes = readCheckpoint(path);
  LoadArchive archive(bytes);
  FinishedPiece piece;
  exchange(archive, piece);
  return piece;
}

GrowingPiece emptyPiece(const PieceWork& work, PartitionIndex piece)
{
  return { work.Points.starts()[std::size_t(piece)], work.Points.count(piece) };
}

/// Throws IOError for what is damaged or missing.
void verifyPiece(const PieceWork& work, PartitionIndex piece)
{
  const std::size_t number = work.Plan.number(piece);
  const StoredResult result(work.resultPath(piece));
  result.verify();
  if (exists(work.finishedPath(piece)))
  {
    verifyFinished(work.Mesh, number, readFinished(work.finishedPath(piece)));
    return;
  }
  GrowingPiece interior = emptyPiece(work, piece);
  result.readInterior(interior);
  interior.verifyInterior(work.Mesh, number);
  interior.isolateInterior(work.Mesh, number);
}

void removePiece(const PieceWork& work, PartitionIndex piece)
{
  std::error_code ignored;
  fs::remove(work.resultPath(piece), ignored);
  fs::remove(work.finishedPath(piece), ignored);
  if (!work.Mesh.Path.empty())
  {
    const std::string file = work.Mesh.piecePath(work.Plan.number(piece));
    fs::remove(file + GrowingPiece::NextName, ignored);
    fs::create_directories(fs::path(file).parent_path(), ignored);
  }
}

class PieceFinisher
{
public:
  explicit PieceFinisher(const PieceWork& work)
    : Work(work)
  {
    for (PartitionIndex piece = 0; piece < work.Plan.pieces(); ++piece)
    {
      this->Results.push_back(std::make_unique<StoredResult>(work.resultPath(piece)));
      this->Figures.add(this->Results.back()->readFigures());
    }
    this->repairHull();
  }

  const PieceFigures& figures() const { return this->Figures; }

  FinishedPiece finish(PartitionIndex piece) const
  {
    const std::string record = this->Work.finishedPath(piece);
    if (exists(record))
    {
      return readFinished(record);
    }
    GrowingPiece growing = emptyPiece(this->Work, piece);
    this->Results[std::size_t(piece)]->readInterior(growing);
    std::vector<std::int64_t> wanted; // other pieces' points, by index among all
    for (const auto& result : this->Results)
    {
      if (result->hasBorder(piece))
      {
        this->addBorder(result->readBorder(piece), growing, wanted);
      }
    }
    const auto hull = this->Hull.find(piece);
    if (hull != this->Hull.end())
    {
      this->addBorder(hull->second, growing, wanted);
    }
    this->addRows(wanted, growing);
    if (this->Work.Taker)
    {
      const GrowingPiece::BorderMesh border = growing.borderMesh(this->Work.Rows);
      this->Work.Taker->take(std::to_string(this->Work.Plan.number(piece)) + ".border",
        border.Rows.data(), this->Work.Rows, border.Rows.size() / this->Work.Rows.Words,
        { { border.Corners.data(), border.Corners.size() / 3 } });
    }
    FinishedPiece finished =
      growing.writeBorder(this->Work.Mesh, this->Work.Plan.number(piece), this->Work.Rows);
    // From now on the file may have another layout than the result says.
    writeCheckpoint(record, [&](SaveArchive& archive) { exchange(archive, finished); });
    return finished;
  }

private:
  /// What replaces the triangles at artificial points is at the borders, too.
  void repairHull()
  {
    std::vector<BoundaryVertex> vertices;
    for (const auto& result : this->Results)
    {
      const std::vector<BoundaryVertex> more = result->readHullVertices();
      vertices.insert(vertices.end(), more.begin(), more.end());
    }
    PieceBorders borders(this->Work);
    tipp::repairHull(std::move(vertices), this->Work.Plan.Artificial, borders);
    borders.appendTo(this->Hull);
  }

  void addBorder(
    const BorderTriangles& border, GrowingPiece& growing, std::vector<std::int64_t>& wanted) const
  {
    std::uint64_t begin = 0;
    for (std::size_t i = 0; i < border.Corners.size(); ++i)
    {
      const std::uint64_t end = border.BorrowerEnds.at(i);
      growing.addTriangle(border.Corners[i],
        { border.Borrowers.begin() + std::ptrdiff_t(begin),
          border.Borrowers.begin() + std::ptrdiff_t(end) });
      begin = end;
      for (const std::int64_t point : border.Corners[i])
      {
        if (growing.needsRow(point))
        {
          growing.addRow(point, this->Work.Rows);
          wanted.push_back(point);
        }
      }
    }
  }

  /// They are on the rims of their pieces.
  void addRows(std::vector<std::int64_t>& wanted, GrowingPiece& growing) const
  {
    std::sort(wanted.begin(), wanted.end());
    const std::vector<std::int64_t>& starts = this->Work.Points.starts();
    PartitionIndex piece = -1;
    GrowingPiece other;
    for (const std::int64_t point : wanted)
    {
      const auto of = static_cast<PartitionIndex>(
        std::upper_bound(starts.begin(), starts.end(), point) - starts.begin() - 1);
      if (of != piece)
      {
        piece = of;
        other = emptyPiece(this->Work, piece);
        this->Results.at(std::size_t(piece))->readInterior(other);
      }
      growing.setRow(point, other.rimRow(point, this->Work.Rows), this->Work.Rows);
    }
  }

  const PieceWork& Work;
  std::vector<std::unique_ptr<StoredResult>> Results; ///< of each piece
  PieceFigures Figures;
  std::map<PartitionIndex, BorderTriangles> Hull; ///< by the piece that owns them
};

} // namespace

std::vector<char> verifyResults(const PieceWork& work, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn)
{
  std::vector<char> isDone(std::size_t(work.Plan.pieces()), 0);
  std::mutex mutex;
  std::string damaged; // the first of them
  int others = -1;
  const auto verify = [&](std::int64_t at, std::int64_t, int)
  {
    const auto piece = static_cast<PartitionIndex>(at);
    try
    {
      if (exists(work.resultPath(piece)))
      {
        verifyPiece(work, piece);
        isDone[std::size_t(piece)] = 1;
        return;
      }
    }
    catch (const IOError& error)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      damaged = damaged.empty() || error.path() < damaged ? error.path() : damaged;
      ++others;
    }
    removePiece(work, piece);
  };
  if (!forChunks(work.Plan.pieces(), 1, threads, report, verify))
  {
    return {};
  }
  if (!damaged.empty())
  {
    warn(damaged + ": is damaged or missing; its piece" +
      (others > 0 ? " and " + std::to_string(others) + " more are" : " is") +
      " made again from the points that were spilled.");
  }
  return isDone;
}

std::vector<FinishedPiece> finishPieces(
  const PieceWork& work, int threads, const Report& report, PieceFigures& figures)
{
  const PieceFinisher finisher(work);
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

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore3D/PieceRun3.h"

#include "Files/IOError.h"
#include "OutOfCore/StoredPieces.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

enum SectionKind : std::uint32_t
{
  InterfaceSection,
  InteriorSection,
  FiguresSection,
  HullSection,
  BorderSection,
  MessageSection
};

/// Collects the tetrahedra of the hull repair by the piece that owns them.
struct HullRepairCells : public FinalCellConsumer3
{
  explicit HullRepairCells(const PiecePlan3& plan)
    : Sorter(plan)
  {
  }

  void addInside(const std::array<std::int64_t, 4>&) override {}
  void add(const std::array<Vertex3, 4>& corners) override
  {
    this->Sorter.add(corners, this->Sorter.findMet(corners), this->Borders);
  }

  BorderSorter3 Sorter;
  BordersByOwner3 Borders;
};

void addCells(const BorderCells3& cells, PieceBorder& border)
{
  auto begin = cells.Borrowers.begin();
  for (std::size_t i = 0; i < cells.Corners.size(); ++i)
  {
    const auto end = cells.Borrowers.begin() + std::ptrdiff_t(cells.BorrowerEnds.at(i));
    border.addCell(cells.Corners[i].data(), { begin, end });
    begin = end;
  }
}

/// Sets the rows of the points that a border's tetrahedra use and that other pieces own.
void setGhosts(const PieceWork3& work, const StoredResults3& results, PieceBorder& border)
{
  std::vector<std::int64_t> ghosts = border.ghosts();
  std::sort(ghosts.begin(), ghosts.end());
  PartitionIndex piece = -1;
  PieceInterior owner;
  for (const std::int64_t point : ghosts)
  {
    const PartitionIndex of = work.Plan.pieceOf(point);
    if (of != piece)
    {
      piece = of;
      owner = results[std::size_t(piece)]->readInterior(work, piece, false);
    }
    border.setGhost(point, owner.interfaceRow(point, work.Rows));
  }
}

/// Adds the border to the file of a piece. `repaired`: tetrahedra of the hull repair.
FinishedPiece finishPiece(const PieceWork3& work, const StoredResults3& results,
  PartitionIndex piece, const BordersByOwner3& repaired)
{
  const PieceInterior interior = results[std::size_t(piece)]->readInterior(work, piece, true);
  PieceBorder border(interior, work.Rows, 4);
  for (const auto& result : results)
  {
    if (result->hasBorder(piece))
    {
      addCells(result->readBorder(piece), border);
    }
  }
  const auto added = repaired.find(piece);
  if (added != repaired.end())
  {
    addCells(added->second, border);
  }
  setGhosts(work, results, border);
  return writeBorder(work.Mesh, work.Plan.number(piece), work.Rows, interior, border);
}

} // namespace

void writeResult(const std::string& path, const PieceResult3& result)
{
  SectionFileWriter file(path);
  const PieceInterior& interior = result.Interior;
  file.add({ InterfaceSection, 0 }, packed(interior.InterfacePoints, interior.InterfaceRows));
  file.add({ InteriorSection, 0 },
    packed(interior.Room, interior.Points, interior.Cells, interior.Extent, interior.Checksums,
      interior.InterfaceCells));
  file.add({ FiguresSection, 0 }, packed(result.Figures));
  file.add({ HullSection, 0 }, packed(result.HullVertices));
  for (const auto& [owner, cells] : result.Borders)
  {
    file.add({ BorderSection, owner }, packed(cells));
  }
  for (const auto& [to, message] : result.Sent)
  {
    file.add({ MessageSection, to }, packed(message));
  }
  file.finish();
}

std::int64_t StoredResult3::countSent(PartitionIndex to) const
{
  return std::int64_t(this->File.bytes({ MessageSection, to }) / sizeof(Vertex3));
}

VertexMessage3 StoredResult3::readMessage(PartitionIndex to) const
{
  return unpacked<VertexMessage3>(this->File.read({ MessageSection, to }));
}

bool StoredResult3::hasBorder(PartitionIndex owner) const
{
  return this->File.has({ BorderSection, owner });
}

BorderCells3 StoredResult3::readBorder(PartitionIndex owner) const
{
  return unpacked<BorderCells3>(this->File.read({ BorderSection, owner }));
}

std::vector<Vertex3> StoredResult3::readHullVertices() const
{
  return unpacked<std::vector<Vertex3>>(this->File.read({ HullSection, 0 }));
}

PieceFigures StoredResult3::readFigures() const
{
  return unpacked<PieceFigures>(this->File.read({ FiguresSection, 0 }));
}

PieceInterior StoredResult3::readInterior(
  const PieceWork3& work, PartitionIndex piece, bool all) const
{
  PieceInterior interior;
  interior.First = work.Plan.first(piece);
  interior.OwnPoints = work.Plan.count(piece);
  const Bytes points = this->File.read({ InterfaceSection, 0 });
  LoadArchive first(points);
  first(interior.InterfacePoints, interior.InterfaceRows);
  if (all)
  {
    const Bytes rest = this->File.read({ InteriorSection, 0 });
    LoadArchive second(rest);
    second(interior.Room, interior.Points, interior.Cells, interior.Extent, interior.Checksums,
      interior.InterfaceCells);
  }
  return interior;
}

std::vector<char> verifyResults(const PieceWork3& work, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn)
{
  return verifyPieces(
    work.Mesh, storedPieces(work),
    [&](PartitionIndex piece)
    { return StoredResult3(work.resultPath(piece)).readInterior(work, piece, true); },
    threads, report, warn);
}

std::vector<FinishedPiece> finishPieces(const PieceWork3& work, const StoredResults3& results,
  std::uint64_t limit, int threads, const Report& report, PieceFigures& figures)
{
  std::vector<Vertex3> hull;
  for (const auto& result : results)
  {
    figures.add(result->readFigures());
    const std::vector<Vertex3> more = result->readHullVertices();
    hull.insert(hull.end(), more.begin(), more.end());
  }
  const std::uint64_t bytes = MemoryPlan3::bytesOf(std::int64_t(hull.size()), 0, 0);
  constexpr std::uint64_t always = std::uint64_t(64) << 20;
  if (bytes > std::max(limit, always))
  {
    throw IOError("There are " + std::to_string(hull.size()) +
      " points at the convex hull, which take " + std::to_string(bytes / 1000000 + 1) +
      " MB; allow more memory.");
  }
  HullRepairCells repaired(work.Plan);
  repairHull(std::move(hull), work.Plan.artificial(), repaired);
  std::vector<FinishedPiece> finished(results.size());
  const bool isDone = forChunks(std::int64_t(results.size()), 1, threads, report,
    [&](std::int64_t at, std::int64_t, int)
    {
      const auto piece = PartitionIndex(at);
      finished[work.Plan.number(piece)] = finishOnce(work.finishedPath(piece),
        [&] { return finishPiece(work, results, piece, repaired.Borders); });
    });
  return isDone ? std::move(finished) : std::vector<FinishedPiece>();
}

} // namespace tipp

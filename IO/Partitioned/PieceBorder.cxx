// SPDX-License-Identifier: BSD-3-Clause
// The part of GrowingPiece that completes a piece's file.
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Partitioned/ColumnWriter.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/PieceTuples.h"
#include "Partitioning/SharingSets.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace tipp
{

/// The border's points and triangles in the order of the file.
struct GrowingPiece::Border
{
  struct Point
  {
    int Group; ///< index of its set of borrowers
    std::int64_t Id;
    const double* Row;
    bool IsGhost;
    std::size_t Index; ///< index of a rim point, or after these of a ghost
  };
  struct Cell
  {
    int Group;
    std::array<std::int32_t, 3> Points; ///< indices in the piece, the lowest first
  };

  std::vector<Point> Points;
  std::vector<Cell> Cells;
  std::vector<LentGroup> PointGroups;
  std::vector<LentGroup> CellGroups;

  Border(const GrowingPiece& piece, const PointRowLayout& rows)
    : Of(piece)
  {
    this->uniteSets();
    this->orderPoints(rows);
    this->addCells();
  }

private:
  std::size_t index(std::int64_t place) const
  {
    const std::vector<std::int64_t>& rim = this->Of.RimPlaces;
    if (!this->Of.owns(place))
    {
      return rim.size() + std::size_t(this->Of.Ghosts.at(place));
    }
    const auto found = std::lower_bound(rim.begin(), rim.end(), place);
    if (found == rim.end() || *found != place)
    {
      throw std::logic_error("a point of a triangle at the border is not on the rim");
    }
    return std::size_t(found - rim.begin());
  }

  /// A point's set of borrowers is the union of its triangles' sets.
  void uniteSets()
  {
    this->SetOf.assign(this->Of.RimPlaces.size() + this->Of.Ghosts.size(), 0);
    this->Sets.number({}); // the empty set gets number 0, and sorts first
    std::size_t begin = 0;
    for (const SharedTriangle& triangle : this->Of.Shared)
    {
      const auto borrowers = this->Of.Borrowers.begin();
      const int set = this->Sets.number(
        { borrowers + std::ptrdiff_t(begin), borrowers + std::ptrdiff_t(triangle.BorrowerEnd) });
      begin = triangle.BorrowerEnd;
      this->CellSets.push_back(set);
      for (const std::int64_t place : triangle.Places)
      {
        int& of = this->SetOf[this->index(place)];
        of = this->Sets.unite(of, set);
      }
    }
  }

  template <typename Item>
  std::vector<LentGroup> groupsOf(const std::vector<Item>& items) const
  {
    std::vector<LentGroup> groups;
    for (std::size_t i = 0; i < items.size(); ++i)
    {
      if (i == 0 || items[i].Group != items[i - 1].Group)
      {
        groups.push_back({ this->Sets.set(this->InOrder[std::size_t(items[i].Group)]), 0 });
      }
      ++groups.back().Count;
    }
    return groups;
  }

  void orderPoints(const PointRowLayout& rows)
  {
    this->Places = this->Sets.sortedIndices();
    this->InOrder.resize(this->Places.size());
    for (std::size_t set = 0; set < this->Places.size(); ++set)
    {
      this->InOrder[std::size_t(this->Places[set])] = int(set);
    }
    const std::size_t rim = this->Of.RimPlaces.size();
    for (std::size_t i = 0; i < this->SetOf.size(); ++i)
    {
      const double* const row = i < rim ? this->Of.RimRows.data() + i * rows.Words
                                        : this->Of.GhostRows.data() + (i - rim) * rows.Words;
      this->Points.push_back(
        { this->Places[std::size_t(this->SetOf[i])], rows.id(row), row, i >= rim, i });
    }
    std::sort(this->Points.begin(), this->Points.end(),
      [](const Point& a, const Point& b)
      { return a.Group != b.Group ? a.Group < b.Group : a.Id < b.Id; });
    this->PointGroups = this->groupsOf(this->Points);
    this->Numbers.resize(this->Points.size());
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      this->Numbers[this->Points[i].Index] =
        std::int32_t(this->Of.InteriorPoints + std::int64_t(i));
    }
  }

  void addCell(int set, std::array<std::int32_t, 3> corners)
  {
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    this->Cells.push_back({ this->Places[std::size_t(set)], corners });
  }

  void addCells()
  {
    for (const std::array<std::int32_t, 3>& triangle : this->Of.RimTriangles)
    {
      std::array<std::int32_t, 3> corners = triangle;
      for (std::int32_t& corner : corners)
      {
        corner = corner < 0 ? this->Numbers[std::size_t(-1 - corner)] : corner;
      }
      this->addCell(0, corners);
    }
    for (std::size_t i = 0; i < this->Of.Shared.size(); ++i)
    {
      const std::array<std::int64_t, 3>& places = this->Of.Shared[i].Places;
      this->addCell(this->CellSets[i],
        { this->Numbers[this->index(places[0])], this->Numbers[this->index(places[1])],
          this->Numbers[this->index(places[2])] });
    }
    std::sort(this->Cells.begin(), this->Cells.end(),
      [](const Cell& a, const Cell& b)
      { return a.Group != b.Group ? a.Group < b.Group : a.Points < b.Points; });
    this->CellGroups = this->groupsOf(this->Cells);
  }

  const GrowingPiece& Of;
  SharingSets Sets;
  std::vector<int> SetOf; ///< of each point
  std::vector<int> CellSets;
  std::vector<int> Places; ///< of sets, in lexicographic order
  std::vector<int> InOrder;
  std::vector<std::int32_t> Numbers;
};

namespace
{

/// Moves the next file to this path, if there is one.
void takeNextFile(const std::string& path)
{
  std::error_code failure;
  if (!std::filesystem::exists(path + GrowingPiece::NextName, failure))
  {
    return;
  }
  std::filesystem::rename(path + GrowingPiece::NextName, path, failure);
  if (failure)
  {
    throw IOError(path, "cannot be replaced (" + failure.message() + ").");
  }
}

/// Writes the border's part of an array, group by group.
template <typename Item, typename Copy>
std::vector<std::uint64_t> writeGroups(const OutputFile& file, std::uint64_t offset,
  std::size_t tupleBytes, const std::vector<Item>& items, const Copy& copy)
{
  ColumnWriter column(file, offset, std::size_t(1) << 16);
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    if (i > 0 && items[i].Group != items[i - 1].Group)
    {
      column.endPart();
    }
    copy(items[i], i, column.extend(tupleBytes));
  }
  if (!items.empty())
  {
    column.endPart();
  }
  column.flush();
  return column.checksums();
}

} // namespace

/// Copies the interior into the next file. The present one is kept, so that this can be repeated.
void GrowingPiece::copyInterior(
  const std::string& path, const PieceLayout& from, const PieceLayout& to) const
{
  const InputFile source(path);
  const OutputFile target(path + NextName);
  for (std::size_t a = 0; a < to.Arrays.size(); ++a)
  {
    const PieceArray& array = to.Arrays[a];
    const std::int64_t tuples = holdsCellIds(array) ? 0
      : array.ofPoints()                            ? this->InteriorPoints
                                                    : this->InteriorCells;
    source.readBlocks(from.Offsets[a], std::uint64_t(tuples) * array.tupleBytes(),
      [&, at = to.Offsets[a]](const char* data, std::size_t bytes) mutable
      {
        target.write(at, data, bytes);
        at += bytes;
      });
  }
}

void GrowingPiece::verifyInterior(const PartitionedMesh& mesh, std::size_t number) const
{
  if (mesh.Path.empty())
  {
    return;
  }
  const PieceLayout layout = layOutPiece(mesh, number, this->Room, &this->Room);
  const InputFile file(mesh.piecePath(number));
  for (std::size_t a = 0; a < layout.Arrays.size(); ++a)
  {
    const PieceArray& array = layout.Arrays[a];
    if (holdsCellIds(array))
    {
      continue;
    }
    const std::int64_t tuples = array.ofPoints() ? this->InteriorPoints : this->InteriorCells;
    Checksum sum;
    file.readBlocks(layout.Offsets[a], std::uint64_t(tuples) * array.tupleBytes(),
      [&](const char* data, std::size_t bytes) { sum.add(data, bytes); });
    if (sum.finish() != this->Checksums[a])
    {
      throw IOError(file.path(), "the array " + array.Name + " does not have its checksum.");
    }
  }
}

void GrowingPiece::isolateInterior(const PartitionedMesh& mesh, std::size_t number) const
{
  if (mesh.Path.empty())
  {
    return;
  }
  const std::string path = mesh.piecePath(number);
  const PieceLayout layout = layOutPiece(mesh, number, this->Room, &this->Room);
  this->copyInterior(path, layout, layout);
  takeNextFile(path);
}

FinishedPiece GrowingPiece::writeBorder(
  const PartitionedMesh& mesh, std::size_t number, const PointRowLayout& rows) const
{
  FinishedPiece finished;
  PieceSummary& summary = finished.Summary;
  summary = mesh.Pieces[number];
  if (mesh.Path.empty())
  {
    summary.Cells =
      this->InteriorCells + std::int64_t(this->RimTriangles.size() + this->Shared.size());
    finished.TriangleSum = this->InteriorSum + this->sumBorder(rows);
    return finished;
  }
  const Border border(*this, rows);
  summary.Points = this->InteriorPoints + std::int64_t(border.Points.size());
  summary.Cells = this->InteriorCells + std::int64_t(border.Cells.size());
  summary.Extent = this->Extent;
  for (const Border::Point& point : border.Points)
  {
    extendBounds(summary.Extent, point.Row, rows);
  }
  if (summary.Extent[4] > summary.Extent[5])
  {
    summary.Extent[4] = summary.Extent[5] = 0; // without a third coordinate z is 0
  }
  if (hasWideIds(mesh, summary))
  {
    throw IOError(mesh.piecePath(number),
      "would have more cells than 32-bit numbers can count; give less memory or more partitions.");
  }
  const bool fits = summary.Points <= this->Room.Points && summary.Cells <= this->Room.Cells;
  const PieceLayout layout = layOutPiece(mesh, number, summary, fits ? &this->Room : nullptr);
  if (!fits)
  {
    this->copyInterior(
      mesh.piecePath(number), layOutPiece(mesh, number, this->Room, &this->Room), layout);
  }
  const OutputFile file = OutputFile::shared(mesh.piecePath(number) + (fits ? "" : NextName));
  for (std::size_t a = 0; a < layout.Arrays.size(); ++a)
  {
    const PieceArray& array = layout.Arrays[a];
    const std::size_t tuple = array.tupleBytes();
    const std::uint64_t size = std::uint64_t(storedTuples(mesh, summary, array)) * tuple;
    file.write(layout.Offsets[a] - 8, &size, 8);
    const std::uint64_t interior =
      std::uint64_t(array.ofPoints() ? this->InteriorPoints : this->InteriorCells);
    const std::uint64_t offset = layout.Offsets[a] + interior * tuple;
    std::vector<std::uint64_t> checksums;
    if (!holdsCellIds(array))
    {
      checksums.push_back(this->Checksums[a]);
      const std::vector<std::uint64_t> more = array.ofPoints()
        ? writeGroups(file, offset, tuple, border.Points,
            [&](const Border::Point& point, std::size_t, char* to)
            { copyPiecePoint(array, point.Row, rows, point.IsGhost, rows.id(point.Row), to); })
        : writeGroups(file, offset, tuple, border.Cells,
            [&](const Border::Cell& cell, std::size_t i, char* to)
            {
              array.Role == PieceRole::Connectivity
                ? static_cast<void>(std::memcpy(to, cell.Points.data(), tuple))
                : fillPieceCells(array, this->InteriorCells + std::int64_t(i), 1, to);
            });
      checksums.insert(checksums.end(), more.begin(), more.end());
    }
    finished.Table.Checksums.push_back(std::move(checksums));
  }
  file.write(0, layout.Header.data(), layout.Header.size());
  const std::size_t footer = std::strlen(pieceFooter);
  file.write(layout.End, pieceFooter, footer);
  file.startWriteback();
  finished.Table.Offsets = layout.Offsets;
  finished.Table.HeaderBytes = layout.Header.size();
  finished.Table.HeaderChecksum = checksumOf(layout.Header.data(), layout.Header.size());
  finished.Table.PointGroups = border.PointGroups;
  finished.Table.CellGroups = border.CellGroups;
  summary.FileBytes = layout.End + footer;
  return finished;
}

void verifyFinished(const PartitionedMesh& mesh, std::size_t number, const FinishedPiece& piece)
{
  if (mesh.Path.empty())
  {
    return;
  }
  takeNextFile(mesh.piecePath(number));
  ReadCounters counters;
  PieceFile(mesh, number, piece.Summary, piece.Table, counters).verifyAll();
}

void writeCellIds(
  const PartitionedMesh& mesh, std::size_t number, std::int64_t first, FinishedPiece& piece)
{
  const std::vector<PieceArray> arrays = pieceArrays(mesh, piece.Summary);
  const auto found = std::find_if(arrays.begin(), arrays.end(),
    [](const PieceArray& array) { return array.Role == PieceRole::CellIds; });
  const auto a = std::size_t(found - arrays.begin());
  const std::string path = mesh.piecePath(number);
  takeNextFile(path);
  const OutputFile file = OutputFile::shared(path);
  ColumnWriter column(file, piece.Table.Offsets[a], std::size_t(1) << 20);
  for (const std::int64_t count : piece.Table.parts(mesh, piece.Summary, false))
  {
    for (std::int64_t i = 0; i < count; ++i, ++first)
    {
      std::memcpy(column.extend(8), &first, 8);
    }
    column.endPart();
  }
  column.flush();
  file.startWriteback();
  piece.Table.Checksums[a] = column.checksums();
}

} // namespace tipp

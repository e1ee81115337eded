// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/GrowingPiece.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Partitioned/PieceFile.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// Whether the array holds global ids of cells, which are known last: the cells' own ids, or the
/// neighbours' ids, which are the only cell data.
bool holdsCellIds(const PieceArray& array)
{
  return array.Role == PieceRole::CellIds || array.Role == PieceRole::CellData;
}

std::int64_t interiorTuples(const PieceInterior& interior, const PieceArray& array)
{
  return array.ofPoints() ? interior.Points : interior.Cells;
}

void requireNarrowIds(
  const PartitionedMesh& mesh, std::size_t number, const PieceSummary& counts, const char* what)
{
  if (hasWideIds(mesh, counts))
  {
    throw IOError(mesh.piecePath(number),
      std::string("would have more ") + what +
        " than 32-bit numbers can count; give less memory or more partitions.");
  }
}

/// Calls visit(corners as positions in the piece, whether one of them is on the interface) for each
/// cell. `positions` has -1 - k for the k-th interface point.
template <int CellSize, typename Visit>
void forEachCell(
  const InteriorContent& content, const std::vector<std::int32_t>& positions, const Visit& visit)
{
  for (const TriangleRange& range : content.Triangles)
  {
    const std::int32_t* corner = range.Begin;
    for (std::size_t t = 0; t < range.Triangles; ++t, corner += CellSize)
    {
      CellCorners cell = { positions[std::size_t(corner[0])], positions[std::size_t(corner[1])],
        positions[std::size_t(corner[2])], 0 };
      if (CellSize == 4)
      {
        cell[3] = positions[std::size_t(corner[3])];
      }
      visit(cell, (cell[0] | cell[1] | cell[2] | cell[3]) < 0);
    }
  }
}

template <typename Visit>
void forEachCell(int cellSize, const InteriorContent& content,
  const std::vector<std::int32_t>& positions, const Visit& visit)
{
  cellSize == 3 ? forEachCell<3>(content, positions, visit)
                : forEachCell<4>(content, positions, visit);
}

/// Writes the array `offsets` or `types` for `count` cells from `first` on.
void addShapes(const PieceArray& array, int cellSize, std::int64_t first, std::int64_t count,
  ColumnWriter& column)
{
  constexpr std::int64_t block = 4096;
  for (const std::int64_t end = first + count; first < end; first += block)
  {
    const std::int64_t size = std::min(block, end - first);
    char* const to = column.extend(std::size_t(size) * array.tupleBytes());
    fillShapes(array, cellSize, first, size, to);
  }
}

/// Sets the record's members for points. Returns the points' positions in the piece, or -1 - k for
/// the k-th interface point.
std::vector<std::int32_t> orderPoints(
  const InteriorContent& content, const PointRowLayout& layout, PieceInterior& interior)
{
  interior.Extent = Box3::empty();
  std::vector<std::int32_t> positions(std::size_t(content.Points));
  std::int32_t next = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const double* const row = content.Rows + i * layout.Words;
    extendBounds(interior.Extent, layout.point(row));
    if (content.IsOnInterface[i] == 0)
    {
      positions[i] = next++;
      continue;
    }
    positions[i] = -1 - std::int32_t(interior.InterfacePoints.size());
    interior.InterfacePoints.push_back(content.First + std::int64_t(i));
    interior.InterfaceRows.insert(interior.InterfaceRows.end(), row, row + layout.Words);
  }
  interior.Points = next;
  return positions;
}

/// Reserves room for the border, whose size is not known yet: more than it usually takes.
void makeRoom(const PartitionedMesh& mesh, std::size_t number, PieceInterior& interior)
{
  const auto points = std::int64_t(interior.InterfacePoints.size());
  interior.Room = mesh.Pieces[number];
  interior.Room.Points = interior.OwnPoints + points / 2 + 256;
  interior.Room.Cells = interior.Cells + std::int64_t(interior.InterfaceCells.size()) +
    (mesh.CellSize == 3 ? 2 : 4) * points + 256;
  requireNarrowIds(mesh, number, interior.Room, "points");
}

void addPoints(const PieceArray& array, const PointRowLayout& layout,
  const InteriorContent& content, const std::vector<std::int32_t>& positions, ColumnWriter& column)
{
  const std::size_t bytes = array.tupleBytes();
  const bool hasDuplicates = content.Representatives && !content.Representatives->empty();
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    if (positions[i] < 0)
    {
      continue;
    }
    const double* const row = content.Rows + i * layout.Words;
    std::int64_t representative = layout.id(row);
    if (hasDuplicates)
    {
      const auto found = content.Representatives->find(std::int32_t(i));
      representative = found == content.Representatives->end()
        ? representative
        : layout.id(content.Rows + std::size_t(found->second) * layout.Words);
    }
    copyPoint(array, row, layout, false, representative, column.extend(bytes));
  }
}

void addInterior(const PieceArray& array, int cellSize, const PointRowLayout& layout,
  const InteriorContent& content, const std::vector<std::int32_t>& positions, std::int64_t cells,
  ColumnWriter& column)
{
  if (array.ofPoints())
  {
    addPoints(array, layout, content, positions, column);
  }
  else if (array.Role == PieceRole::Connectivity)
  {
    const std::size_t bytes = array.tupleBytes();
    forEachCell(cellSize, content, positions,
      [&](const CellCorners& cell, bool isOnInterface)
      {
        if (!isOnInterface)
        {
          std::memcpy(column.extend(bytes), cell.data(), bytes);
        }
      });
  }
  else
  {
    addShapes(array, cellSize, 0, cells, column);
  }
  column.endPart();
  column.flush();
}

/// Writes the border's part of an array.
void addBorder(const PieceArray& array, int cellSize, const PointRowLayout& layout,
  const OrderedBorder& border, std::int64_t interiorCells, ColumnWriter& column)
{
  const std::size_t tuple = array.tupleBytes();
  std::size_t next = 0;
  for (const SharedGroup& group : array.ofPoints() ? border.PointGroups : border.CellGroups)
  {
    for (const std::size_t end = next + std::size_t(group.Count); next < end; ++next)
    {
      if (array.ofPoints())
      {
        const OrderedBorder::Point& p = border.Points[next];
        copyPoint(array, p.Row, layout, p.IsGhost, layout.id(p.Row), column.extend(tuple));
      }
      else if (array.Role == PieceRole::Connectivity)
      {
        std::memcpy(column.extend(tuple), border.Cells[next].Points.data(), tuple);
      }
      else
      {
        addShapes(array, cellSize, interiorCells + std::int64_t(next), 1, column);
      }
    }
    column.endPart();
  }
  column.flush();
}

PieceSummary summarize(const PartitionedMesh& mesh, std::size_t number,
  const PointRowLayout& layout, const PieceInterior& interior, const OrderedBorder& border)
{
  PieceSummary summary = mesh.Pieces[number];
  summary.Points = interior.Points + std::int64_t(border.Points.size());
  summary.Cells = interior.Cells + std::int64_t(border.Cells.size());
  summary.Extent = interior.Extent;
  for (const OrderedBorder::Point& point : border.Points)
  {
    extendBounds(summary.Extent, layout.point(point.Row));
  }
  completeBounds(summary.Extent);
  requireNarrowIds(mesh, number, summary, "cells");
  return summary;
}

/// Copies the interior into the next file. The present one is kept, so that this can be repeated.
void copyInterior(const std::string& path, const PieceInterior& interior, const PieceLayout& from,
  const PieceLayout& to)
{
  const InputFile source(path);
  const OutputFile target(path + nextPieceSuffix);
  for (std::size_t a = 0; a < to.Arrays.size(); ++a)
  {
    const PieceArray& array = to.Arrays[a];
    const std::int64_t tuples = holdsCellIds(array) ? 0 : interiorTuples(interior, array);
    source.readBlocks(from.Offsets[a], std::uint64_t(tuples) * array.tupleBytes(),
      [&, at = to.Offsets[a]](const char* data, std::size_t bytes) mutable
      {
        target.write(at, data, bytes);
        at += bytes;
      });
  }
}

} // namespace

PieceInterior writeInterior(const PartitionedMesh& mesh, std::size_t number,
  const PointRowLayout& layout, const InteriorContent& content)
{
  PieceInterior interior;
  interior.First = content.First;
  interior.OwnPoints = content.Points;
  const std::vector<std::int32_t> positions = orderPoints(content, layout, interior);
  forEachCell(mesh.CellSize, content, positions,
    [&](const CellCorners& cell, bool isOnInterface) {
      isOnInterface ? interior.InterfaceCells.push_back(cell) : static_cast<void>(++interior.Cells);
    });
  if (mesh.Path.empty())
  {
    for (const TriangleRange& range :
      content.IsSummed ? content.Triangles : std::vector<TriangleRange>())
    {
      interior.TriangleSum += sumTriangles(range, content.Rows, layout);
    }
    return interior;
  }
  makeRoom(mesh, number, interior);
  const PieceLayout file = layOutPiece(mesh, number, interior.Room, &interior.Room);
  const OutputFile output(mesh.piecePath(number));
  for (std::size_t a = 0; a < file.Arrays.size(); ++a)
  {
    const PieceArray& array = file.Arrays[a];
    if (holdsCellIds(array))
    {
      interior.Checksums.push_back(0); // filled in once they are known
      continue;
    }
    ColumnWriter column(output, file.Offsets[a], columnBufferBytes);
    addInterior(array, mesh.CellSize, layout, content, positions, interior.Cells, column);
    interior.Checksums.push_back(column.checksums()[0]);
  }
  output.startWriteback();
  return interior;
}

FinishedPiece writeBorder(const PartitionedMesh& mesh, std::size_t number,
  const PointRowLayout& layout, const PieceInterior& interior, const PieceBorder& border)
{
  FinishedPiece finished;
  if (mesh.Path.empty())
  {
    const PieceBorder::Mesh triangles = border.mesh();
    finished.Summary = mesh.Pieces[number];
    finished.Summary.Cells =
      interior.Cells + std::int64_t(interior.InterfaceCells.size() + border.cells());
    finished.TriangleSum =
      interior.TriangleSum + sumTriangles(triangles.triangles(), triangles.Rows.data(), layout);
    return finished;
  }
  const OrderedBorder ordered(border);
  finished.Summary = summarize(mesh, number, layout, interior, ordered);
  PieceSummary& summary = finished.Summary;
  const PieceSummary& room = interior.Room;
  const bool fits = summary.Points <= room.Points && summary.Cells <= room.Cells;
  const PieceLayout file = layOutPiece(mesh, number, summary, fits ? &room : nullptr);
  const std::string path = mesh.piecePath(number);
  if (!fits)
  {
    copyInterior(path, interior, layOutPiece(mesh, number, room, &room), file);
  }
  const OutputFile output = OutputFile::shared(path + (fits ? "" : nextPieceSuffix));
  for (std::size_t a = 0; a < file.Arrays.size(); ++a)
  {
    const PieceArray& array = file.Arrays[a];
    const std::size_t tuple = array.tupleBytes();
    const std::uint64_t size = std::uint64_t(storedTuples(mesh, summary, array.ofPoints())) * tuple;
    output.write(file.Offsets[a] - 8, &size, 8);
    std::vector<std::uint64_t>& checksums = finished.Table.Checksums.emplace_back();
    if (holdsCellIds(array))
    {
      continue;
    }
    checksums.push_back(interior.Checksums[a]);
    ColumnWriter column(output,
      file.Offsets[a] + std::uint64_t(interiorTuples(interior, array)) * tuple,
      columnBufferBytes / 16);
    addBorder(array, mesh.CellSize, layout, ordered, interior.Cells, column);
    checksums.insert(checksums.end(), column.checksums().begin(), column.checksums().end());
  }
  summary.FileBytes = writeFrame(output, file, finished.Table);
  finished.Table.PointGroups = ordered.PointGroups;
  finished.Table.CellGroups = ordered.CellGroups;
  return finished;
}

void verifyInterior(const PartitionedMesh& mesh, std::size_t number, const PieceInterior& interior)
{
  if (mesh.Path.empty())
  {
    return;
  }
  const std::string path = mesh.piecePath(number);
  const PieceLayout layout = layOutPiece(mesh, number, interior.Room, &interior.Room);
  const InputFile file(path);
  for (std::size_t a = 0; a < layout.Arrays.size(); ++a)
  {
    const PieceArray& array = layout.Arrays[a];
    if (holdsCellIds(array))
    {
      continue;
    }
    Checksum sum;
    file.readBlocks(layout.Offsets[a],
      std::uint64_t(interiorTuples(interior, array)) * array.tupleBytes(),
      [&](const char* data, std::size_t bytes) { sum.add(data, bytes); });
    if (sum.finish() != interior.Checksums[a])
    {
      throw IOError(path, "the array " + array.Name + " does not have its checksum.");
    }
  }
  copyInterior(path, interior, layout, layout);
  takeNextFile(path);
}

} // namespace tipp

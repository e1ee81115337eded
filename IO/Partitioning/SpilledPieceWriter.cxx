// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionJob.h"

#include "Parallel/Poll.h"
#include "Partitioned/PieceBorder.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/PieceWriter.h"
#include "Partitioning/MeshTiling.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace tipp
{
namespace
{

// Rows copied at a time from a spill to the arrays: few enough for the L2 cache.
constexpr std::size_t blockRows = 2048;

std::uint64_t wordAt(const char* row)
{
  std::uint64_t word = 0;
  std::memcpy(&word, row, 8);
  return word;
}

/// Copies `bytes` bytes at `offset` of each row to consecutive memory.
template <std::size_t Bytes>
void copyFixed(const std::vector<const char*>& rows, std::size_t offset, char* to)
{
  for (const char* row : rows)
  {
    std::memcpy(to, row + offset, Bytes);
    to += Bytes;
  }
}

void copyBytes(
  const std::vector<const char*>& rows, std::size_t offset, std::size_t bytes, char* to)
{
  if (bytes == 8)
  {
    copyFixed<8>(rows, offset, to);
    return;
  }
  if (bytes == 4)
  {
    copyFixed<4>(rows, offset, to);
    return;
  }
  for (const char* row : rows)
  {
    std::memcpy(to, row + offset, bytes);
    to += bytes;
  }
}

/// Converts coordinates of two or three components to three; in 2D the third is 0.
void copyCoordinates(const std::vector<const char*>& rows, const RawArray& points, char* to)
{
  const std::size_t bytes = points.tupleBytes();
  const std::size_t three = 3 * scalarSize(points.Type);
  for (const char* row : rows)
  {
    std::memset(to + bytes, 0, three - bytes);
    std::memcpy(to, row + 8, bytes);
    to += three;
  }
}

/// Writes one piece's file.
class SpilledPieceWriter
{
public:
  SpilledPieceWriter(const PartitionJob& job, std::size_t piece, std::size_t bufferBytes)
    : Job(job)
    , Piece(piece)
    , BufferBytes(bufferBytes)
    , Corners(static_cast<std::size_t>(job.Rows.Corners))
  {
  }

  FinishedPiece write()
  {
    this->Summary = this->Job.Result.Pieces[this->Piece];
    this->takePointIds();
    this->takeSharedCells();
    this->sharePoints();
    this->orderPoints();
    this->countCells();
    this->Writer.emplace(this->Job.Result, this->Piece, this->Summary, this->BufferBytes);
    this->writePoints();
    completeBounds(this->Summary.Extent);
    this->writeCells();
    this->Summary.FileBytes = this->Writer->finish(this->Table);
    return { this->Summary, this->Table };
  }

private:
  using RowPointers = std::vector<const char*>;

  void takePointIds()
  {
    const Spill& points = *this->Job.Points;
    this->PointIds.reserve(std::size_t(points.rows(this->Piece)));
    this->PointFlags.reserve(std::size_t(points.rows(this->Piece)));
    points.read(this->Piece, blockRows,
      [&](const char* rows, std::size_t count)
      {
        poll();
        for (std::size_t i = 0; i < count; ++i, rows += points.rowBytes())
        {
          const std::uint64_t word = wordAt(rows);
          this->PointIds.push_back(std::int64_t(word >> 2));
          this->PointFlags.push_back(std::uint8_t(word & 3));
        }
      });
    this->Local = GlobalIdMap(this->PointIds.data(), nullptr, this->PointIds.size());
  }

  void takeSharedCells()
  {
    const std::size_t rowBytes = this->Job.SharedCells->rowBytes();
    this->SharedRows = this->Job.SharedCells->readAll(this->Piece);
    const std::vector<char> borrowers = this->Job.Borrowers->readAll(this->Piece);
    std::size_t at = 0;
    std::vector<std::int32_t> set;
    for (std::size_t i = 0; i < this->SharedRows.size(); i += rowBytes)
    {
      std::uint32_t count = 0;
      std::memcpy(&count, this->SharedRows.data() + i + rowBytes - 4, 4);
      set.resize(count);
      std::memcpy(set.data(), borrowers.data() + at, count * std::size_t(4));
      at += count * std::size_t(4);
      if (count == 0)
      {
        throw std::logic_error("a cell between partitions meets one only");
      }
      this->CellSets.push_back(this->Sets.number(set));
    }
  }

  void sharePoints()
  {
    const std::size_t rowBytes = this->Job.SharedCells->rowBytes();
    this->PointSets.assign(this->PointIds.size(), -1);
    for (std::size_t cell = 0; cell < this->CellSets.size(); ++cell)
    {
      pollAt(std::int64_t(cell));
      const char* const row = this->SharedRows.data() + cell * rowBytes;
      for (std::size_t corner = 1; corner <= this->Corners; ++corner)
      {
        const std::int64_t point = this->Local.find(this->Job.Rows.id(row, corner));
        if (point < 0)
        {
          throw std::logic_error("a piece lacks a point of one of its cells");
        }
        int& set = this->PointSets[std::size_t(point)];
        set = this->Sets.unite(set, this->CellSets[cell]);
      }
    }
  }

  std::size_t partOf(std::size_t point) const
  {
    if ((this->PointFlags[point] & RowLayout::GhostOnly) != 0)
    {
      return this->Table.PointGroups.size() + 1;
    }
    const int set = this->PointSets[point];
    return set < 0 ? 0 : std::size_t(this->PointGroupOf[std::size_t(set)]) + 1;
  }

  void orderPoints()
  {
    SharingSets::Grouping grouping = this->Sets.groups(this->PointSets);
    this->Table.PointGroups = std::move(grouping.Groups);
    this->PointGroupOf = std::move(grouping.IndexOf);

    std::vector<std::int64_t> starts(this->Table.PointGroups.size() + 3, 0);
    for (std::size_t i = 0; i < this->PointIds.size(); ++i)
    {
      ++starts[this->partOf(i) + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    this->Summary.Points = starts[starts.size() - 2];
    this->Summary.GhostPoints = starts.back() - this->Summary.Points;
    this->Indices.resize(this->PointIds.size());
    for (std::size_t i = 0; i < this->PointIds.size(); ++i)
    {
      this->Indices[i] = starts[this->partOf(i)]++;
    }
    this->Local = GlobalIdMap(this->PointIds.data(), this->Indices.data(), this->PointIds.size());
  }

  void countCells()
  {
    this->Summary.Cells =
      this->Job.Cells->rows(this->Piece) + this->Job.SharedCells->rows(this->Piece);
    if (this->Job.BorrowedCells)
    {
      this->Summary.BorrowedCells = this->Job.BorrowedCells->rows(this->Piece);
    }
    SharingSets::Grouping grouping = this->Sets.groups(this->CellSets);
    this->Table.CellGroups = std::move(grouping.Groups);
    this->CellGroupOf = std::move(grouping.IndexOf);
  }

  void appendInBlocks(const RowPointers& rows, bool ofPoints, bool ghosts)
  {
    RowPointers block;
    for (std::size_t at = 0; at < rows.size(); at += blockRows)
    {
      poll();
      block.assign(rows.begin() + std::ptrdiff_t(at),
        rows.begin() + std::ptrdiff_t(std::min(rows.size(), at + blockRows)));
      this->append(block, ofPoints, ghosts);
    }
  }

  void writePoints()
  {
    this->Summary.Extent = emptyBounds;
    const Spill& points = *this->Job.Points;
    const std::size_t rowBytes = points.rowBytes();
    // Rows of later parts are kept until the first part is complete.
    std::vector<char> waiting;
    std::vector<std::pair<std::int64_t, std::size_t>> order; // index, row in `waiting`
    std::size_t point = 0;
    RowPointers block;
    points.read(this->Piece, blockRows,
      [&](const char* rows, std::size_t count)
      {
        poll();
        block.clear();
        for (std::size_t i = 0; i < count; ++i, ++point, rows += rowBytes)
        {
          if (this->partOf(point) == 0)
          {
            block.push_back(rows);
            continue;
          }
          order.emplace_back(this->Indices[point], order.size());
          waiting.insert(waiting.end(), rows, rows + rowBytes);
        }
        this->extendBounds(block);
        this->append(block, true);
      });
    this->Writer->endPart(true);
    std::sort(order.begin(), order.end());
    auto next = order.begin();
    const auto appendPart = [&](std::int64_t count, bool isOwned)
    {
      block.clear();
      for (std::int64_t i = 0; i < count; ++i, ++next)
      {
        block.push_back(waiting.data() + next->second * rowBytes);
      }
      if (isOwned)
      {
        this->extendBounds(block);
      }
      this->appendInBlocks(block, true, false);
      this->Writer->endPart(true);
    };
    for (const SharedGroup& group : this->Table.PointGroups)
    {
      appendPart(group.Count, true);
    }
    if (this->Job.Result.Duplicated)
    {
      appendPart(this->Summary.GhostPoints, false);
    }
  }

  void writeCells()
  {
    const Spill& cells = *this->Job.Cells;
    RowPointers rows;
    cells.read(this->Piece, blockRows,
      [&](const char* block, std::size_t count)
      {
        poll();
        rows.clear();
        for (std::size_t i = 0; i < count; ++i)
        {
          rows.push_back(block + i * cells.rowBytes());
        }
        this->append(rows, false);
      });
    this->Writer->endPart(false);

    std::vector<std::pair<int, const char*>> shared; // ascending within each set
    for (std::size_t i = 0; i < this->CellSets.size(); ++i)
    {
      shared.emplace_back(this->CellGroupOf[std::size_t(this->CellSets[i])],
        this->SharedRows.data() + i * this->Job.SharedCells->rowBytes());
    }
    std::stable_sort(
      shared.begin(), shared.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    auto next = shared.begin();
    for (const SharedGroup& group : this->Table.CellGroups)
    {
      rows.clear();
      for (std::int64_t i = 0; i < group.Count; ++i, ++next)
      {
        rows.push_back(next->second);
      }
      this->appendInBlocks(rows, false, false);
      this->Writer->endPart(false);
    }
    if (this->Job.BorrowedCells)
    {
      const std::vector<char> borrowed = this->Job.BorrowedCells->readAll(this->Piece);
      rows.clear();
      for (std::size_t at = 0; at < borrowed.size(); at += this->Job.BorrowedCells->rowBytes())
      {
        rows.push_back(borrowed.data() + at);
      }
      this->appendInBlocks(rows, false, true);
      this->Writer->endPart(false);
    }
  }

  /// The offset of an attribute in a row.
  std::size_t dataOffset(const PieceArray& array) const
  {
    const bool ofPoints = array.ofPoints();
    std::size_t offset =
      ofPoints ? 8 + this->Job.Mesh.Points.tupleBytes() : this->Job.Rows.CellData;
    for (std::int64_t i = 0; i < array.Attribute; ++i)
    {
      const StoredArray& before = this->Job.Result.Arrays[std::size_t(i)];
      if (before.OfPoints == ofPoints)
      {
        offset += std::size_t(before.Components) * scalarSize(before.Type);
      }
    }
    return offset;
  }

  void extendBounds(const RowPointers& rows)
  {
    const RawArray& points = this->Job.Mesh.Points;
    for (const char* row : rows)
    {
      std::array<double, 3> point{};
      takeCoordinates(points, row + 8, 1, points.Components, point.data());
      tipp::extendBounds(this->Summary.Extent, point);
    }
  }

  /// Appends rows of points, or of cells, to the arrays of the file.
  void append(const RowPointers& rows, bool ofPoints, bool areGhosts = false)
  {
    const std::vector<PieceArray>& arrays = this->Writer->arrays();
    for (std::size_t a = 0; a < arrays.size() && !rows.empty(); ++a)
    {
      if (arrays[a].ofPoints() == ofPoints)
      {
        char* const to = this->Writer->extend(a, rows.size() * arrays[a].tupleBytes());
        this->appendArray(rows, arrays[a], areGhosts, to);
      }
    }
    this->CellsWritten += ofPoints ? 0 : std::int64_t(rows.size());
  }

  /// Writes value(row) of each row to consecutive memory.
  template <typename Value>
  static void appendValues(const RowPointers& rows, const Value& value, char* to)
  {
    for (const char* row : rows)
    {
      const auto next = value(row);
      std::memcpy(to, &next, sizeof(next));
      to += sizeof(next);
    }
  }

  template <typename Id>
  void appendLocalIds(const RowPointers& rows, char* to)
  {
    std::vector<std::int64_t> ids;
    ids.reserve(rows.size() * this->Corners);
    for (const char* row : rows)
    {
      for (std::size_t corner = 1; corner <= this->Corners; ++corner)
      {
        ids.push_back(this->Job.Rows.id(row, corner));
      }
    }
    std::vector<Id> values(ids.size());
    if (!this->Local.translate(ids.data(), ids.size(), values.data()))
    {
      throw std::logic_error("a piece lacks a point of one of its cells");
    }
    std::memcpy(to, values.data(), values.size() * sizeof(Id));
  }

  void appendArray(const RowPointers& rows, const PieceArray& array, bool areGhosts, char* to)
  {
    switch (array.Role)
    {
      case PieceRole::Points:
        copyCoordinates(rows, this->Job.Mesh.Points, to);
        break;
      case PieceRole::PointIds:
        appendValues(
          rows, [](const char* row) { return wordAt(row) >> 2; }, to);
        break;
      case PieceRole::PointGhosts:
        appendValues(
          rows, [](const char* row) { return std::uint8_t(wordAt(row) & RowLayout::Ghost); }, to);
        break;
      case PieceRole::Connectivity:
        array.Type == Scalar::Int64 ? this->appendLocalIds<std::int64_t>(rows, to)
                                    : this->appendLocalIds<std::int32_t>(rows, to);
        break;
      case PieceRole::Offsets:
      case PieceRole::Types:
        fillShapes(array, int(this->Corners), this->CellsWritten, std::int64_t(rows.size()), to);
        break;
      case PieceRole::CellGhosts:
        std::memset(to, areGhosts ? 1 : 0, rows.size());
        break;
      case PieceRole::CellIds:
        appendValues(
          rows, [this](const char* row) { return this->Job.Rows.id(row, 0); }, to);
        break;
      default:
        copyBytes(rows, this->dataOffset(array), array.tupleBytes(), to);
    }
  }

  const PartitionJob& Job;
  std::size_t Piece;
  std::size_t BufferBytes;
  std::size_t Corners;
  PieceSummary Summary;
  PieceTable Table;
  std::vector<std::int64_t> PointIds; ///< global ids, ascending
  std::vector<std::uint8_t> PointFlags;
  std::vector<char> SharedRows;
  std::vector<int> CellSets; ///< set of each shared cell
  SharingSets Sets;
  std::vector<int> PointSets;        ///< set of each point, or -1
  std::vector<int> PointGroupOf;     ///< per set: its index among the points' groups, or -1
  std::vector<int> CellGroupOf;      ///< per set: its index among the cells' groups, or -1
  std::vector<std::int64_t> Indices; ///< index of each point in the piece
  GlobalIdMap Local;
  std::optional<PieceWriter> Writer;
  std::int64_t CellsWritten = 0;
};

} // namespace

FinishedPiece writeSpilledPiece(const PartitionJob& job, std::size_t piece, std::size_t bufferBytes)
{
  return SpilledPieceWriter(job, piece, bufferBytes).write();
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionJob.h"

#include "Arrays/Concatenated.h"
#include "Files/OutputFile.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/FinishedPieces.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioned/PieceFile.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

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

using RowPointers = std::vector<const char*>;

/// Pointers to `count` consecutive rows.
RowPointers rowsOf(const char* first, std::size_t count, std::size_t rowBytes)
{
  RowPointers rows(count);
  std::generate(rows.begin(), rows.end(), [&] { return std::exchange(first, first + rowBytes); });
  return rows;
}

/// Copies `bytes` bytes at `offset` of each row to `to`; Bytes may be a compile-time constant.
template <typename Bytes>
void copyBytes(const RowPointers& rows, std::size_t offset, Bytes bytes, char* to)
{
  for (const char* row : rows)
  {
    std::memcpy(to, row + offset, bytes);
    to += bytes;
  }
}

template <std::size_t Size>
using Constant = std::integral_constant<std::size_t, Size>;

/// Converts coordinates of two or three components to three; in 2D the third is 0.
void copyCoordinates(const RowPointers& rows, const RawArray& points, char* to)
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

/// The size in bytes of the buffer for one array of a piece.
std::size_t arrayBufferBytes(const PartitionJob& job)
{
  const std::size_t columns = job.Result.Arrays.size() + 8;
  const std::size_t share =
    std::size_t(job.Options.MemoryLimit / 8) / (columns * std::size_t(job.Threads));
  return std::clamp<std::size_t>(share, std::size_t(1) << 14, std::size_t(1) << 19);
}

/// Writes one piece's file from its spilled rows. Only its points' ids, its shared and borrowed
/// cells and their points are held in memory; the rest is streamed.
class SpilledPieceWriter
{
public:
  SpilledPieceWriter(const PartitionJob& job, std::size_t piece)
    : Job(job)
    , Piece(piece)
    , Corners(std::size_t(job.Mesh.CellSize))
  {
  }

  /// The result lacks the borrowed groups. Throws IOError.
  FinishedPiece write()
  {
    this->Summary = this->Job.Result.Pieces[this->Piece];
    this->takePointIds();
    this->takeSharedCells();
    this->orderPoints();
    this->Summary.Cells =
      this->Job.Cells->rows(this->Piece) + this->Job.SharedCells->rows(this->Piece);
    if (this->Job.BorrowedCells)
    {
      this->Summary.BorrowedCells = this->Job.BorrowedCells->rows(this->Piece);
    }
    this->Writer.emplace(this->Job.Result, this->Piece, this->Summary, arrayBufferBytes(this->Job));
    this->writePoints();
    completeBounds(this->Summary.Extent);
    this->writeCells();
    this->Summary.FileBytes = this->Writer->finish(this->Table);
    return { this->Summary, this->Table };
  }

private:
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
    this->PointSets.assign(this->PointIds.size(), -1);
    for (std::size_t i = 0; i < this->SharedRows.size(); i += rowBytes)
    {
      pollAt(std::int64_t(this->CellSets.size()));
      const char* const row = this->SharedRows.data() + i;
      std::uint32_t count = 0;
      std::memcpy(&count, row + rowBytes - 4, 4);
      set.resize(count);
      std::memcpy(set.data(), borrowers.data() + at, count * std::size_t(4));
      at += count * std::size_t(4);
      if (count == 0)
      {
        throw std::logic_error("a cell between partitions meets one only");
      }
      this->CellSets.push_back(this->Sets.number(set));
      for (std::size_t corner = 1; corner <= this->Corners; ++corner)
      {
        const std::int64_t point = this->Local.find(this->Job.Rows.id(row, corner));
        if (point < 0)
        {
          throw std::logic_error("a piece lacks a point of one of its cells");
        }
        int& pointSet = this->PointSets[std::size_t(point)];
        pointSet = this->Sets.unite(pointSet, this->CellSets.back());
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
    this->PointGroupOf = this->Sets.groups(this->PointSets, this->Table.PointGroups);
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

  /// Appends a part's rows in blocks.
  void appendPart(const RowPointers& rows, bool ofPoints, bool areGhosts)
  {
    RowPointers block;
    for (std::size_t at = 0; at < rows.size(); at += blockRows)
    {
      poll();
      block.assign(rows.begin() + std::ptrdiff_t(at),
        rows.begin() + std::ptrdiff_t(std::min(rows.size(), at + blockRows)));
      this->append(block, ofPoints, areGhosts);
    }
    this->Writer->endPart(ofPoints);
  }

  void writePoints()
  {
    this->Summary.Extent = Box3::empty();
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
        this->append(block, true);
      });
    this->Writer->endPart(true);
    std::sort(order.begin(), order.end());
    auto next = order.begin();
    const auto appendNext = [&](std::int64_t count, bool areGhosts)
    {
      block.clear();
      for (std::int64_t i = 0; i < count; ++i, ++next)
      {
        block.push_back(waiting.data() + next->second * rowBytes);
      }
      this->appendPart(block, true, areGhosts);
    };
    for (const SharedGroup& group : this->Table.PointGroups)
    {
      appendNext(group.Count, false);
    }
    if (this->Job.Result.Duplicated)
    {
      appendNext(this->Summary.GhostPoints, true);
    }
  }

  void writeCells()
  {
    const Spill& cells = *this->Job.Cells;
    cells.read(this->Piece, blockRows,
      [&](const char* block, std::size_t count)
      {
        poll();
        this->append(rowsOf(block, count, cells.rowBytes()), false);
      });
    this->Writer->endPart(false);

    const std::vector<int> groupOf = this->Sets.groups(this->CellSets, this->Table.CellGroups);
    std::vector<std::pair<int, const char*>> shared; // ascending within each set
    for (std::size_t i = 0; i < this->CellSets.size(); ++i)
    {
      shared.emplace_back(groupOf[std::size_t(this->CellSets[i])],
        this->SharedRows.data() + i * this->Job.SharedCells->rowBytes());
    }
    std::stable_sort(
      shared.begin(), shared.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    auto next = shared.begin();
    for (const SharedGroup& group : this->Table.CellGroups)
    {
      RowPointers rows;
      for (std::int64_t i = 0; i < group.Count; ++i, ++next)
      {
        rows.push_back(next->second);
      }
      this->appendPart(rows, false, false);
    }
    if (this->Job.BorrowedCells)
    {
      const std::vector<char> borrowed = this->Job.BorrowedCells->readAll(this->Piece);
      const std::size_t rowBytes = this->Job.BorrowedCells->rowBytes();
      this->appendPart(rowsOf(borrowed.data(), borrowed.size() / rowBytes, rowBytes), false, true);
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
      Point3 point{};
      takeCoordinates(points, row + 8, 1, points.Components, &point.x);
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
    if (ofPoints && !areGhosts)
    {
      this->extendBounds(rows);
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
      {
        const std::size_t offset = this->dataOffset(array);
        const std::size_t bytes = array.tupleBytes();
        bytes == 8     ? copyBytes(rows, offset, Constant<8>(), to)
          : bytes == 4 ? copyBytes(rows, offset, Constant<4>(), to)
                       : copyBytes(rows, offset, bytes, to);
      }
    }
  }

  const PartitionJob& Job;
  std::size_t Piece;
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
  std::vector<std::int64_t> Indices; ///< index of each point in the piece
  GlobalIdMap Local;
  std::optional<PieceWriter> Writer;
  std::int64_t CellsWritten = 0;
};

/// This rank's pieces: [first, last).
std::pair<std::size_t, std::size_t> shareOfPieces(const PartitionJob& job)
{
  std::vector<std::int64_t> weights;
  for (std::size_t piece = 0; piece < job.pieces(); ++piece)
  {
    weights.push_back(1 + job.Cells->rows(piece) + job.Points->rows(piece));
  }
  const std::vector<std::size_t> starts = assignPieces(weights, job.Team.size());
  const auto own = starts.begin() + job.Team.rank();
  return { own[0], own[1] };
}

std::vector<FinishedPiece> writeShare(PartitionJob& job, std::size_t first, std::size_t last)
{
  // The heaviest first, for load balance.
  std::vector<std::size_t> order(last - first);
  std::iota(order.begin(), order.end(), first);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return job.Cells->rows(a) > job.Cells->rows(b); });
  std::vector<FinishedPiece> finished(order.size());
  forChunks(
    std::int64_t(order.size()), 1, job.Threads,
    [&job](double done)
    {
      job.report(0.7 + 0.25 * done);
      return true;
    },
    [&](std::int64_t i, std::int64_t, int)
    {
      const std::size_t piece = order[std::size_t(i)];
      finished[piece - first] = SpilledPieceWriter(job, piece).write();
    });
  return finished;
}

} // namespace

void writePieces(PartitionJob& job)
{
  std::pair<std::size_t, std::size_t> share;
  std::vector<FinishedPiece> mine;
  job.Team.attempt(
    [&]
    {
      share = shareOfPieces(job);
      mine = writeShare(job, share.first, share.second);
    });
  std::vector<FinishedPiece> pieces = concatenated(job.Team.gather(mine));
  job.Team.attempt(
    [&]
    {
      // The data have been written back to the disk since the first piece was complete.
      for (std::size_t piece = share.first; piece < share.second; ++piece)
      {
        poll();
        syncToDisk(job.Result.piecePath(piece));
      }
    });
  job.Team.attempt(
    [&]
    {
      if (job.Team.isFirst())
      {
        job.Statistics.MeshBytes = publishPieces(job.Result, pieces).Bytes;
      }
    });
}

} // namespace tipp

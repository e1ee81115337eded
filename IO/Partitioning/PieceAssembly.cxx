// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PieceAssembly.h"
#include "Parallel/Poll.h"

#include <algorithm>
#include <limits>
#include <numeric>
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

} // namespace

void PieceAssembly::assemble()
{
  this->Summary = this->Run.Result.Pieces[this->Piece];
  this->takePointIds();
  this->takeSharedCells();
  this->lendPoints();
  this->orderPoints();
  this->countCells();
  this->Writer.emplace(this->Run.Result, this->Piece, this->Summary, this->BufferBytes);
  this->writePoints();
  this->writeCells();
  this->Summary.FileBytes = this->Writer->finish(this->Table);
}

void PieceAssembly::takePointIds()
{
  const Spill& points = *this->Run.Points;
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
  this->Local = IdMap(this->PointIds.data(), nullptr, this->PointIds.size());
}

void PieceAssembly::takeSharedCells()
{
  const std::size_t rowBytes = this->Run.SharedCells->rowBytes();
  this->SharedRows = this->Run.SharedCells->readAll(this->Piece);
  const std::vector<char> borrowers = this->Run.Borrowers->readAll(this->Piece);
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

void PieceAssembly::lendPoints()
{
  const std::size_t rowBytes = this->Run.SharedCells->rowBytes();
  this->PointSets.assign(this->PointIds.size(), -1);
  for (std::size_t cell = 0; cell < this->CellSets.size(); ++cell)
  {
    pollAt(std::int64_t(cell));
    const char* const row = this->SharedRows.data() + cell * rowBytes;
    for (std::size_t corner = 1; corner <= this->Corners; ++corner)
    {
      const std::int64_t point = this->Local.find(this->Run.Rows.id(row, corner));
      if (point < 0)
      {
        throw std::logic_error("a piece lacks a point of one of its cells");
      }
      int& set = this->PointSets[std::size_t(point)];
      set = this->Sets.unite(set, this->CellSets[cell]);
    }
  }
}

std::size_t PieceAssembly::partOf(std::size_t point) const
{
  if ((this->PointFlags[point] & RowLayout::GhostOnly) != 0)
  {
    return this->Table.PointGroups.size() + 1;
  }
  const int set = this->PointSets[point];
  return set < 0 ? 0 : std::size_t(this->PointGroupOf[std::size_t(set)]) + 1;
}

void PieceAssembly::orderPoints()
{
  LentSets::Grouping grouping = this->Sets.groups(this->PointSets);
  this->Table.PointGroups = std::move(grouping.Groups);
  this->PointGroupOf = std::move(grouping.PlaceOf);

  std::vector<std::int64_t> starts(this->Table.PointGroups.size() + 3, 0);
  for (std::size_t i = 0; i < this->PointIds.size(); ++i)
  {
    ++starts[this->partOf(i) + 1];
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  this->Summary.Points = starts[starts.size() - 2];
  this->Summary.GhostPoints = starts.back() - this->Summary.Points;
  this->Places.resize(this->PointIds.size());
  for (std::size_t i = 0; i < this->PointIds.size(); ++i)
  {
    this->Places[i] = starts[this->partOf(i)]++;
  }
  this->Local = IdMap(this->PointIds.data(), this->Places.data(), this->PointIds.size());
}

void PieceAssembly::countCells()
{
  this->Summary.Cells =
    this->Run.Cells->rows(this->Piece) + this->Run.SharedCells->rows(this->Piece);
  if (this->Run.BorrowedCells)
  {
    this->Summary.BorrowedCells = this->Run.BorrowedCells->rows(this->Piece);
  }
  this->Table.CellGroups = this->Sets.groups(this->CellSets).Groups;
}

void PieceAssembly::appendInBlocks(const RowPointers& rows, bool ofPoints, bool ghosts)
{
  RowPointers block;
  for (std::size_t at = 0; at < rows.size(); at += blockRows)
  {
    poll();
    block.assign(rows.begin() + std::ptrdiff_t(at),
      rows.begin() + std::ptrdiff_t(std::min(rows.size(), at + blockRows)));
    ofPoints ? this->appendPoints(block) : this->appendCells(block, ghosts);
  }
}

void PieceAssembly::writePoints()
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  this->Summary.Extent = { infinity, -infinity, infinity, -infinity, infinity, -infinity };
  const Spill& points = *this->Run.Points;
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
        order.emplace_back(this->Places[point], order.size());
        waiting.insert(waiting.end(), rows, rows + rowBytes);
      }
      this->extendBounds(block);
      this->appendPoints(block);
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
  for (const LentGroup& group : this->Table.PointGroups)
  {
    appendPart(group.Count, true);
  }
  if (this->Run.Result.Duplicated)
  {
    appendPart(this->Summary.GhostPoints, false);
  }
}

void PieceAssembly::writeCells()
{
  const Spill& cells = *this->Run.Cells;
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
      this->appendCells(rows, false);
    });
  this->Writer->endPart(false);

  const std::vector<int> places = this->Sets.places();
  std::vector<std::pair<int, const char*>> shared; // ascending within each set
  for (std::size_t i = 0; i < this->CellSets.size(); ++i)
  {
    shared.emplace_back(places[std::size_t(this->CellSets[i])],
      this->SharedRows.data() + i * this->Run.SharedCells->rowBytes());
  }
  std::stable_sort(
    shared.begin(), shared.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  auto next = shared.begin();
  for (const LentGroup& group : this->Table.CellGroups)
  {
    rows.clear();
    for (std::int64_t i = 0; i < group.Count; ++i, ++next)
    {
      rows.push_back(next->second);
    }
    this->appendInBlocks(rows, false, false);
    this->Writer->endPart(false);
  }
  if (this->Run.BorrowedCells)
  {
    const std::vector<char> borrowed = this->Run.BorrowedCells->readAll(this->Piece);
    rows.clear();
    for (std::size_t at = 0; at < borrowed.size(); at += this->Run.BorrowedCells->rowBytes())
    {
      rows.push_back(borrowed.data() + at);
    }
    this->appendInBlocks(rows, false, true);
    this->Writer->endPart(false);
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/DistributeCells.h"

#include "Flat/CellReader.h"
#include "Loading/VertexLoader.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Partition/ClassifyCells.h"
#include "Partitioning/Columns.h"
#include "Partitioning/ForeignPoint.h"
#include "Partitioning/PartitionRun.h"
#include "Partitioning/PointCoordinates.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// One chunk of cells in memory.
struct Chunk
{
  std::int64_t First = 0;
  std::size_t Cells = 0;
  std::vector<std::int64_t> Ids;
  std::vector<std::int32_t> Homes;   ///< owners of the vertices, cell by cell
  std::vector<std::int32_t> Inside;  ///< the partition that contains the cell, or -1
  std::vector<std::uint32_t> Border; ///< cells that meet several partitions
};

class CellDistribution
{
public:
  explicit CellDistribution(PartitionRun& run)
    : Run(run)
    , Corners(std::size_t(run.Rows.Corners))
    , Data(run.CellData)
    , HomeLoader(makeVertexLoader({ run.homes() }, run.loaderOptions()))
    , PointLoader(makeVertexLoader({ run.Mesh.Points }, run.loaderOptions()))
  {
  }

  void run();

private:
  void loadHomes(Chunk& chunk);
  void spillInterior(const Chunk& chunk);
  Membership classify(const Chunk& chunk, std::size_t first, std::size_t count);
  void spillBorder(const Chunk& chunk, std::size_t first, std::size_t count);
  void spillForeignPoints(
    const Chunk& chunk, std::size_t first, std::size_t count, const Membership& members);
  std::int32_t homeOf(std::int32_t entry) const { return entry < 0 ? -1 - entry : entry; }

  char* putCell(const Chunk& chunk, std::size_t cell, char* to) const
  {
    const RowLayout& rows = this->Run.Rows;
    to = rows.putId(chunk.First + std::int64_t(cell), to);
    for (std::size_t corner = 0; corner < this->Corners; ++corner)
    {
      to = rows.putId(chunk.Ids[cell * this->Corners + corner], to);
    }
    return this->Data.copyRow(cell, to);
  }

  PartitionRun& Run;
  std::size_t Corners;
  Columns Data;
  std::unique_ptr<VertexLoader> HomeLoader;
  std::unique_ptr<VertexLoader> PointLoader;
};

void CellDistribution::run()
{
  const auto [first, last] = this->Run.Team.shareOf(this->Run.Mesh.Cells.Tuples);
  CellReader reader(this->Run.Mesh, first, last, this->Run.Threads);
  const std::size_t batch = std::size_t(std::max<std::int64_t>(1, this->Run.ChunkCells / 8));
  Chunk chunk;
  while (reader.next(this->Run.ChunkCells, chunk.Ids))
  {
    chunk.First = reader.firstCell();
    chunk.Cells = chunk.Ids.size() / this->Corners;
    this->Data.read(chunk.First, std::int64_t(chunk.Cells), this->Run.Threads);
    this->loadHomes(chunk);
    poll();
    this->spillInterior(chunk);
    for (std::size_t at = 0; at < chunk.Border.size(); at += batch)
    {
      poll();
      this->spillBorder(chunk, at, std::min(batch, chunk.Border.size() - at));
    }
    const auto done = double(chunk.First - first) + double(chunk.Cells);
    this->Run.report(0.05 + 0.45 * done / double(last - first));
  }
  PartitionStatistics& statistics = this->Run.Statistics;
  statistics.Loader = loaderName(this->HomeLoader->kind());
  for (const VertexLoader* loader : { this->HomeLoader.get(), this->PointLoader.get() })
  {
    const LoadCounters& counters = loader->counters();
    statistics.Loads.Reads += counters.Reads;
    statistics.Loads.Bytes += counters.Bytes;
    statistics.Loads.UsefulBytes += counters.UsefulBytes;
    statistics.Loads.Passes += counters.Passes;
    statistics.Loads.CacheMisses += counters.CacheMisses;
  }
}

void CellDistribution::loadHomes(Chunk& chunk)
{
  chunk.Homes.resize(chunk.Ids.size());
  void* const out[] = { chunk.Homes.data() };
  poll();
  this->HomeLoader->load(chunk.Ids.data(), chunk.Ids.size(), out);
  chunk.Inside.resize(chunk.Cells);
  const std::size_t stretches = std::size_t(this->Run.Threads);
  std::vector<std::vector<std::uint32_t>> border(stretches);
  parallelFor(std::int64_t(stretches), this->Run.Threads,
    [&](std::int64_t stretch)
    {
      const auto s = std::size_t(stretch);
      for (std::size_t i = chunk.Cells * s / stretches; i < chunk.Cells * (s + 1) / stretches; ++i)
      {
        pollAt(std::int64_t(i));
        const std::int32_t* homes = chunk.Homes.data() + i * this->Corners;
        bool isInside = homes[0] >= 0;
        for (std::size_t corner = 1; corner < this->Corners; ++corner)
        {
          isInside = isInside && homes[corner] == homes[0];
        }
        chunk.Inside[i] = isInside ? homes[0] : -1;
        if (!isInside)
        {
          border[s].push_back(std::uint32_t(i));
        }
      }
    });
  chunk.Border.clear();
  for (const std::vector<std::uint32_t>& part : border)
  {
    chunk.Border.insert(chunk.Border.end(), part.begin(), part.end());
  }
}

void CellDistribution::spillInterior(const Chunk& chunk)
{
  this->Run.Cells->add(
    chunk.Cells, this->Run.Threads, [&](std::size_t i) { return chunk.Inside[i]; },
    [&](std::size_t i, char* to) { this->putCell(chunk, i, to); });
}

Membership CellDistribution::classify(const Chunk& chunk, std::size_t first, std::size_t count)
{
  std::vector<std::int64_t> ids;
  ids.reserve(count * this->Corners);
  for (std::size_t i = first; i < first + count; ++i)
  {
    const auto* cell = chunk.Ids.data() + chunk.Border[i] * this->Corners;
    ids.insert(ids.end(), cell, cell + this->Corners);
  }
  const RawArray& points = this->Run.Mesh.Points;
  std::vector<char> raw(ids.size() * points.tupleBytes());
  void* const out[] = { raw.data() };
  poll();
  this->PointLoader->load(ids.data(), ids.size(), out);
  const int dimension = this->Run.Rows.Dimension;
  std::vector<double> coordinates(ids.size() * std::size_t(dimension));
  takeCoordinates(points, raw.data(), ids.size(), dimension, coordinates.data());
  ClassifyOptions options;
  options.Device = this->Run.Options.Device;
  options.Threads = this->Run.Threads;
  return classifyCells(
    { dimension, int(this->Corners), coordinates.data(), count }, *this->Run.Tiling, options);
}

void CellDistribution::spillBorder(const Chunk& chunk, std::size_t first, std::size_t count)
{
  const Membership members = this->classify(chunk, first, count);
  const auto cellOf = [&](std::size_t i) { return std::size_t(chunk.Border[first + i]); };
  this->Run.SharedCells->add(
    count, this->Run.Threads, [&](std::size_t i) { return members.Owner[i]; },
    [&](std::size_t i, char* to)
    {
      to = this->putCell(chunk, cellOf(i), to);
      const auto borrowers = std::uint32_t(members.BorrowerStart[i + 1] - members.BorrowerStart[i]);
      std::memcpy(to, &borrowers, 4);
    });
  // For each entry of the borrowers, the cell's index in the chunk.
  std::vector<std::uint32_t> cells;
  for (std::size_t i = 0; i < count; ++i)
  {
    cells.insert(cells.end(), std::size_t(members.BorrowerStart[i + 1] - members.BorrowerStart[i]),
      std::uint32_t(i));
  }
  this->Run.Borrowers->add(
    cells.size(), this->Run.Threads, [&](std::size_t i) { return members.Owner[cells[i]]; },
    [&](std::size_t i, char* to) { std::memcpy(to, &members.Borrowers[i], 4); });
  if (this->Run.BorrowedCells)
  {
    this->Run.BorrowedCells->add(
      cells.size(), this->Run.Threads, [&](std::size_t i) { return members.Borrowers[i]; },
      [&](std::size_t i, char* to) { this->putCell(chunk, cellOf(cells[i]), to); });
  }
  poll();
  this->spillForeignPoints(chunk, first, count, members);
  this->Run.Statistics.BorderCells += std::int64_t(count);
  this->Run.Statistics.BorrowedCells += std::int64_t(cells.size());
}

void CellDistribution::spillForeignPoints(
  const Chunk& chunk, std::size_t first, std::size_t count, const Membership& members)
{
  std::vector<ForeignPoint> points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t cell = chunk.Border[first + i];
    for (std::size_t corner = 0; corner < this->Corners; ++corner)
    {
      const std::int64_t point = chunk.Ids[cell * this->Corners + corner];
      const std::int32_t home = this->homeOf(chunk.Homes[cell * this->Corners + corner]);
      if (members.Owner[i] != home)
      {
        points.push_back({ point, members.Owner[i], 0 });
      }
      const bool lends = this->Run.BorrowedCells.has_value();
      for (std::int64_t b = members.BorrowerStart[i]; lends && b < members.BorrowerStart[i + 1];
           ++b)
      {
        if (members.Borrowers[std::size_t(b)] != home)
        {
          points.push_back({ point, members.Borrowers[std::size_t(b)], 1 });
        }
      }
    }
  }
  makeDistinct(points);
  this->Run.ForeignPoints->add(
    points.size(), this->Run.Threads,
    [&](std::size_t i) { return points[i].Point / this->Run.ChunkPoints; },
    [&](std::size_t i, char* to) { std::memcpy(to, &points[i], sizeof(ForeignPoint)); });
}

} // namespace

void distributeCells(PartitionRun& run)
{
  const Ranks& ranks = run.Team;
  const std::size_t pieces = run.pieces();
  const std::size_t chunks =
    std::size_t((run.Mesh.Points.Tuples + run.ChunkPoints - 1) / run.ChunkPoints);
  ranks.attempt(
    [&]
    {
      run.Cells.emplace(run.scratch("cells"), ranks.rank(), pieces, run.Rows.CellBytes);
      run.SharedCells.emplace(run.scratch("shared"), ranks.rank(), pieces, run.Rows.CellBytes + 4);
      run.Borrowers.emplace(run.scratch("borrowers"), ranks.rank(), pieces, 4);
      if (run.Options.DuplicateBorrowers)
      {
        run.BorrowedCells.emplace(
          run.scratch("borrowed"), ranks.rank(), pieces, run.Rows.CellBytes);
      }
      run.ForeignPoints.emplace(run.scratch("foreign"), ranks.rank(), chunks, sizeof(ForeignPoint));
      CellDistribution(run).run();
    });
  run.Statistics.SpilledBytes += run.Cells->bytes() + run.SharedCells->bytes() +
    run.Borrowers->bytes() + run.ForeignPoints->bytes() +
    (run.BorrowedCells ? run.BorrowedCells->bytes() : 0);
  run.Cells->exchange(ranks);
  run.SharedCells->exchange(ranks);
  run.Borrowers->exchange(ranks);
  run.ForeignPoints->exchange(ranks);
  if (run.BorrowedCells)
  {
    run.BorrowedCells->exchange(ranks);
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Concatenated.h"
#include "Files/InputFile.h"
#include "Flat/FlatMesh.h"
#include "Loading/ArrayFiles.h"
#include "Loading/VertexLoader.h"
#include "Parallel/ParallelFor.h"
#include "Partition/ClassifyCells.h"
#include "Partitioning/MeshTiling.h"
#include "Partitioning/PartitionJob.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <tuple>

namespace tipp
{
namespace
{

/// A range of tuples of several arrays in memory, copied out row by row. A row is one tuple of each
/// array.
class ArrayRows
{
public:
  /// The arrays have the same number of tuples. Throws IOError if a file cannot be opened or is too
  /// short.
  explicit ArrayRows(const std::vector<RawArray>& arrays)
    : Files(arrays)
  {
  }

  /// Reads tuples [first, first + count) of each array. Throws IOError.
  void read(std::int64_t first, std::int64_t count, int threads)
  {
    LoadCounters unused;
    this->Tuples.resize(this->Files, count);
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      this->Files.read(a, first, count, this->Tuples.data(a), threads, unused);
    }
  }

  /// Copies the row at index `index` of the range to `to`; returns the end of the copy.
  char* copyRow(std::size_t index, char* to) const
  {
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      const std::size_t bytes = this->Files.tupleBytes(a);
      std::memcpy(to, this->Tuples.data(a) + index * bytes, bytes);
      to += bytes;
    }
    return to;
  }

private:
  ArrayFiles Files;
  TupleBuffers Tuples;
};

/// The owner in an entry of the file that writeOwners() makes.
std::int32_t ownerOf(std::int32_t entry)
{
  return entry < 0 ? -1 - entry : entry;
}

/// A ghost point: a vertex that a piece needs but does not own.
struct GhostPoint
{
  std::int64_t Point;     ///< global point id
  std::int32_t Piece;     ///< index of the piece that needs it
  std::int32_t GhostOnly; ///< 1 if only borrowed cells use it, else 0
};

/// Sorts by point, then piece, and removes duplicates: several cells may need a point. A point that
/// an owned cell uses is not GhostOnly.
void makeDistinct(std::vector<GhostPoint>& points)
{
  const auto keyOf = [](const GhostPoint& p)
  { return std::make_tuple(p.Point, p.Piece, p.GhostOnly); };
  std::sort(points.begin(), points.end(),
    [&](const GhostPoint& a, const GhostPoint& b) { return keyOf(a) < keyOf(b); });
  points.erase(std::unique(points.begin(), points.end(),
                 [](const GhostPoint& a, const GhostPoint& b)
                 { return a.Point == b.Point && a.Piece == b.Piece; }),
    points.end());
}

/// One chunk of cells in memory.
struct Chunk
{
  std::int64_t First = 0;
  std::size_t Cells = 0;
  std::vector<std::int64_t> Ids;
  std::vector<std::int32_t> Owners;  ///< owners of the vertices, cell by cell
  std::vector<std::int32_t> Inside;  ///< the partition that contains the cell, or -1
  std::vector<std::uint32_t> Border; ///< cells that meet several partitions
};

class CellDistribution
{
public:
  explicit CellDistribution(PartitionJob& job)
    : Job(job)
    , Corners(std::size_t(job.Mesh.CellSize))
    , Data(job.CellData)
    , OwnerLoader(makeVertexLoader({ job.owners() }, job.loaderOptions()))
    , PointLoader(makeVertexLoader({ job.Mesh.Points }, job.loaderOptions()))
  {
  }

  void run()
  {
    const auto [first, last] = this->Job.Team.shareOf(this->Job.Mesh.Cells.Tuples);
    const CellReader reader(this->Job.Mesh, this->Job.Threads);
    const std::size_t batch = std::size_t(std::max<std::int64_t>(1, this->Job.ChunkCells / 8));
    Chunk chunk;
    for (chunk.First = first; chunk.First < last; chunk.First += this->Job.ChunkCells)
    {
      reader.read(chunk.First, std::min(this->Job.ChunkCells, last - chunk.First), chunk.Ids);
      chunk.Cells = chunk.Ids.size() / this->Corners;
      this->Data.read(chunk.First, std::int64_t(chunk.Cells), this->Job.Threads);
      this->loadOwners(chunk);
      poll();
      this->spillInterior(chunk);
      for (std::size_t at = 0; at < chunk.Border.size(); at += batch)
      {
        poll();
        this->spillBorder(chunk, at, std::min(batch, chunk.Border.size() - at));
      }
      const auto done = double(chunk.First - first) + double(chunk.Cells);
      this->Job.report(0.05 + 0.45 * done / double(last - first));
    }
    PartitionStatistics& statistics = this->Job.Statistics;
    statistics.Loader = this->OwnerLoader->name();
    for (const VertexLoader* loader : { this->OwnerLoader.get(), this->PointLoader.get() })
    {
      const LoadCounters& counters = loader->counters();
      statistics.Loads.Reads += counters.Reads;
      statistics.Loads.Bytes += counters.Bytes;
      statistics.Loads.UsefulBytes += counters.UsefulBytes;
      statistics.Loads.Passes += counters.Passes;
    }
  }

private:
  void loadOwners(Chunk& chunk)
  {
    chunk.Owners.resize(chunk.Ids.size());
    void* const out[] = { chunk.Owners.data() };
    poll();
    this->OwnerLoader->load(chunk.Ids.data(), chunk.Ids.size(), out);
    chunk.Inside.resize(chunk.Cells);
    const std::size_t ranges = std::size_t(this->Job.Threads);
    std::vector<std::vector<std::uint32_t>> border(ranges);
    parallelFor(std::int64_t(ranges), this->Job.Threads,
      [&](std::int64_t range)
      {
        const auto s = std::size_t(range);
        for (std::size_t i = chunk.Cells * s / ranges; i < chunk.Cells * (s + 1) / ranges; ++i)
        {
          pollAt(std::int64_t(i));
          const std::int32_t* owners = chunk.Owners.data() + i * this->Corners;
          bool isInside = owners[0] >= 0;
          for (std::size_t corner = 1; corner < this->Corners; ++corner)
          {
            isInside = isInside && owners[corner] == owners[0];
          }
          chunk.Inside[i] = isInside ? owners[0] : -1;
          if (!isInside)
          {
            border[s].push_back(std::uint32_t(i));
          }
        }
      });
    chunk.Border = concatenated(border);
  }

  void spillInterior(const Chunk& chunk)
  {
    this->Job.Cells->add(
      chunk.Cells, this->Job.Threads, [&](std::size_t i) { return chunk.Inside[i]; },
      [&](std::size_t i, char* to) { this->putCell(chunk, i, to); });
  }

  Membership classify(const Chunk& chunk, std::size_t first, std::size_t count)
  {
    std::vector<std::int64_t> ids;
    ids.reserve(count * this->Corners);
    for (std::size_t i = first; i < first + count; ++i)
    {
      const auto* cell = chunk.Ids.data() + chunk.Border[i] * this->Corners;
      ids.insert(ids.end(), cell, cell + this->Corners);
    }
    const std::vector<double> coordinates =
      loadCoordinates(this->Job.Mesh, *this->PointLoader, ids);
    return classifyCells({ int(this->Corners) - 1, int(this->Corners), coordinates.data(), count },
      *this->Job.Tiling, { this->Job.Options.Device, this->Job.Threads });
  }

  void spillBorder(const Chunk& chunk, std::size_t first, std::size_t count)
  {
    const Membership members = this->classify(chunk, first, count);
    const auto cellOf = [&](std::size_t i) { return std::size_t(chunk.Border[first + i]); };
    this->Job.SharedCells->add(
      count, this->Job.Threads, [&](std::size_t i) { return members.Owner[i]; },
      [&](std::size_t i, char* to)
      {
        to = this->putCell(chunk, cellOf(i), to);
        const auto borrowers =
          std::uint32_t(members.BorrowerStart[i + 1] - members.BorrowerStart[i]);
        std::memcpy(to, &borrowers, 4);
      });
    // For each entry of the borrowers, the cell's index in the chunk.
    std::vector<std::uint32_t> cells;
    for (std::size_t i = 0; i < count; ++i)
    {
      cells.insert(cells.end(),
        std::size_t(members.BorrowerStart[i + 1] - members.BorrowerStart[i]), std::uint32_t(i));
    }
    this->Job.Borrowers->add(
      cells.size(), this->Job.Threads, [&](std::size_t i) { return members.Owner[cells[i]]; },
      [&](std::size_t i, char* to) { std::memcpy(to, &members.Borrowers[i], 4); });
    if (this->Job.BorrowedCells)
    {
      this->Job.BorrowedCells->add(
        cells.size(), this->Job.Threads, [&](std::size_t i) { return members.Borrowers[i]; },
        [&](std::size_t i, char* to) { this->putCell(chunk, cellOf(cells[i]), to); });
    }
    poll();
    this->spillGhostPoints(chunk, first, count, members);
    this->Job.Statistics.BorderCells += std::int64_t(count);
    this->Job.Statistics.BorrowedCells += std::int64_t(cells.size());
  }

  void spillGhostPoints(
    const Chunk& chunk, std::size_t first, std::size_t count, const Membership& members)
  {
    std::vector<GhostPoint> points;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t cell = chunk.Border[first + i];
      for (std::size_t corner = 0; corner < this->Corners; ++corner)
      {
        const std::int64_t point = chunk.Ids[cell * this->Corners + corner];
        const std::int32_t owner = ownerOf(chunk.Owners[cell * this->Corners + corner]);
        if (members.Owner[i] != owner)
        {
          points.push_back({ point, members.Owner[i], 0 });
        }
        const bool lends = this->Job.BorrowedCells.has_value();
        for (std::int64_t b = members.BorrowerStart[i]; lends && b < members.BorrowerStart[i + 1];
             ++b)
        {
          if (members.Borrowers[std::size_t(b)] != owner)
          {
            points.push_back({ point, members.Borrowers[std::size_t(b)], 1 });
          }
        }
      }
    }
    makeDistinct(points);
    this->Job.GhostPoints->add(
      points.size(), this->Job.Threads,
      [&](std::size_t i) { return points[i].Point / this->Job.ChunkPoints; },
      [&](std::size_t i, char* to) { std::memcpy(to, &points[i], sizeof(GhostPoint)); });
  }

  char* putCell(const Chunk& chunk, std::size_t cell, char* to) const
  {
    const RowLayout& rows = this->Job.Rows;
    to = rows.putId(chunk.First + std::int64_t(cell), to);
    for (std::size_t corner = 0; corner < this->Corners; ++corner)
    {
      to = rows.putId(chunk.Ids[cell * this->Corners + corner], to);
    }
    return this->Data.copyRow(cell, to);
  }

  PartitionJob& Job;
  std::size_t Corners;
  ArrayRows Data;
  std::unique_ptr<VertexLoader> OwnerLoader;
  std::unique_ptr<VertexLoader> PointLoader;
};

} // namespace

void distributeCells(PartitionJob& job)
{
  Communicator& ranks = job.Team;
  const std::size_t pieces = job.pieces();
  const std::size_t chunks =
    std::size_t((job.Mesh.Points.Tuples + job.ChunkPoints - 1) / job.ChunkPoints);
  ranks.attempt(
    [&]
    {
      job.Cells.emplace(job.scratch("cells"), ranks.rank(), pieces, job.Rows.CellBytes);
      job.SharedCells.emplace(job.scratch("shared"), ranks.rank(), pieces, job.Rows.CellBytes + 4);
      job.Borrowers.emplace(job.scratch("borrowers"), ranks.rank(), pieces, 4);
      if (job.Options.DuplicateBorrowers)
      {
        job.BorrowedCells.emplace(
          job.scratch("borrowed"), ranks.rank(), pieces, job.Rows.CellBytes);
      }
      job.GhostPoints.emplace(job.scratch("ghosts"), ranks.rank(), chunks, sizeof(GhostPoint));
      CellDistribution(job).run();
    });
  for (std::optional<Spill>* const spill :
    { &job.Cells, &job.SharedCells, &job.Borrowers, &job.GhostPoints, &job.BorrowedCells })
  {
    if (*spill)
    {
      job.Statistics.SpilledBytes += (*spill)->bytes();
      (*spill)->exchange(ranks);
    }
  }
}

namespace
{

/// A copy of a point for a piece.
struct Copy
{
  std::uint32_t Index; ///< the point's index in the chunk
  std::int32_t Piece;
  std::uint64_t Flags;
};

class PointDistribution
{
public:
  explicit PointDistribution(PartitionJob& job)
    : Job(job)
    , Owners(job.owners().Path)
    , Data(columnsOf(job))
  {
  }

  void spillChunk(std::int64_t chunk)
  {
    const std::int64_t first = chunk * this->Job.ChunkPoints;
    const std::int64_t count =
      std::min(this->Job.ChunkPoints, this->Job.Mesh.Points.Tuples - first);
    this->Data.read(first, count, this->Job.Threads);
    const std::vector<Copy> copies = this->copiesOf(chunk, first, count);
    poll();
    this->Job.Statistics.CopiedPoints += std::int64_t(copies.size()) - count;
    this->Job.Points->add(
      copies.size(), this->Job.Threads, [&](std::size_t i) { return copies[i].Piece; },
      [&](std::size_t i, char* to)
      {
        const std::uint64_t id = std::uint64_t(first + copies[i].Index) << 2 | copies[i].Flags;
        std::memcpy(to, &id, 8);
        this->Data.copyRow(copies[i].Index, to + 8);
      });
  }

private:
  static std::vector<RawArray> columnsOf(const PartitionJob& job)
  {
    std::vector<RawArray> columns{ job.Mesh.Points };
    columns.insert(columns.end(), job.PointData.begin(), job.PointData.end());
    return columns;
  }

  std::vector<GhostPoint> ghostPoints(std::int64_t chunk) const
  {
    const std::vector<char> raw = this->Job.GhostPoints->readAll(std::size_t(chunk));
    std::vector<GhostPoint> points(raw.size() / sizeof(GhostPoint));
    if (points.empty())
    {
      return points;
    }
    std::memcpy(points.data(), raw.data(), points.size() * sizeof(GhostPoint));
    makeDistinct(points);
    return points;
  }

  std::vector<Copy> copiesOf(std::int64_t chunk, std::int64_t first, std::int64_t count) const
  {
    std::vector<std::int32_t> owners(static_cast<std::size_t>(count));
    this->Owners.read(std::uint64_t(first) * 4, owners.data(), owners.size() * 4);
    const std::vector<GhostPoint> ghosts = this->ghostPoints(chunk);
    std::vector<Copy> copies;
    copies.reserve(owners.size() + ghosts.size());
    auto next = ghosts.begin();
    for (std::uint32_t i = 0; i < owners.size(); ++i)
    {
      pollAt(i);
      copies.push_back({ i, ownerOf(owners[i]), 0 });
      for (; next != ghosts.end() && next->Point == first + i; ++next)
      {
        const std::uint64_t ghost = next->GhostOnly != 0 ? RowLayout::GhostOnly : 0;
        copies.push_back({ i, next->Piece, RowLayout::Ghost | ghost });
      }
    }
    return copies;
  }

  PartitionJob& Job;
  InputFile Owners;
  ArrayRows Data;
};

} // namespace

void distributePoints(PartitionJob& job)
{
  Communicator& ranks = job.Team;
  ranks.attempt(
    [&]
    {
      job.Points.emplace(job.scratch("points"), ranks.rank(), job.pieces(), job.Rows.PointBytes);
      const std::int64_t chunks = (job.Mesh.Points.Tuples + job.ChunkPoints - 1) / job.ChunkPoints;
      const auto [first, last] = ranks.shareOf(chunks);
      PointDistribution distribution(job);
      for (std::int64_t chunk = first; chunk < last; ++chunk)
      {
        distribution.spillChunk(chunk);
        job.report(0.5 + 0.2 * double(chunk + 1 - first) / double(last - first));
      }
    });
  job.Statistics.SpilledBytes += job.Points->bytes();
  job.Points->exchange(ranks);
}

} // namespace tipp

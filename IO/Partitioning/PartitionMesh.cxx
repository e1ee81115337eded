// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionMesh.h"

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Partitioned/PublishPieces.h"
#include "Partitioning/AssemblePieces.h"
#include "Partitioning/DescribeArrays.h"
#include "Partitioning/DistributeCells.h"
#include "Partitioning/DistributePoints.h"
#include "Partitioning/MakeTiling.h"
#include "Partitioning/PartitionRun.h"
#include "Partitioning/SurveyPoints.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

namespace tipp
{

namespace fs = std::filesystem;

PartitionRun::PartitionRun(const FlatMesh& mesh, const PartitionOptions& options,
  const Ranks& ranks, const std::string& folder)
  : Mesh(mesh)
  , Options(options)
  , Team(ranks)
  , Threads(threadCount(options.Threads))
  , Folder(folder)
{
}

RawArray PartitionRun::homes() const
{
  RawArray array;
  array.Name = "homes";
  array.Path = this->scratch("homes");
  array.Type = Scalar::Int32;
  array.Tuples = this->Mesh.Points.Tuples;
  return array;
}

LoaderOptions PartitionRun::loaderOptions() const
{
  LoaderOptions options = this->Options.Loading;
  options.MemoryLimit = this->Options.MemoryLimit / 4;
  options.Threads = this->Threads;
  return options;
}

void PartitionRun::report(double fraction)
{
  this->Fraction = fraction;
  poll();
}

namespace
{

std::size_t tupleBytes(const std::vector<RawArray>& arrays)
{
  std::size_t bytes = 0;
  for (const RawArray& array : arrays)
  {
    bytes += array.tupleBytes();
  }
  return bytes;
}

void layOutRows(PartitionRun& run)
{
  RowLayout& rows = run.Rows;
  rows.Corners = run.Mesh.CellSize;
  rows.Dimension = run.Mesh.CellSize - 1;
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  rows.IdBytes = std::max(run.Mesh.Points.Tuples, run.Mesh.Cells.Tuples) <= most ? 4 : 8;
  rows.CellData = rows.IdBytes * std::size_t(1 + rows.Corners);
  rows.CellBytes = rows.CellData + tupleBytes(run.CellData);
  rows.PointBytes = 8 + run.Mesh.Points.tupleBytes() + tupleBytes(run.PointData);
}

/// A chunk may take a quarter of the memory limit, like the loader.
void chooseChunks(PartitionRun& run)
{
  const RowLayout& rows = run.Rows;
  const std::uint64_t share = std::max<std::uint64_t>(run.Options.MemoryLimit / 4, 1);
  const std::size_t corners = std::size_t(rows.Corners);
  const std::size_t perCell = corners * 12 + 12 + 2 * rows.CellBytes;
  const std::size_t perPoint = 20 + 2 * rows.PointBytes;
  constexpr std::int64_t most = 1 << 24;
  const auto choose = [&](std::int64_t asked, std::size_t bytes)
  {
    const auto fitting = std::int64_t(share / bytes);
    return asked > 0 ? std::min(asked, most) : std::clamp<std::int64_t>(fitting, 1024, most);
  };
  run.ChunkCells = choose(run.Options.ChunkCells, perCell);
  run.ChunkPoints = choose(run.Options.ChunkPoints, perPoint);
}

/// What the mesh and the spilled rows take at most, but for borders.
std::uint64_t neededBytes(const PartitionRun& run)
{
  const auto points = std::uint64_t(run.Mesh.Points.Tuples);
  const auto cells = std::uint64_t(run.Mesh.Cells.Tuples);
  const auto corners = std::uint64_t(run.Rows.Corners);
  const std::uint64_t spilled = cells * run.Rows.CellBytes + points * (run.Rows.PointBytes + 4);
  const std::uint64_t stored =
    cells * (corners * 4 + 4 + 1 + 8 + 1 + run.Rows.CellBytes - run.Rows.CellData) +
    points * (3 * scalarSize(run.Mesh.Points.Type) + 9 + tupleBytes(run.PointData));
  return spilled + stored;
}

void requireSpace(const PartitionRun& run, const std::string& path)
{
  std::error_code failure;
  const fs::space_info space = fs::space(run.Folder, failure);
  const std::uint64_t needed = neededBytes(run);
  if (!failure && space.available < needed)
  {
    throw IOError(path,
      "needs about " + std::to_string(needed / 1000000 + 1) +
        " MB while it is made, and its disk "
        "has " +
        std::to_string(space.available / 1000000) + " MB free; free space or name another disk.");
  }
}

void cutDomain(PartitionRun& run)
{
  const Box3 domain = surveyPoints(run.Mesh, run.Team, run.Threads);
  // A chunk here has its coordinates in memory twice beside its ids.
  const std::int64_t chunk = std::max<std::int64_t>(1, run.ChunkCells / 4);
  run.Tiling.emplace(makeTiling(
    run.Mesh, run.Options.Tiling, run.loaderOptions(), chunk, run.Threads, run.Team, domain));
  setPieces(run.Result, domain, *run.Tiling);
  writeHomes(run.Mesh, *run.Tiling, run.homes().Path, run.Team, run.Threads);
}

void removeScratch(const PartitionRun& run)
{
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(run.Folder, ignored))
  {
    if (entry.path().filename().string()[0] == '.')
    {
      fs::remove(entry.path(), ignored);
    }
  }
}

void prepare(PartitionRun& run, const std::string& path)
{
  const FlatMesh& mesh = run.Mesh;
  if (mesh.Points.Tuples == 0)
  {
    throw IOError(mesh.Path, "has no points, so there is nothing to partition.");
  }
  PartitionedMesh& result = run.Result;
  result.Path = run.Folder;
  result.CellSize = mesh.CellSize;
  result.PointType = mesh.Points.Type;
  result.Duplicated = run.Options.DuplicateBorrowers;
  result.Points = mesh.Points.Tuples;
  result.Cells = mesh.Cells.Tuples;
  result.Tiling = run.Options.Tiling.text(mesh.CellSize - 1);
  result.Times = mesh.Times;
  const std::vector<RawArray> arrays = describeArrays(mesh, result);
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    (result.Arrays[i].OfPoints ? run.PointData : run.CellData).push_back(arrays[i]);
  }
  layOutRows(run);
  chooseChunks(run);
  requireSpace(run, path);
}

/// The user knows the mesh's name, but not that of its temporary folder.
std::string withName(std::string text, const std::string& folder, const std::string& name)
{
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
  {
    text.replace(at, folder.size(), name);
    at += name.size();
  }
  return text;
}

void completeStatistics(PartitionRun& run)
{
  PartitionStatistics& all = run.Statistics;
  const std::vector<std::int64_t> sums = run.Team.sum({ all.BorderCells, all.BorrowedCells,
    all.CopiedPoints, std::int64_t(all.SpilledBytes), all.Loads.Reads, all.Loads.Bytes,
    all.Loads.UsefulBytes, all.Loads.Passes, all.Loads.CacheMisses });
  all.BorderCells = sums[0];
  all.BorrowedCells = sums[1];
  all.CopiedPoints = sums[2];
  all.SpilledBytes = std::uint64_t(sums[3]);
  all.Loads = { sums[4], sums[5], sums[6], sums[7], sums[8] };
  all.Points = run.Mesh.Points.Tuples;
  all.Cells = run.Mesh.Cells.Tuples;
  all.Pieces = std::int64_t(run.pieces());
  all.Ranks = run.Team.count();
  all.Threads = run.Threads;
}

void runPhases(PartitionRun& run, const std::string& path)
{
  Stopwatch watch;
  const auto endPhase = [&](const char* name) {
    run.Statistics.Phases.push_back({ name, watch.restart() });
  };
  run.Team.attempt([&] { prepare(run, path); });
  cutDomain(run);
  endPhase("tile");
  distributeCells(run);
  endPhase("classify cells");
  distributePoints(run);
  endPhase("distribute points");
  assemblePieces(run);
  endPhase("write pieces");
}

} // namespace

PartitionStatistics partitionMesh(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  const Ranks ranks(controller);
  std::optional<PendingFolder> pending;
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        pending.emplace(path, &replaceableMesh);
        fs::create_directory(pending->temporaryPath() + "/pieces");
      }
    });
  PartitionRun run(mesh, options, ranks, ranks.broadcast(pending ? pending->temporaryPath() : ""));
  const PollScope polled(
    [&run] { return !run.Options.Progress || run.Options.Progress(run.Fraction); });
  try
  {
    runPhases(run, path);
  }
  catch (const WorkAborted&)
  {
    run.Statistics.Aborted = true;
    return run.Statistics;
  }
  catch (const IOError& error)
  {
    throw IOError(withName(error.what(), run.Folder, path));
  }
  Stopwatch watch;
  completeStatistics(run);
  ranks.attempt(
    [&]
    {
      if (pending)
      {
        removeScratch(run);
        pending->commit();
      }
    });
  run.Statistics.Phases.push_back({ "publish", watch.restart() });
  if (ranks.isFirst() && options.Progress)
  {
    // The mesh is already published, so a request to abort is ignored.
    static_cast<void>(options.Progress(1));
  }
  return run.Statistics;
}

} // namespace tipp

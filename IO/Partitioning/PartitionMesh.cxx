// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionMesh.h"

#include "Files/FileSystem.h"
#include "Files/IOError.h"
#include "Files/PendingOutput.h"
#include "Files/TemporaryFiles.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Parallel/Stopwatch.h"
#include "Partitioned/PieceFormat.h"
#include "Partitioned/PieceWriter.h"
#include "Partitioning/MeshTiling.h"
#include "Partitioning/PartitionJob.h"
#include "Ranks/Communicator.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

namespace fs = std::filesystem;

std::vector<RawArray> describeArrays(const FlatMesh& mesh, PartitionedMesh& result)
{
  std::vector<RawArray> arrays;
  std::set<std::pair<bool, std::string>> names{ { true, pointIdsName }, { true, ghostsName },
    { false, cellIdsName }, { false, ghostsName } };
  const auto add = [&](const RawArray& array, bool ofPoints, int step)
  {
    const StoredArray stored{ array.Name, ofPoints, array.Type, array.Components, step };
    if (!names.emplace(ofPoints, storedName(stored)).second)
    {
      throw IOError(mesh.Path,
        "has two arrays named " + storedName(stored) +
          ", or one named as the partitioned mesh names its own; rename it.");
    }
    result.Arrays.push_back(stored);
    arrays.push_back(array);
  };
  for (const bool ofPoints : { true, false })
  {
    for (const RawArray& array : ofPoints ? mesh.PointData : mesh.CellData)
    {
      add(array, ofPoints, -1);
    }
    for (const std::vector<RawArray>& series : ofPoints ? mesh.PointSeries : mesh.CellSeries)
    {
      for (std::size_t step = 0; step < series.size(); ++step)
      {
        add(series[step], ofPoints, int(step));
      }
    }
  }
  return arrays;
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

void layOutRows(PartitionJob& job)
{
  RowLayout& rows = job.Rows;
  rows.Corners = job.Mesh.CellSize;
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  rows.IdBytes = std::max(job.Mesh.Points.Tuples, job.Mesh.Cells.Tuples) <= most ? 4 : 8;
  rows.CellData = rows.IdBytes * std::size_t(1 + rows.Corners);
  rows.CellBytes = rows.CellData + tupleBytes(job.CellData);
  rows.PointBytes = 8 + job.Mesh.Points.tupleBytes() + tupleBytes(job.PointData);
}

/// A chunk may take a quarter of the memory limit, like the loader.
void chooseChunks(PartitionJob& job)
{
  const RowLayout& rows = job.Rows;
  const std::uint64_t share = std::max<std::uint64_t>(job.Options.MemoryLimit / 4, 1);
  const std::size_t corners = std::size_t(rows.Corners);
  const std::size_t perCell = corners * 12 + 12 + 2 * rows.CellBytes;
  const std::size_t perPoint = 20 + 2 * rows.PointBytes;
  constexpr std::int64_t most = 1 << 24;
  const auto choose = [&](std::int64_t asked, std::size_t bytes)
  {
    const auto fitting = std::int64_t(share / bytes);
    return asked > 0 ? std::min(asked, most) : std::clamp<std::int64_t>(fitting, 1024, most);
  };
  job.ChunkCells = choose(job.Options.ChunkCells, perCell);
  job.ChunkPoints = choose(job.Options.ChunkPoints, perPoint);
}

/// An upper bound of the bytes of the mesh and the spilled rows, without those at borders.
std::uint64_t neededBytes(const PartitionJob& job)
{
  const auto points = std::uint64_t(job.Mesh.Points.Tuples);
  const auto cells = std::uint64_t(job.Mesh.Cells.Tuples);
  const auto corners = std::uint64_t(job.Rows.Corners);
  const std::uint64_t spilled = cells * job.Rows.CellBytes + points * (job.Rows.PointBytes + 4);
  const std::uint64_t stored =
    cells * (corners * 4 + 4 + 1 + 8 + 1 + job.Rows.CellBytes - job.Rows.CellData) +
    points * (3 * scalarSize(job.Mesh.Points.Type) + 9 + tupleBytes(job.PointData));
  return spilled + stored;
}

void cutDomain(PartitionJob& job)
{
  const Box3 domain = boundsOfPoints(job.Mesh, job.Team, job.Threads);
  // Here a chunk needs memory for its ids and for two copies of its coordinates.
  const std::int64_t chunk = std::max<std::int64_t>(1, job.ChunkCells / 4);
  job.Tiling.emplace(makeTiling(
    job.Mesh, job.Options.Tiling, job.loaderOptions(), chunk, job.Threads, job.Team, domain));
  setPieces(job.Result, domain, *job.Tiling);
  writeOwners(job.Mesh, *job.Tiling, job.owners().Path, job.Team, job.Threads);
}

void removeScratch(const PartitionJob& job)
{
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(job.Folder, ignored))
  {
    if (entry.path().filename().string()[0] == '.')
    {
      fs::remove(entry.path(), ignored);
    }
  }
}

void prepare(PartitionJob& job, const std::string& path)
{
  const FlatMesh& mesh = job.Mesh;
  if (mesh.Points.Tuples == 0)
  {
    throw IOError(mesh.Path, "has no points, so there is nothing to partition.");
  }
  PartitionedMesh& result = job.Result;
  result.Path = job.Folder;
  result.CellSize = mesh.CellSize;
  result.PointType = mesh.Points.Type;
  result.Duplicated = job.Options.DuplicateBorrowers;
  result.Points = mesh.Points.Tuples;
  result.Cells = mesh.Cells.Tuples;
  result.Tiling = job.Options.Tiling.text(mesh.CellSize - 1);
  result.Times = mesh.Times;
  const std::vector<RawArray> arrays = describeArrays(mesh, result);
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    (result.Arrays[i].OfPoints ? job.PointData : job.CellData).push_back(arrays[i]);
  }
  layOutRows(job);
  chooseChunks(job);
  requireFreeSpace(path, job.Folder, neededBytes(job));
}

/// Replaces the temporary folder's path in a message by the mesh's name, which the user knows.
std::string withName(std::string text, const std::string& folder, const std::string& name)
{
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
  {
    text.replace(at, folder.size(), name);
    at += name.size();
  }
  return text;
}

void completeStatistics(PartitionJob& job)
{
  PartitionStatistics& all = job.Statistics;
  std::vector<std::int64_t> sums = { all.BorderCells, all.BorrowedCells, all.CopiedPoints,
    std::int64_t(all.SpilledBytes), all.Loads.Reads, all.Loads.Bytes, all.Loads.UsefulBytes,
    all.Loads.Passes };
  job.Team.sum(sums);
  all.BorderCells = sums[0];
  all.BorrowedCells = sums[1];
  all.CopiedPoints = sums[2];
  all.SpilledBytes = std::uint64_t(sums[3]);
  all.Loads = { sums[4], sums[5], sums[6], sums[7] };
  all.Points = job.Mesh.Points.Tuples;
  all.Cells = job.Mesh.Cells.Tuples;
  all.Pieces = std::int64_t(job.pieces());
  all.Ranks = job.Team.size();
  all.Threads = job.Threads;
}

void runPhases(PartitionJob& job, const std::string& path)
{
  Stopwatch watch;
  const auto endPhase = [&](const char* name) {
    job.Statistics.Phases.push_back({ name, watch.restart() });
  };
  job.Team.attempt([&] { prepare(job, path); });
  cutDomain(job);
  endPhase("tile");
  distributeCells(job);
  endPhase("classify cells");
  distributePoints(job);
  endPhase("distribute points");
  writePieces(job);
  endPhase("write pieces");
}

} // namespace

PartitionStatistics partitionMesh(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  if (options.Neighbors)
  {
    return partitionWithNeighbors(mesh, path, options, controller);
  }
  Communicator ranks(controller);
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
  PartitionJob job(mesh, options, ranks, ranks.broadcast(pending ? pending->temporaryPath() : ""));
  const PollScope polled(
    [&job] { return !job.Options.Progress || job.Options.Progress(job.Fraction); });
  try
  {
    runPhases(job, path);
  }
  catch (const WorkAborted&)
  {
    job.Statistics.Aborted = true;
    return job.Statistics;
  }
  catch (const IOError& error)
  {
    throw IOError(withName(error.what(), job.Folder, path));
  }
  Stopwatch watch;
  completeStatistics(job);
  ranks.attempt(
    [&]
    {
      if (pending)
      {
        removeScratch(job);
        pending->commit();
      }
    });
  job.Statistics.Phases.push_back({ "publish", watch.restart() });
  if (ranks.isFirst() && options.Progress)
  {
    // The mesh is already published, so a request to abort is ignored.
    static_cast<void>(options.Progress(1));
  }
  return job.Statistics;
}

namespace
{

/// Removes the ids of the partitioned mesh that the data set was read from: the new one gets its
/// own.
void removeOwnIds(FlatContent& content)
{
  const auto drop = [](std::vector<FlatArray>& arrays, const std::string& name)
  {
    arrays.erase(std::remove_if(arrays.begin(), arrays.end(),
                   [&](const FlatArray& array) { return array.Name == name; }),
      arrays.end());
  };
  drop(content.PointData, pointIdsName);
  drop(content.CellData, cellIdsName);
}

/// Replaces paths in the temporary flat mesh by the input's name.
std::string inNameOf(std::string message, const std::string& folder, const std::string& name)
{
  const std::size_t begin = message.find(folder);
  if (begin != std::string::npos)
  {
    const std::size_t end = std::min(message.find_first_of(":,", begin), message.size());
    message.replace(begin, end - begin, name);
  }
  return message;
}

} // namespace

PartitionStatistics partitionInMemory(const std::function<FlatContent()>& make,
  const std::string& name, const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  const PollScope polled([&options] { return !options.Progress || options.Progress(0); });
  // Removed with this object, or by the next run if this one is killed.
  std::optional<PendingFolder> scratch;
  std::string folder;
  std::string shown; // its path in messages, as the first rank shows it
  try
  {
    ranks.attempt(
      [&]
      {
        if (ranks.isFirst())
        {
          scratch.emplace(output, &replaceableMesh);
          folder = scratch->temporaryPath() + "/flat";
          shown = shownPath(folder);
          FlatContent content = make();
          removeOwnIds(content);
          try
          {
            writeFlatMesh(folder, content);
          }
          catch (const IOError& error) // for example, the disk is full
          {
            throw IOError(inNameOf(error.what(), shown, output));
          }
        }
      });
  }
  catch (const WorkAborted&)
  {
    PartitionStatistics statistics;
    statistics.Aborted = true;
    return statistics;
  }
  folder = ranks.broadcast(folder);
  shown = ranks.broadcast(shown);
  try
  {
    FlatMesh mesh;
    ranks.attempt([&] { mesh = openFlatMesh(folder); });
    return partitionMesh(mesh, output, options, controller);
  }
  catch (const IOError& error)
  {
    throw IOError(inNameOf(inNameOf(error.what(), folder, name), shown, name));
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionMesh.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Files/RequireApart.h"
#include "Files/TemporaryPaths.h"
#include "Npy/NpyFile.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Partitioned/FinishedPieces.h"
#include "Partitioned/PieceFormat.h"
#include "Partitioning/MeshTiling.h"
#include "Partitioning/PartitionJob.h"
#include "Ranks/Communicator.h"
#include "Resident/PieceNeighbors.h"
#include "Series/MeshSeries.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>

namespace tipp
{

namespace fs = std::filesystem;

std::vector<RawArray> describeArrays(const FlatMesh& mesh, PartitionedMesh& result)
{
  result.Description = mesh.Description;
  std::vector<RawArray> arrays;
  const auto add = [&](const RawArray& array, bool ofPoints, int step)
  {
    result.Arrays.push_back({ array.Name, ofPoints, array.Type, array.Components, step });
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
  if (const std::string name = repeatedName(result.Arrays); !name.empty())
  {
    throw IOError(mesh.Path,
      "has two arrays named " + name +
        ", or one named as the partitioned mesh names its own; rename it.");
  }
  return arrays;
}

RawArray PartitionJob::owners() const
{
  return { "owners", this->scratch("owners"), 0, Scalar::Int32, 1, this->Mesh.Points.Tuples };
}

LoaderOptions PartitionJob::loaderOptions() const
{
  LoaderOptions options = this->Options.Loading;
  options.MemoryLimit = this->Options.MemoryLimit / 4;
  options.Threads = this->Threads;
  return options;
}

void PartitionJob::report(double fraction)
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

void layOutRows(PartitionJob& job)
{
  RowLayout& rows = job.Rows;
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  rows.IdBytes = std::max(job.Mesh.Points.Tuples, job.Mesh.Cells.Tuples) <= most ? 4 : 8;
  rows.CellData = rows.IdBytes * std::size_t(1 + job.Mesh.CellSize);
  rows.CellBytes = rows.CellData + tupleBytes(job.CellData);
  rows.PointBytes = 8 + job.Mesh.Points.tupleBytes() + tupleBytes(job.PointData);
}

/// A chunk may take a quarter of the memory limit, like the loader.
void chooseChunks(PartitionJob& job)
{
  const RowLayout& rows = job.Rows;
  const std::uint64_t share = std::max<std::uint64_t>(job.Options.MemoryLimit / 4, 1);
  const std::size_t corners = std::size_t(job.Mesh.CellSize);
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
  const auto corners = std::uint64_t(job.Mesh.CellSize);
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
  if (job.Team.isFirst())
  {
    fs::create_directory(job.Folder + "/pieces");
  }
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

template <typename Array>
void dropNamed(const std::string& name, std::vector<Array>& arrays)
{
  arrays.erase(std::remove_if(arrays.begin(), arrays.end(),
                 [&](const Array& array) { return array.Name == name; }),
    arrays.end());
}

/// Creates the output's hidden folder on the first rank; returns null on the others. If it is not
/// committed, the returned object's destructor removes it, or the next run if this one is killed.
/// Collective.
std::unique_ptr<PendingFolder> makeFolder(const std::string& output, Communicator& ranks)
{
  std::unique_ptr<PendingFolder> folder;
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        requireFolderName(output);
        folder = std::make_unique<PendingFolder>(output, &replaceableMesh);
      }
    });
  return folder;
}

/// Options for a part of the work.
PartitionOptions stepOf(const PartitionOptions& options, double begin, double end)
{
  PartitionOptions part = options;
  part.Neighbors = false;
  part.Progress = partOf(options.Progress, begin, end);
  return part;
}

/// Writes the neighbours of all cells of a stored mesh as an .npy file.
void writeNeighbors(
  const std::string& stored, const std::string& path, const PartitionOptions& options)
{
  ResidentOptions resident;
  resident.MemoryLimit = options.MemoryLimit;
  resident.Threads = options.Threads;
  const ResidentMesh mesh(stored, resident);
  const int corners = mesh.mesh().CellSize;
  const std::string start = npyFileStart("<i8", { mesh.mesh().Cells, corners });
  OutputFile file(path);
  file.write(0, start.data(), start.size());
  for (std::size_t piece = 0; piece < mesh.mesh().Pieces.size(); ++piece)
  {
    poll();
    const OwnedNeighbors owned = neighborsInPiece(mesh, piece);
    const std::size_t bytes = std::size_t(corners) * sizeof(std::int64_t);
    for (std::size_t begin = 0; begin < owned.Cells.size();)
    {
      std::size_t end = begin + 1; // of a run of consecutive ids
      while (end < owned.Cells.size() && owned.Cells[end] == owned.Cells[end - 1] + 1)
      {
        ++end;
      }
      file.write(start.size() + std::uint64_t(owned.Cells[begin]) * bytes,
        owned.Neighbors.data() + begin * std::size_t(corners), (end - begin) * bytes);
      begin = end;
    }
  }
  file.close();
}

/// partitionMesh() with the additional array NeighborIds. Neighbours can be found once the mesh is
/// partitioned. So first only its cells and points are partitioned, into a scratch folder beside
/// the output. The first rank then finds the neighbours piece by piece and writes their ids to a
/// scratch file, 8 bytes per corner. Finally the mesh is partitioned with that file as one more
/// array.
PartitionStatistics partitionWithNeighbors(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  const std::unique_ptr<PendingFolder> scratch = makeFolder(path, ranks);
  const std::string folder = ranks.broadcast(scratch ? scratch->workPath() : std::string());
  const FlatMesh bare{ mesh.Path, mesh.CellSize, mesh.Cells, mesh.Points, {}, {}, {}, {}, {} };
  PartitionOptions first = stepOf(options, 0, 0.3);
  first.DuplicateBorrowers = false;
  PartitionStatistics statistics = partitionMesh(bare, folder + "/bare", first, controller);
  if (statistics.Aborted)
  {
    return statistics;
  }
  const std::string file = folder + "/neighbors/NeighborIds.npy";
  FlatMesh whole = mesh;
  try
  {
    const PollScope polled([&options] { return !options.Progress || options.Progress(0.3); });
    ranks.attempt(
      [&]
      {
        if (ranks.isFirst())
        {
          fs::create_directory(folder + "/neighbors");
          writeNeighbors(folder + "/bare", file, options);
        }
      });
    const std::size_t start = npyFileStart("<i8", { mesh.Cells.Tuples, mesh.CellSize }).size();
    dropNamed(neighborIdsArray.Name, whole.CellData);
    whole.CellData.push_back(
      { neighborIdsArray.Name, file, start, Scalar::Int64, mesh.CellSize, mesh.Cells.Tuples });
  }
  catch (const WorkAborted&)
  {
    statistics.Aborted = true;
    return statistics;
  }
  return partitionMesh(whole, path, stepOf(options, 0.5, 1), controller);
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

PartitionStatistics partitionMesh(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  if (options.Neighbors)
  {
    return partitionWithNeighbors(mesh, path, options, controller);
  }
  Communicator ranks(controller);
  const std::unique_ptr<PendingFolder> pending = makeFolder(path, ranks);
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

PartitionStatistics partitionInMemory(const std::function<FlatContent()>& make,
  const std::string& name, const std::string& output, const PartitionOptions& options,
  vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  const PollScope polled([&options] { return !options.Progress || options.Progress(0); });
  const std::unique_ptr<PendingFolder> scratch = makeFolder(output, ranks);
  std::string folder;
  std::string shown; // its path in messages, as the first rank shows it
  try
  {
    ranks.attempt(
      [&]
      {
        if (ranks.isFirst())
        {
          folder = scratch->temporaryPath() + "/flat";
          shown = shownPath(folder);
          FlatContent content = make();
          // Content read from a partitioned mesh has that mesh's ids; the new mesh gets its own.
          dropNamed(pointIdsName, content.PointData);
          dropNamed(cellIdsName, content.CellData);
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

namespace
{

/// Partitions the output of a model, which the first rank reads step by step.
PartitionStatistics partitionSeries(const std::string& input, const std::string& output,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  std::unique_ptr<MeshSeries> series; // its content is read while it is written
  const auto make = [&]
  {
    series = openMeshSeries(input, options.Model);
    return flattenSeries(*series);
  };
  PartitionStatistics statistics = partitionInMemory(make, input, output, options, controller);
  if (series)
  {
    statistics.VariablesLeftOut = series->LeftOut;
  }
  return statistics;
}

} // namespace

PartitionStatistics partitionInput(const std::string& input, const std::string& output,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  FlatMesh mesh;
  bool isFlat = true;
  bool isSeries = false;
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        std::vector<std::string> inputs = options.Model.Values;
        inputs.push_back(input);
        requireApart({ output }, inputs);
        requireFolderName(output);
        // fails early if the output cannot be written
        const PendingFolder writable(output, &replaceableMesh);
        isSeries = isMeshSeries(input);
      }
    });
  if (ranks.broadcast(isSeries))
  {
    return partitionSeries(input, output, options, controller);
  }
  ranks.attempt(
    [&]
    {
      isFlat = isFlatMesh(input) || !isOpenedBy(input, Opener::Vtk);
      if (isFlat)
      {
        mesh = openFlatMesh(input);
        requireNoOtherCells(mesh);
      }
    });
  return isFlat ? partitionMesh(mesh, output, options, controller)
                : partitionVtkFile(input, output, options, controller);
}

} // namespace tipp

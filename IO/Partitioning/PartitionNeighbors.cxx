// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionMesh.h"

#include "Files/OutputFile.h"
#include "Npy/NpyFile.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Partitioned/NeighborIds.h"
#include "Partitioned/PieceWriter.h"
#include "Query/Around.h"
#include "Query/ResidentMesh.h"
#include "Ranks/Communicator.h"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace tipp
{
namespace
{

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

} // namespace

PartitionStatistics partitionWithNeighbors(const FlatMesh& mesh, const std::string& path,
  const PartitionOptions& options, vtkMultiProcessController* controller)
{
  Communicator ranks(controller);
  // Removed with this object, or by the next run if this one is killed.
  std::optional<PendingFolder> scratch;
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        scratch.emplace(path, &replaceableMesh);
        std::filesystem::create_directory(scratch->workPath() + "/neighbors");
      }
    });
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
          writeNeighbors(folder + "/bare", file, options);
        }
      });
    const std::size_t start = npyFileStart("<i8", { mesh.Cells.Tuples, mesh.CellSize }).size();
    whole.CellData.erase(std::remove_if(whole.CellData.begin(), whole.CellData.end(),
                           [](const RawArray& a) { return a.Name == neighborIdsArray.Name; }),
      whole.CellData.end());
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

} // namespace tipp

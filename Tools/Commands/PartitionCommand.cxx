// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/OutputPath.h"
#include "Files/PendingOutput.h"
#include "Partitioning/PartitionMesh.h"
#include "Ranks/Communicator.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

namespace tipp
{
namespace
{

/// Returns the summary, one line.
std::string summarize(const PartitionStatistics& statistics)
{
  return fmt::format("{} cells, {} points, {} pieces, {} borrowed cells, {:.0f} MB, {:.3f} s, peak "
                     "memory {:.0f} MB",
    statistics.Cells, statistics.Points, statistics.Pieces, statistics.BorrowedCells,
    double(statistics.MeshBytes) / 1e6, totalSeconds(statistics.Phases),
    double(peakMemoryBytes()) / 1e6);
}

/// Writes a JSON file. Throws IOError.
void writeReport(const std::string& path, const std::string& input, const std::string& output,
  const PartitionStatistics& statistics)
{
  const LoadCounters& loads = statistics.Loads;
  nlohmann::ordered_json json = {
    { "input", input },
    { "output", output },
    { "points", statistics.Points },
    { "cells", statistics.Cells },
    { "pieces", statistics.Pieces },
    { "border_cells", statistics.BorderCells },
    { "borrowed_cells", statistics.BorrowedCells },
    { "copied_points", statistics.CopiedPoints },
    { "spilled_bytes", statistics.SpilledBytes },
    { "mesh_bytes", statistics.MeshBytes },
    { "seconds", totalSeconds(statistics.Phases) },
    { "peak_memory_bytes", peakMemoryBytes() },
    { "ranks", statistics.Ranks },
    { "threads", statistics.Threads },
    { "loader", statistics.Loader },
    { "loads",
      { { "reads", loads.Reads }, { "bytes", loads.Bytes }, { "useful_bytes", loads.UsefulBytes },
        { "passes", loads.Passes } } },
    { "phases", nlohmann::ordered_json::array() },
  };
  for (const PartitionStatistics::Phase& phase : statistics.Phases)
  {
    json["phases"].push_back({ { "name", phase.Name }, { "seconds", phase.Seconds } });
  }
  writeJson(path, json);
}

constexpr const char* footer =
  R"(INPUT   a flat mesh: a folder of cells.npy, points.npy, point_data/NAME.npy and
        cell_data/NAME.npy, or a .vtu with appended, raw, uncompressed data, read in
        place whatever its size; or any VTK file of triangles or tetrahedra that
        fits in memory.
MESH    a folder: mesh.pvtu, which ParaView and vtkXMLPUnstructuredGridReader read,
        the pieces, and an index. An existing partitioned mesh is replaced when the new
        one is complete.

A cell belongs to the first partition that it meets; the other partitions it meets
borrow it, by reference or as ghost cells in their own pieces. Under mpirun all ranks
share the work, and the files are the same. Ctrl-C stops the run with exit code 130 and
no output. --memory is the limit of each rank, in bytes or such as 512M (2^20 bytes) or
2G.

Examples:
  tipp partition mesh -o mesh.tipp --tiling grid:8x8
  tipp partition mesh.vtu -o mesh.tipp --tiling quadtree:100000 --memory 512M
  mpirun -np 4 tipp partition mesh -o mesh.tipp --borrowers duplicate
)";

struct PartitionArguments
{
  std::string Input;
  std::string Output;
  std::string Tiling = "grid:4x4";
  std::string Borrowers = "reference";
  bool Neighbors = false;
  std::string Memory = "2G";
  std::string Loader = "auto";
  std::string Device = "openmp";
  int Threads = 0;
  std::string Statistics;
};

std::string checkTiling(const std::string& text)
{
  return TilingChoice::parse(text)
    ? ""
    : "'" + text + "' is neither grid:COLUMNSxROWS[xLAYERS] of 1 to 10000 each nor quadtree:CELLS";
}

PartitionOptions makeOptions(
  const PartitionArguments& arguments, const std::unique_ptr<ProgressBar>& bar)
{
  PartitionOptions options;
  options.Tiling = *TilingChoice::parse(arguments.Tiling);
  options.DuplicateBorrowers = arguments.Borrowers == "duplicate";
  options.Neighbors = arguments.Neighbors;
  options.MemoryLimit = *parseMemorySize(arguments.Memory);
  options.Loading.Kind = loaderFromName(arguments.Loader);
  options.Device = parseDeviceChoice(arguments.Device);
  options.Threads = arguments.Threads;
  options.Progress = progressOn(bar);
  return options;
}

int runPartition(const PartitionArguments& arguments)
{
  const MpiSession session;
  PartitionStatistics statistics;
  try
  {
    // Check the paths before the computation. A failure on one rank fails on all.
    Communicator(session.controller())
      .attempt(
        [&]
        {
          if (session.isFirst() && !arguments.Statistics.empty())
          {
            requireApart({ arguments.Output, arguments.Statistics }, { arguments.Input });
            const PendingFile writable(arguments.Statistics);
          }
        });
    const auto bar = session.isFirst() ? std::make_unique<ProgressBar>("Partitioning") : nullptr;
    statistics = partitionInput(
      arguments.Input, arguments.Output, makeOptions(arguments, bar), session.controller());
  }
  catch (const std::exception&)
  {
    return reportFailure();
  }
  if (statistics.Aborted)
  {
    return reportInterrupt();
  }
  if (session.isFirst())
  {
    if (!arguments.Statistics.empty())
    {
      writeReport(arguments.Statistics, arguments.Input, arguments.Output, statistics);
    }
    fmt::print("{}\n", summarize(statistics));
  }
  return Success;
}

} // namespace

void addPartitionCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<PartitionArguments>();
  CLI::App* const command =
    app.add_subcommand("partition", "Cuts a mesh larger than memory into pieces on the disk");
  command->add_option("input", arguments->Input, "The mesh")->required();
  command->add_option("-o,--output", arguments->Output, "The partitioned mesh, such as mesh.tipp")
    ->required();
  command
    ->add_option("--tiling", arguments->Tiling,
      "grid:COLUMNSxROWS[xLAYERS]; or quadtree:CELLS (octree:CELLS): partitions are divided until "
      "each meets at most CELLS cells that are not longer than the partition")
    ->check(checkTiling)
    ->capture_default_str();
  command
    ->add_option("--borrowers", arguments->Borrowers,
      "reference: borrowed cells are only in their owners' pieces; duplicate: they are also copied "
      "to the pieces that borrow them")
    ->check(CLI::IsMember({ "reference", "duplicate" }))
    ->capture_default_str();
  command->add_flag("--neighbors", arguments->Neighbors,
    "Add the cell array NeighborIds: the id of the cell across each edge or face; this partitions "
    "the mesh twice");
  command->add_option("--memory", arguments->Memory, "The memory limit of each rank, such as 512M")
    ->check(checkMemorySize)
    ->capture_default_str();
  command
    ->add_option("--loader", arguments->Loader,
      "How vertices are read: direct: Direct Load; fine: with smaller reads; mmap: mapped files; "
      "auto: chosen automatically")
    ->check(CLI::IsMember({ "auto", "direct", "fine", "mmap" }))
    ->capture_default_str();
  command
    ->add_option("--device", arguments->Device,
      "The device that classifies cells at borders: openmp, opencl, opencl:NAME or auto")
    ->capture_default_str();
  addThreadsOption(*command, arguments->Threads);
  command->add_option("--stats", arguments->Statistics, "A JSON file for figures of the run");
  command->footer(footer);
  command->callback([arguments, &exitCode]() { exitCode = runPartition(*arguments); });
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/SeriesReport.h"
#include "Commands/VtkFiles.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Files/RequireApart.h"
#include "Flat/FlatMesh.h"
#include "Flat/FlatSeries.h"
#include "Flat/FlatUgrid.h"
#include "Flat/FlattenDataSet.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/WriteVtkHdf.h"
#include "Partitioning/FlattenPieces.h"
#include "Partitioning/PartitionMesh.h"
#include "Ranks/Communicator.h"
#include "Raster/RasterFile.h"
#include "Series/MeshSeries.h"
#include "Series/WriteUgrid.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* flattenFooter =
  R"(INPUT   any VTK file, which is read into memory, or a mesh of ADCIRC (.14, .grd), SCHISM
        (.gr3), SMS (.2dm), Gmsh (.msh) or Triangle (.node, .ele), or the output of a
        model: SELAFIN (.slf), or NetCDF (.nc) by UGRID, ADCIRC, SCHISM, FVCOM, FESOM
        or MPAS. Its time steps are read one after another.
        A partitioned mesh (.tipp) or, for .nc, a flat mesh.
OUTPUT  a folder that does not exist yet: cells.npy, points.npy, point_data/NAME.npy, cell_data/NAME.npy and, for
        values that vary in time, time.npy; description.json states units, the calendar and
        the reference system. Or a mesh of triangles in NetCDF by UGRID (.nc).
        Or, of a partitioned mesh of any size, a VTKHDF file (.vtkhdf) with a partition
        for each piece and all time steps; one array of a piece is in memory at a time.

Other cells are cut into triangles or tetrahedra. Cells of a lower dimension, ghost
cells and arrays of strings are left out. The command reports the cells that it has cut
or left out. A .vtu file with appended, raw, uncompressed triangles or tetrahedra can
be used directly: other commands read its data where they are in the file.

Examples:
  tipp flatten bracket.vtu -o bracket
  tipp flatten fort.14 -o surge --values fort.63 --values maxele.63
  tipp flatten fort.63.nc -o surge
  tipp flatten mesh.tipp -o mesh.nc --crs EPSG:32617
  tipp flatten mesh.tipp -o mesh.vtkhdf
  tipp flatten fesom.mesh.diag.nc -o sst --values sst.1948.nc --wrap
)";

/// Adds --values and --wrap.
void addModelOptions(CLI::App& command, SeriesOptions& model)
{
  command.add_option("--values", model.Values,
    "With a mesh of a model: files of values at its nodes or cells: ASCII output of ADCIRC "
    "(fort.63, maxele.63 ...), datasets of SMS (.dat), or NetCDF");
  command.add_flag("--wrap", model.Wrap,
    "With a mesh of a model in degrees: cells that cross the meridian at which longitudes jump are "
    "on either side of it; without this they are an error");
}

/// Throws CLI::ValidationError for --values or --wrap with an input of another kind.
void requireModel(const std::string& input, const SeriesOptions& model)
{
  if ((!model.Values.empty() || model.Wrap) && !isMeshSeries(input))
  {
    throw CLI::ValidationError(
      "--values and --wrap need the mesh of a model (.nc, .slf, .2dm, .14, .grd, .gr3)");
  }
}

struct FlattenArguments
{
  std::string Input;
  std::string Output;
  SeriesOptions Model;
  std::string Crs;
  PathState Before; ///< of the output, if it is a file
};

bool isNetcdf(const FlattenArguments& arguments)
{
  return openerOf(arguments.Output, Use::WritesTriangles) == Opener::Netcdf;
}

bool isVtkHdf(const FlattenArguments& arguments)
{
  return extensionOf(arguments.Output) == ".vtkhdf";
}

/// `leftOut` and `ghostCells`: as in Flattened.
void warnOfCellsLeftOut(const std::string& input,
  const std::map<std::string, std::int64_t>& leftOut, std::int64_t ghostCells)
{
  for (const auto& [name, count] : leftOut)
  {
    fmt::print(stderr, "tipp: warning: {}: {} of {} left out.\n", input, count, name);
  }
  if (ghostCells > 0)
  {
    fmt::print(stderr, "tipp: warning: {}: {} ghost cells left out.\n", input, ghostCells);
  }
}

void reportCut(const FlattenArguments& arguments, const Flattened& flattened)
{
  for (const auto& [name, count] : flattened.Cut)
  {
    fmt::print("{} cells {} were cut.\n", count, name);
  }
  warnOfCellsLeftOut(arguments.Input, flattened.LeftOut, flattened.GhostCells);
  for (const std::string& name : flattened.ArraysLeftOut)
  {
    fmt::print(stderr, "tipp: warning: {}: array '{}' holds no numbers and is left out.\n",
      arguments.Input, name);
  }
}

/// Writes the file. Returns the exit code.
int writeFile(const FlattenArguments& arguments, UgridContent content)
{
  content.Crs = arguments.Crs.empty() ? content.Crs : arguments.Crs;
  if (!writeUgrid(arguments.Output, content, arguments.Before, isInterrupted))
  {
    return reportInterrupt();
  }
  fmt::print("{} triangles, {} points, {}{} in {}\n", content.Triangles, content.Nodes,
    counted(std::int64_t(content.Arrays.size()), "array", "arrays"),
    content.Times.empty() ? "" : fmt::format(", {} steps", content.Times.size()), arguments.Output);
  return Success;
}

/// Writes the folder or file. Returns the exit code.
int writeContent(const FlattenArguments& arguments, const FlatContent& content)
{
  if (isNetcdf(arguments))
  {
    return writeFile(arguments, ugridOf(content, arguments.Input));
  }
  if (!writeFlatMesh(arguments.Output, content, isInterrupted))
  {
    return reportInterrupt();
  }
  fmt::print("{} {}, {} points, {}{} in {}\n", content.Cells.size() / std::size_t(content.CellSize),
    content.CellSize == 3 ? "triangles" : "tetrahedra", content.Points.Tuples,
    counted(std::int64_t(content.PointData.size() + content.CellData.size()), "array", "arrays"),
    content.Times.empty() ? "" : fmt::format(", {} steps", content.Times.size()), arguments.Output);
  return Success;
}

int flattenModelOutput(const FlattenArguments& arguments)
{
  const auto series = isMeshSeries(arguments.Input)
    ? openMeshSeries(arguments.Input, arguments.Model)
    : openFlatSeries(arguments.Input);
  const int code = isNetcdf(arguments) ? writeFile(arguments, ugridOf(*series))
                                       : writeContent(arguments, flattenSeries(*series));
  if (code == Success)
  {
    warnOfVariablesLeftOut(series->Path, series->LeftOut);
  }
  return code;
}

/// Checks the paths before the computation.
void checkPaths(FlattenArguments& arguments)
{
  std::vector<std::string> inputs = arguments.Model.Values;
  inputs.push_back(arguments.Input);
  if (isNetcdf(arguments) || isVtkHdf(arguments))
  {
    if (isPartitionedMesh(arguments.Output))
    {
      throw IOError(arguments.Output, "is part of a partitioned mesh; name another file.");
    }
    arguments.Before = requireWritable(arguments.Output, "", inputs);
    return;
  }
  requireApart({ arguments.Output }, inputs);
  requireFolderName(arguments.Output);
  const PendingFolder writable(arguments.Output);
}

/// Writes the file. Returns the exit code.
int writePartitions(const FlattenArguments& arguments)
{
  if (!isPartitionedMesh(arguments.Input))
  {
    throw IOError(arguments.Input,
      "is not a partitioned mesh, of which alone a .vtkhdf file is made; partition it first, as "
      "with 'tipp partition'.");
  }
  const PartitionedMesh mesh = openPartitionedMesh(arguments.Input);
  if (!writeVtkHdf(mesh, arguments.Output, arguments.Before, isInterrupted))
  {
    return reportInterrupt();
  }
  fmt::print("{} {}, {} points, {} partitions{} in {}\n", mesh.Cells,
    mesh.CellSize == 3 ? "triangles" : "tetrahedra", mesh.Points, mesh.Pieces.size(),
    mesh.Times.empty() ? "" : fmt::format(", {} steps", mesh.Times.size()), arguments.Output);
  if (!mesh.Description.isEmpty())
  {
    fmt::print(stderr,
      "tipp: warning: {}: VTKHDF does not state units, the reference system and missing values, "
      "which become numbers; the partitioned mesh keeps them.\n",
      shownPath(arguments.Output));
  }
  return Success;
}

int runFlatten(FlattenArguments& arguments)
{
  checkPaths(arguments);
  if (isVtkHdf(arguments))
  {
    return writePartitions(arguments);
  }
  if (!arguments.Crs.empty())
  {
    requireCrs(arguments.Crs);
  }
  const bool isFolder = isFlatMesh(arguments.Input) && !isOpenedBy(arguments.Input, Opener::Vtk);
  if (isFolder && !isNetcdf(arguments))
  {
    throw IOError(arguments.Input, "is a flat mesh already; use it as it is, or write .nc.");
  }
  if (isMeshSeries(arguments.Input) || (isFolder && isNetcdf(arguments)))
  {
    return flattenModelOutput(arguments);
  }
  if (isPartitionedMesh(arguments.Input))
  {
    const PartitionedMesh mesh = openPartitionedMesh(arguments.Input);
    return writeContent(arguments, flattenPieces(mesh));
  }
  int code = Success;
  flattenVtkFile(arguments.Input,
    [&](const Flattened& flattened)
    {
      code = writeContent(arguments, flattened.Content);
      if (code == Success)
      {
        reportCut(arguments, flattened);
      }
    });
  return code;
}

void addOptions(CLI::App& command, FlattenArguments& arguments)
{
  command.add_option("input", arguments.Input, "The mesh")->required();
  command
    .add_option("-o,--output", arguments.Output, "The folder, or the .nc or .vtkhdf file, to write")
    ->required();
  addModelOptions(command, arguments.Model);
  command.add_option("--crs", arguments.Crs,
    "With .nc: the coordinate reference system, such as EPSG:32617, instead of the input's");
}

int run(FlattenArguments& arguments)
{
  requireModel(arguments.Input, arguments.Model);
  refuseIf(!arguments.Crs.empty() && !isNetcdf(arguments), "--crs", "needs an output named .nc");
  return isIdleRank() ? Success : runFlatten(arguments);
}

} // namespace

void addFlattenCommand(CLI::App& app, int& exitCode)
{
  addCommand<FlattenArguments>(app, exitCode, "flatten",
    "Writes the triangles or tetrahedra of a mesh as a folder of .npy arrays, in their order, or "
    "triangles as NetCDF (UGRID)",
    flattenFooter, addOptions, run);
}

namespace
{

constexpr const char* partitionFooter =
  R"(INPUT   a flat mesh: a folder of cells.npy, points.npy, point_data/NAME.npy and
        cell_data/NAME.npy, or a .vtu with appended, raw, uncompressed data, read in
        place whatever its size; or any VTK file of triangles or tetrahedra that
        fits in memory; or the output of a model, as for 'tipp flatten', with its time
        steps, which need their space on the disk twice for the time of the run.
MESH    a folder: mesh.pvtu and mesh.vtkhdf, which ParaView and VTK read, the pieces,
        and an index. An existing partitioned mesh is replaced when the new one is
        complete.

A cell belongs to the first partition that it meets; the other partitions it meets
borrow it, by reference or as ghost cells in their own pieces. Under mpirun all ranks
share the work, and the files are the same. Ctrl-C stops the run with exit code 130 and
no output. --memory is the limit of each rank, in bytes or such as 512M (2^20 bytes) or
2G.

Examples:
  tipp partition mesh -o mesh.tipp --tiling grid:8x8
  tipp partition mesh.vtu -o mesh.tipp --tiling quadtree:100000 --memory 512M
  tipp partition fort.63.nc -o surge.tipp --tiling quadtree:100000
  mpirun -np 4 tipp partition mesh -o mesh.tipp --borrowers duplicate
)";

struct PartitionArguments
{
  std::string Input;
  std::string Output;
  SeriesOptions Model;
  std::string Tiling = "grid:4x4";
  std::string Borrowers = "reference";
  bool Neighbors = false;
  std::string Memory = "2G";
  std::string Loader = "auto";
  std::string Device = "openmp";
  int Threads = 0;
  std::string Statistics;
};

/// Writes the file of --stats. Throws IOError.
void writeReport(const PartitionArguments& arguments, const PartitionStatistics& statistics)
{
  const LoadCounters& loads = statistics.Loads;
  nlohmann::ordered_json json = {
    { "input", arguments.Input },
    { "output", arguments.Output },
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
  writeJson(arguments.Statistics, json);
}

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
  options.Model = arguments.Model;
  options.Progress = progressOn(bar);
  return options;
}

int run(PartitionArguments& arguments)
{
  requireModel(arguments.Input, arguments.Model);
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
            checkOutputs(arguments.Output, arguments.Statistics, "", { arguments.Input });
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
      writeReport(arguments, statistics);
    }
    fmt::print("{} cells, {} points, {} pieces, {} borrowed cells, {:.0f} MB, {:.3f} s, peak "
               "memory {:.0f} MB\n",
      statistics.Cells, statistics.Points, statistics.Pieces, statistics.BorrowedCells,
      double(statistics.MeshBytes) / 1e6, totalSeconds(statistics.Phases),
      double(peakMemoryBytes()) / 1e6);
    warnOfCellsLeftOut(arguments.Input, statistics.LeftOut, statistics.GhostCells);
    warnOfVariablesLeftOut(arguments.Input, statistics.VariablesLeftOut);
  }
  return Success;
}

void addOptions(CLI::App& command, PartitionArguments& arguments)
{
  command.add_option("input", arguments.Input, "The mesh")->required();
  command.add_option("-o,--output", arguments.Output, "The partitioned mesh, such as mesh.tipp")
    ->required();
  addModelOptions(command, arguments.Model);
  addChecked(command, "--tiling", arguments.Tiling, checkTiling,
    "grid:COLUMNSxROWS[xLAYERS]; or quadtree:CELLS (octree:CELLS): partitions are divided until "
    "each meets at most CELLS cells that are not longer than the partition");
  addChecked(command, "--borrowers", arguments.Borrowers,
    CLI::IsMember({ "reference", "duplicate" }),
    "reference: borrowed cells are only in their owners' pieces; duplicate: they are also copied "
    "to the pieces that borrow them");
  command.add_flag("--neighbors", arguments.Neighbors,
    "Add the cell array NeighborIds: the id of the cell across each edge or face; this partitions "
    "the mesh twice");
  addChecked(command, "--memory", arguments.Memory, checkMemorySize,
    "The memory limit of each rank, such as 512M");
  addChecked(command, "--loader", arguments.Loader,
    CLI::IsMember({ "auto", "direct", "fine", "mmap" }),
    "How vertices are read: direct: Direct Load; fine: with smaller reads; mmap: mapped files; "
    "auto: chosen automatically");
  command
    .add_option("--device", arguments.Device,
      "The device that classifies cells at borders: auto, openmp, opencl, opencl:INDEX or "
      "opencl:NAME")
    ->capture_default_str();
  addThreadsOption(command, arguments.Threads);
  command.add_option("--stats", arguments.Statistics, "A JSON file for figures of the run");
}

} // namespace

void addPartitionCommand(CLI::App& app, int& exitCode)
{
  addCommand<PartitionArguments>(app, exitCode, "partition",
    "Cuts a mesh larger than memory into pieces on the disk", partitionFooter, addOptions, run);
}

} // namespace tipp

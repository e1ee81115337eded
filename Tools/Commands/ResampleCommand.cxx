// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/ResampleArguments.h"
#include "Commands/SeriesReport.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Flat/FlatMesh.h"
#include "Partitioned/PartitionedMesh.h"
#include "Series/StepSelection.h"

#include <CLI/CLI.hpp>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(MESH    any VTK file of triangles, tetrahedra or other cells, which are cut into these; or
        a partitioned mesh (its folder or index) or a flat one (a folder of .npy
        arrays), of which only the range of --bounds is read; or the output of a model
        (.nc, .slf, .2dm, .14 ..., see STEPS). A partitioned mesh may be larger than
        memory: it is read in parts of about --memory, in bytes or such as 512M. The z of
        a surface is sampled as the array elevation, unless all points have the same z.
IMAGE   .vti: all arrays, vtkValidPointMask (1 where a cell contains the sample) and
        vtkGhostType. .npy: one array (--arrays NAME, default: elevation), in its own
        type or float64: rows x columns, the row of lowest y first; for a volume layers
        x rows x columns. Components come last. Samples in no cell are NaN, or the
        number of --null. .tif: a GeoTIFF with a band for each array; the samples are the
        pixels' centres, and --null is its number for no value (default: -9999). Values
        have 32 bits, or 64 if they are too large for that.

STEPS   The output of a model, and the time steps of a flat mesh of triangles if several
        are asked for, are resampled step by step in the plane; the triangles of the
        samples are found once. Memory is needed for the mesh and a few steps, however
        many there are. .nc: NetCDF in the manner of CF, with time and reference system.
        .tif and .pvd: a file for each step, such as maps_0012.tif, and one for what does
        not vary. .npy: steps x rows x columns. Values have 32 bits. Nodes without a
        value (NaN, a fill value or --no-data) are dry, and so are triangles with such a
        node, unless --waterline is given. --reduce takes the steps with a value; a step
        stands for the time from half way after the step before it to half way before
        the next one.

With --method conservative, samples are the exact means over the part of each pixel that
cells cover, as float64. A pixel has the sample as its centre and reaches half way to the
next ones. Sums of mean times covered area are the mesh's integral. It needs a surface,
and runs on one rank and on threads.

Under mpirun the ranks share the cells, and the first one writes the image. Every rank
reads the whole of a VTK file, but only its own part of a partitioned or flat mesh.

Examples:
  tipp resample surge.vtu -o surge.vti --dims 2048 2048 1
  mpirun -np 4 tipp resample surge.tipp -o surge.vti --dims 2048 2048 1
  tipp resample surge.vtu -o peak.npy --arrays zeta_max --delta 0.01 0.01 0
    --bounds -76 -75 35 36 --no-data -99999
  tipp resample surge -o maps.nc --step all --resolution 0.01 --bounds -76 -75 35 36
  tipp resample surge -o flood.tif --reduce max time-of-max above:1 --resolution 0.01
)";

void addSeriesOptions(CLI::App& command, ResampleArguments& arguments)
{
  addChecked(command, "--step", arguments.Step, checkSteps,
    "The time steps, counted from 0: a number, all or FIRST:LAST:STRIDE with LAST included");
  command.add_option("--values", arguments.Values,
    "More files with values at the mesh's nodes or cells, such as fort.63");
  command.add_option("--reduce", arguments.Reduce,
    "What to make of the time steps instead of writing them: max, min, mean, time-of-max or "
    "above:LEVEL, the time above a level");
  command.add_flag("--with-steps", arguments.WithSteps, "With --reduce: writes the steps, too");
  command.add_option("--waterline", arguments.Waterline,
    "The array with the depth of the ground, positive down: water ends where its level meets the "
    "ground, not at the last wet node");
  command.add_flag("--wrap", arguments.Wrap,
    "Moves longitudes by 360 degrees where cells cross the 180th meridian");
}

void addOptions(CLI::App& command, ResampleArguments& arguments)
{
  command.add_option("mesh", arguments.Input, "The mesh, see below")->required();
  addOutput(
    command, arguments.Output, "The image, see below", Use::WritesRasters | Use::WritesSeries);
  command
    .add_option("--bounds", arguments.Bounds,
      "The range: xmin xmax ymin ymax [zmin zmax] (default: that of the mesh)")
    ->expected(4, 6);
  CLI::Option* const dimensions =
    command
      .add_option("--dims", arguments.Dimensions,
        "Number of samples along x, y [and z]; 0: spaced as along the "
        "first axis with a number; surfaces have one along z")
      ->expected(2, 3);
  CLI::Option* const delta = command
                               .add_option("--delta", arguments.Delta,
                                 "Distance between samples along x, y [and z]; 0: one sample")
                               ->expected(2, 3);
  delta->excludes(dimensions);
  command
    .add_option("--resolution", arguments.Resolution, "Distance between samples along x and y")
    ->check(CLI::PositiveNumber)
    ->excludes(dimensions)
    ->excludes(delta);
  command.add_option("--arrays", arguments.Arrays, "Names of arrays (default: all, and elevation)");
  addSeriesOptions(command, arguments);
  command
    .add_option("--device", arguments.Device, "auto, openmp, opencl, opencl:INDEX or opencl:NAME")
    ->capture_default_str();
  addThreadsOption(command, arguments.Threads);
  command.add_option("--null", arguments.Null, "The value of samples outside of the mesh");
  command.add_option("--no-data", arguments.NoData,
    "Cells with a corner of this value give no samples, such as -99999 for dry nodes");
  addChecked(command, "--method", arguments.Method, CLI::IsMember({ "linear", "conservative" }),
    "linear: values at the samples; conservative: exact means over the covered part of each pixel");
  command.add_flag("--covered-share", arguments.CoveredShare,
    "Adds the array CoveredShare: the share of each pixel that is covered");
  command.add_option("--crs", arguments.Crs, "The reference system of a .tif, such as EPSG:25832");
  addChecked(command, "--memory", arguments.Memory, checkMemorySize,
    "The memory limit for the part of a partitioned mesh that is in memory");
}

/// Warns of missing values in a stored mesh that are numbers, such as -99999.
void warnOfNumbers(const ResampleArguments& arguments)
{
  const std::string& path = arguments.Input;
  const auto advice = [](double missing) { return "give --no-data=" + shortText(missing); };
  try
  {
    if (isPartitionedMesh(path))
    {
      warnOfMissingValues(path, openPartitionedMesh(path).Description, arguments.Arrays, advice);
    }
    else if (isFlatMesh(path))
    {
      warnOfMissingValues(path, openFlatMesh(path).Description, arguments.Arrays, advice);
    }
  }
  catch (const IOError&)
  {
    return; // the run reports it
  }
}

int run(ResampleArguments& arguments)
{
  if (arguments.Resolution > 0)
  {
    arguments.Delta = { arguments.Resolution, arguments.Resolution };
  }
  refuseIf(arguments.Dimensions.empty() && arguments.Delta.empty(), "--dims",
    "or --delta or --resolution is required");
  arguments.Dimensions.resize(arguments.Dimensions.empty() ? 0 : 3, 1);
  arguments.Delta.resize(arguments.Delta.empty() ? 0 : 3, 0);
  refuseIf(arguments.Bounds.size() == 5, "--bounds", "needs four numbers, or six");
  refuseIf(arguments.CoveredShare && arguments.Method != "conservative", "--covered-share",
    "needs --method conservative");
  if (isSeriesRun(arguments))
  {
    return isIdleRank() ? Success : runSeries(arguments);
  }
  arguments.OutputIs = openerOf(arguments.Output, Use::WritesRasters);
  refuseIf(arguments.OutputIs == Opener::None, "--output",
    "must end in " + listFormats(Use::WritesRasters) + " for a mesh without time steps");
  arguments.BoundsHaveZ = arguments.Bounds.size() != 4;
  arguments.Bounds.resize(arguments.Bounds.empty() ? 0 : 6);
  if (arguments.OutputIs == Opener::Npy && arguments.Arrays.empty())
  {
    arguments.Arrays = { "elevation" };
  }
  refuseIf(arguments.OutputIs == Opener::Npy && arguments.Arrays.size() != 1, "--arrays",
    "must name one array for an .npy file");
  if (!arguments.NoData && !isIdleRank())
  {
    warnOfNumbers(arguments);
  }
  return runResample(arguments);
}

} // namespace

void addResampleCommand(CLI::App& app, int& exitCode)
{
  addCommand<ResampleArguments>(app, exitCode, "resample",
    "Samples a mesh of triangles or tetrahedra on a regular grid, in parallel", footer, addOptions,
    run);
}

} // namespace tipp

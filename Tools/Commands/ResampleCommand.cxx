// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Commands/PointArguments.h"
#include "Commands/ResampleInput.h"
#include "Commands/ResampleOutput.h"
#include "Console/Process.h"
#include "Console/ProgressBar.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputPath.h"
#include "Files/PendingOutput.h"
#include "OpenCL/Devices.h"
#include "Ranks/Communicator.h"
#include "Raster/RasterFile.h"
#include "Vtk/VtkMessages.h"
#include "vtkRangeResampleFilter.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(MESH    any VTK file of triangles, tetrahedra or cells that are cut into them; or a
        partitioned mesh of 'tipp partition' (its folder or index) or a flat one (a
        folder of .npy arrays), of which only the range of --bounds is read. Of arrays
        that vary in time the first step is taken. A partitioned mesh may be larger than
        memory: it is read in parts of about --memory, in bytes or as 512M.
        The z of a surface is sampled as the array elevation, beside the others, unless
        all points have the same.
IMAGE   .vti: all arrays, vtkValidPointMask (1 where the mesh answers) and
        vtkGhostType. .npy: one array (--arrays NAME; without: elevation) as float64 or
        whatever it is, rows x columns, the first row at the lowest y; for a volume layers x
        rows x columns. Components come last. NaN where no cell answers, unless
        --null gives another number. .tif: a GeoTIFF by GDAL, a band for each array,
        whose pixels have the samples as centres; --null is its number for no value
        (-9999).

Under mpirun the ranks share the cells, and the first one writes the image. A VTK file is
read by every rank; of a partitioned or flat mesh each reads its own part.

Examples:
  tipp resample surge.vtu -o surge.vti --dims 2048 2048 1
  mpirun -np 4 tipp resample surge.tipp -o surge.vti --dims 2048 2048 1
  tipp resample surge.vtu -o peak.npy --arrays zeta_max --delta 0.01 0.01 0
    --bounds -76 -75 35 36 0 0 --no-data -99999
)";

void configure(const ResampleArguments& arguments, vtkRangeResampleFilter* filter)
{
  if (!arguments.Bounds.empty())
  {
    filter->UseInputBoundsOff();
    filter->SetSamplingBounds(arguments.Bounds.data());
  }
  if (!arguments.Dimensions.empty())
  {
    filter->SetSamplingDimensions(arguments.Dimensions.data());
  }
  if (!arguments.Delta.empty())
  {
    filter->SetSamplingDimensions(1, 1, 1);
    filter->SetDelta(arguments.Delta.data());
  }
  parseDeviceChoice(arguments.Device); // throws here what the filter would only report
  filter->SetDeviceChoice(arguments.Device.c_str());
  filter->SetNumberOfThreads(arguments.Threads);
  const bool npy = extensionOf(arguments.Output) == ".npy";
  filter->SetNullValue(
    arguments.HasNull || !npy ? arguments.Null : std::numeric_limits<double>::quiet_NaN());
  filter->SetUseNoDataValue(arguments.HasNoData);
  filter->SetNoDataValue(arguments.NoData);
}

void summarize(const ResampleArguments& arguments, vtkRangeResampleFilter* filter)
{
  vtkFieldData* const figures = filter->GetStatistics()->GetFieldData();
  const auto number = [&](const char* name)
  { return std::int64_t(figures->GetArray(name)->GetTuple1(0)); };
  double seconds = 0;
  vtkDataArray* const phases = figures->GetArray("PhaseSeconds");
  for (vtkIdType i = 0; i < phases->GetNumberOfTuples(); ++i)
  {
    seconds += phases->GetTuple1(i);
  }
  fmt::print("{} of {} samples from {} cells, {:.3f} s on {}, in {}\n", number("SamplesHit"),
    number("Samples"), number("Cells"), seconds,
    figures->GetAbstractArray("Device")->GetVariantValue(0).ToString(), arguments.Output);
}

/// Replaces the filter's property names in a message by the command's options.
std::string reasonOf(std::string message)
{
  const std::vector<std::pair<std::string, std::string>> names = {
    { "Resampling: ", "" },
    { "turn UseInputBounds off", "give --bounds" },
    { "SamplingDimensions", "--dims" },
    { "Delta", "--delta" },
  };
  for (const auto& [property, option] : names)
  {
    const std::size_t at = message.find(property);
    if (at != std::string::npos)
    {
      message.replace(at, property.size(), option);
    }
  }
  return "cannot be resampled: " + message;
}

/// Returns the state of the output's path before the work.
PathState sample(
  const ResampleArguments& arguments, vtkRangeResampleFilter* filter, Communicator& ranks)
{
  PathState before;
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        // Checked before the work.
        requireApart({ arguments.Output }, { arguments.Input });
        before = PendingFile(arguments.Output).before();
      }
    });
  filter->SetController(ranks.controller());
  filter->GatherOnRootOn();
  configure(arguments, filter);
  const vtkNew<ErrorKeeper> reading;
  connectMesh(arguments, ranks, filter, reading);
  ProgressBar bar("resampling");
  vtkNew<vtkCallbackCommand> progress;
  progress->SetClientData(&bar);
  progress->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto* const algorithm = static_cast<vtkAlgorithm*>(caller);
      static_cast<ProgressBar*>(data)->update(algorithm->GetProgress());
      algorithm->SetAbortExecute(isInterrupted());
    });
  filter->AddObserver(vtkCommand::ProgressEvent, progress);
  vtkNew<ErrorKeeper> problems;
  filter->AddObserver(vtkCommand::ErrorEvent, problems);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, problems);
  vtkNew<ErrorKeeper> warnings;
  filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->Update();
  ranks.attempt(
    []
    {
      if (isInterrupted())
      {
        throw WorkAborted();
      }
    });
  if (reading->HasError)
  {
    throw IOError(reading->message());
  }
  if (problems->HasError)
  {
    throw IOError(arguments.Input, reasonOf(problems->message()));
  }
  for (const std::string& warning :
    ranks.isFirst() ? warnings->Messages : std::vector<std::string>())
  {
    fmt::print(stderr, "tipp: warning: {}: {}\n", arguments.Input, warning);
  }
  return before;
}

int runResample(const ResampleArguments& arguments)
{
  const MpiSession session;
  Communicator ranks(session.controller());
  vtkNew<vtkRangeResampleFilter> filter;
  PathState before;
  try
  {
    before = sample(arguments, filter, ranks);
  }
  catch (const WorkAborted&)
  {
    return reportInterrupt();
  }
  catch (const std::exception&)
  {
    return reportFailure();
  }
  if (!ranks.isFirst())
  {
    return Success;
  }
  if (extensionOf(arguments.Output) == ".npy")
  {
    writeNpy(arguments.Output, arguments.Arrays.front(), filter->GetOutput(), before);
  }
  else if (isGeoTiff(arguments.Output))
  {
    constexpr double usual = -9999;
    writeGeoTiff(arguments.Output, filter->GetOutput(), arguments.Crs,
      arguments.HasNull ? arguments.Null : usual, arguments.Threads, before);
  }
  else
  {
    writeImage(arguments.Output, filter->GetOutput(), before);
  }
  summarize(arguments, filter);
  return Success;
}

std::string checkOutput(const std::string& path)
{
  return isRasterFile(path) ? "" : "'" + path + "' does not end in .vti, .npy or .tif";
}

} // namespace

void addResampleCommand(CLI::App& app, int& exitCode)
{
  auto arguments = std::make_shared<ResampleArguments>();
  CLI::App* const command = app.add_subcommand(
    "resample", "Samples a mesh of triangles or tetrahedra on a regular grid, in parallel");
  command->add_option("mesh", arguments->Input, "The mesh, see below")->required();
  command->add_option("-o,--output", arguments->Output, "The image, see below")
    ->required()
    ->check(checkOutput);
  command
    ->add_option("--bounds", arguments->Bounds,
      "The range: xmin xmax ymin ymax zmin zmax; else that of the mesh")
    ->expected(6);
  CLI::Option* const dimensions = command
                                    ->add_option("--dims", arguments->Dimensions,
                                      "Samples along x, y and z; 0: as far apart as along the "
                                      "first axis with a number, one along z for "
                                      "surfaces")
                                    ->expected(3);
  CLI::Option* const delta = command
                               ->add_option("--delta", arguments->Delta,
                                 "Distance of samples along x, y and z; 0: one sample")
                               ->expected(3);
  delta->excludes(dimensions);
  command->add_option("--arrays", arguments->Arrays, "Names of arrays; else all, and elevation");
  command
    ->add_option("--device", arguments->Device, "auto, openmp, opencl, opencl:INDEX or opencl:NAME")
    ->capture_default_str();
  addThreadsOption(*command, arguments->Threads);
  CLI::Option* const null =
    command->add_option("--null", arguments->Null, "What samples outside the mesh get");
  CLI::Option* const noData = command->add_option("--no-data", arguments->NoData,
    "Cells with a corner of this value answer nothing, as -99999 for dry nodes");
  command->add_option("--crs", arguments->Crs, "Of a .tif the reference system, as EPSG:25832");
  command
    ->add_option("--memory", arguments->Memory,
      "For the part of a partitioned mesh that is in memory at a time")
    ->check(checkMemorySize)
    ->capture_default_str();
  command->footer(footer);
  command->callback(
    [arguments, null, noData, &exitCode]()
    {
      arguments->HasNull = null->count() > 0;
      arguments->HasNoData = noData->count() > 0;
      if (arguments->Dimensions.empty() && arguments->Delta.empty())
      {
        throw CLI::ValidationError("--dims", "or --delta is required");
      }
      if (extensionOf(arguments->Output) == ".npy" && arguments->Arrays.empty())
      {
        arguments->Arrays = { "elevation" };
      }
      if (extensionOf(arguments->Output) == ".npy" && arguments->Arrays.size() != 1)
      {
        throw CLI::ValidationError("--arrays", "must name one array for an .npy file");
      }
      exitCode = runResample(*arguments);
    });
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Scalar.h"
#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/ResampleInput.h"
#include "Console/Process.h"
#include "Dem/MakeDem.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Npy/NpyFile.h"
#include "OpenCL/Devices.h"
#include "Ranks/Communicator.h"
#include "Raster/RasterFile.h"
#include "Vtk/DataSets.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRangeResampleFilter.h"
#include "vtkTable.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(MESH    any VTK file of triangles, tetrahedra or other cells, which are cut into these; or
        a partitioned mesh (its folder or index) or a flat one (a folder of .npy
        arrays), of which only the range of --bounds is read. Of arrays that vary in
        time the values of --step are sampled. A partitioned mesh may be larger than
        memory: it is read in parts of about --memory, in bytes or such as 512M. The z of
        a surface is sampled as the array elevation, unless all points have the same z.
IMAGE   .vti: all arrays, vtkValidPointMask (1 where a cell contains the sample) and
        vtkGhostType. .npy: one array (--arrays NAME, default: elevation), in its own
        type or float64: rows x columns, the row of lowest y first; for a volume layers
        x rows x columns. Components come last. Samples in no cell are NaN, or the
        number of --null. .tif: a GeoTIFF, which needs GDAL, with a band for each array;
        the samples are the pixels' centres, and --null is its number for no value
        (default: -9999). Values have 32 bits, or 64 if they are too large for that.

Under mpirun the ranks share the cells, and the first one writes the image. Every rank
reads the whole of a VTK file, but only its own part of a partitioned or flat mesh.

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
  parseDeviceChoice(arguments.Device); // throw here; the filter would only report an error
  filter->SetDeviceChoice(arguments.Device.c_str());
  filter->SetNumberOfThreads(arguments.Threads);
  const bool npy = arguments.OutputIs == Opener::Npy;
  filter->SetNullValue(
    arguments.Null.value_or(npy ? std::numeric_limits<double>::quiet_NaN() : 0.0));
  filter->SetUseNoDataValue(arguments.NoData.has_value());
  filter->SetNoDataValue(arguments.NoData.value_or(0));
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
  const std::string device = figures->GetAbstractArray("Device")->GetVariantValue(0).ToString();
  fmt::print("{} of {} samples from {} cells, {:.3f} s{}, in {}\n", number("SamplesHit"),
    number("Samples"), number("Cells"), seconds, device.empty() ? "" : " on " + device,
    arguments.Output);
}

/// Replaces the filter's property names in a message by the options of the command.
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

/// Returns the state of the output's path before the computation.
PathState sample(
  const ResampleArguments& arguments, vtkRangeResampleFilter* filter, Communicator& ranks)
{
  PathState before;
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        before = requireWritable(arguments.Output, "", { arguments.Input });
      }
    });
  filter->SetController(ranks.controller());
  filter->GatherOnRootOn();
  configure(arguments, filter);
  const vtkNew<ErrorKeeper> reading;
  const std::optional<double> time = connectMesh(arguments, ranks, filter, reading);
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
  if (time)
  {
    filter->UpdateTimeStep(*time);
  }
  else
  {
    filter->Update();
  }
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

RasterGrid gridOf(const std::string& path, vtkImageData* image)
{
  int dimensions[3];
  double origin[3];
  double spacing[3];
  image->GetDimensions(dimensions);
  image->GetOrigin(origin);
  image->GetSpacing(spacing);
  if (dimensions[2] != 1)
  {
    throw IOError(path, "cannot hold several layers; give one sample along z, or use .vti.");
  }
  RasterGrid grid;
  grid.Columns = dimensions[0];
  grid.Rows = dimensions[1];
  grid.Pixel = { spacing[0], spacing[1] };
  grid.West = gridPosition(origin[0], spacing[0], -1);
  grid.South = gridPosition(origin[1], spacing[1], -1);
  return grid;
}

/// Whether values are too large for 32 bits, or whole numbers that would lose digits.
bool needs64Bits(const std::vector<double>& values, int type)
{
  constexpr double mostWhole = 1 << 24;
  const bool isWhole = type != VTK_FLOAT && type != VTK_DOUBLE;
  return std::any_of(values.begin(), values.end(),
    [isWhole](double value)
    {
      return isWhole ? std::fabs(value) > mostWhole
                     : std::isfinite(value) && std::isinf(float(value));
    });
}

/// Returns the arrays with one component, NaN at samples that no cell contains. Sets the names of
/// the bands, and whether they have 64 bits.
BandValues bandsOf(vtkImageData* image, RasterDescription& description)
{
  vtkPointData* const data = image->GetPointData();
  vtkDataArray* const valid = data->GetArray("vtkValidPointMask");
  BandValues bands;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = data->GetArray(i);
    if (!array || array == valid || array->GetNumberOfComponents() != 1 || !array->GetName() ||
      array->GetName() == std::string(vtkDataSetAttributes::GhostArrayName()))
    {
      continue;
    }
    description.Bands.emplace_back(array->GetName());
    std::vector<double> values(std::size_t(array->GetNumberOfTuples()));
    for (std::size_t j = 0; j < values.size(); ++j)
    {
      values[j] = valid->GetTuple1(vtkIdType(j)) == 1 ? array->GetTuple1(vtkIdType(j))
                                                      : std::numeric_limits<double>::quiet_NaN();
    }
    description.Double = description.Double || needs64Bits(values, array->GetDataType());
    bands.push_back(std::move(values));
  }
  return bands;
}

/// Writes the array `name` of an image to a .npy file. `before`: the state of the path before the
/// computation, here and in writeGeoTiff(); only that file is replaced. Throws IOError.
void writeNpy(
  const std::string& path, const std::string& name, vtkImageData* image, const PathState& before)
{
  vtkDataArray* const array = image->GetPointData()->GetArray(name.c_str());
  if (!array)
  {
    throw IOError(path, "was not written: the mesh has no array '" + name + "' in this range.");
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  std::vector<std::int64_t> shape;
  if (dimensions[2] > 1)
  {
    shape.push_back(dimensions[2]);
  }
  shape.push_back(dimensions[1]);
  shape.push_back(dimensions[0]);
  if (array->GetNumberOfComponents() > 1)
  {
    shape.push_back(array->GetNumberOfComponents());
  }
  NpyWriter writer(path, scalarDescr(*scalarOf(array->GetDataType())), shape, before);
  writer.write(array->GetVoidPointer(0),
    std::size_t(array->GetNumberOfValues()) * std::size_t(array->GetDataTypeSize()));
  writer.close();
}

/// Writes an image of one layer as a GeoTIFF. Samples are the pixels' centres, and each array
/// becomes a band. Throws IOError.
void writeGeoTiff(const std::string& path, vtkImageData* image, const std::string& crs,
  double noData, int threads, const PathState& before)
{
  RasterDescription description;
  description.Grid = gridOf(path, image);
  const BandValues bands = bandsOf(image, description);
  if (bands.empty())
  {
    throw IOError(path, "would have no band, because the mesh has no array with one component.");
  }
  description.Crs = crs;
  description.NoData = noData;
  description.Double = description.Double || needs64Bits({ noData }, VTK_DOUBLE);
  description.Threads = threads;
  const auto writer = createRaster(path, description, before);
  writeTiles(*writer, description.Grid, readFrom(description.Grid, bands), {}, threads);
  writer->close();
  warnOfHidden(writer->hidden(), noData);
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
  if (arguments.OutputIs == Opener::Npy)
  {
    writeNpy(arguments.Output, arguments.Arrays.front(), filter->GetOutput(), before);
  }
  else if (arguments.OutputIs == Opener::GeoTiff)
  {
    constexpr double usual = -9999;
    writeGeoTiff(arguments.Output, filter->GetOutput(), arguments.Crs,
      arguments.Null.value_or(usual), arguments.Threads, before);
  }
  else
  {
    writeXmlFile(arguments.Output, before, filter->GetOutput());
  }
  summarize(arguments, filter);
  return Success;
}

void addOptions(CLI::App& command, ResampleArguments& arguments)
{
  command.add_option("mesh", arguments.Input, "The mesh, see below")->required();
  addOutput(command, arguments.Output, "The image, see below", Use::WritesRasters);
  command
    .add_option("--bounds", arguments.Bounds,
      "The range: xmin xmax ymin ymax zmin zmax (default: that of the mesh)")
    ->expected(6);
  CLI::Option* const dimensions = command
                                    .add_option("--dims", arguments.Dimensions,
                                      "Number of samples along x, y and z; 0: spaced as along the "
                                      "first axis with a number; surfaces have one along z")
                                    ->expected(3);
  CLI::Option* const delta = command
                               .add_option("--delta", arguments.Delta,
                                 "Distance between samples along x, y and z; 0: one sample")
                               ->expected(3);
  delta->excludes(dimensions);
  command.add_option("--arrays", arguments.Arrays, "Names of arrays (default: all, and elevation)");
  addStepOption(command, arguments.Step);
  command
    .add_option("--device", arguments.Device, "auto, openmp, opencl, opencl:INDEX or opencl:NAME")
    ->capture_default_str();
  addThreadsOption(command, arguments.Threads);
  command.add_option("--null", arguments.Null, "The value of samples outside of the mesh");
  command.add_option("--no-data", arguments.NoData,
    "Cells with a corner of this value give no samples, such as -99999 for dry nodes");
  command.add_option("--crs", arguments.Crs, "The reference system of a .tif, such as EPSG:25832");
  addChecked(command, "--memory", arguments.Memory, checkMemorySize,
    "The memory limit for the part of a partitioned mesh that is in memory");
}

int run(ResampleArguments& arguments)
{
  arguments.OutputIs = openerOf(arguments.Output, Use::WritesRasters);
  refuseIf(
    arguments.Dimensions.empty() && arguments.Delta.empty(), "--dims", "or --delta is required");
  if (arguments.OutputIs == Opener::Npy && arguments.Arrays.empty())
  {
    arguments.Arrays = { "elevation" };
  }
  refuseIf(arguments.OutputIs == Opener::Npy && arguments.Arrays.size() != 1, "--arrays",
    "must name one array for an .npy file");
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

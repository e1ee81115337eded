// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/Scalar.h"
#include "Commands/Commands.h"
#include "Commands/OpenSeries.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/ResampleArguments.h"
#include "Console/Process.h"
#include "Dem/RasterTiles.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Npy/NpyFile.h"
#include "OpenCL/Devices.h"
#include "Partitioned/PartitionedMesh.h"
#include "Ranks/Communicator.h"
#include "Raster/RasterFile.h"
#include "Reading/PieceSource.h"
#include "Sampling/SamplingRange.h"
#include "Sampling/SimplexParts.h"
#include "Vtk/DataSets.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArraySelection.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPartitionedUnstructuredReader.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkRangeResampleFilter.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Approximate bytes of memory per cell, including its share of the points and of the samples.
constexpr std::uint64_t bytesOfCell = 128;

/// The names of a mesh's arrays.
struct ArrayNames
{
  std::set<std::string> OfPoints;
  std::set<std::string> OfCells;
};

/// Throws IOError for a name, other than `except`, that the mesh does not have.
void requireArrays(
  const ResampleArguments& arguments, const ArrayNames& known, const std::string& except)
{
  for (const std::string& name : arguments.Arrays)
  {
    if (name != except && known.OfPoints.count(name) + known.OfCells.count(name) == 0)
    {
      std::set<std::string> all = known.OfPoints;
      all.insert(known.OfCells.begin(), known.OfCells.end());
      throw IOError(
        arguments.Input, "has no array '" + name + "'" + listOfNames(all, "; it has ") + ".");
    }
  }
}

/// Selects the arrays that `arguments` name; if they name none, leaves the selection unchanged.
/// Throws IOError for a name that the mesh does not have.
void selectArrays(
  const ResampleArguments& arguments, const ArrayNames& known, vtkRangeResampleFilter* filter)
{
  if (arguments.Arrays.empty())
  {
    return;
  }
  requireArrays(arguments, known, "");
  filter->GetPointDataArraySelection()->SetUnknownArraySetting(0);
  filter->GetCellDataArraySelection()->SetUnknownArraySetting(0);
  for (const std::string& name : arguments.Arrays)
  {
    const bool isOfPoints = known.OfPoints.count(name) > 0;
    (isOfPoints ? filter->GetPointDataArraySelection() : filter->GetCellDataArraySelection())
      ->EnableArray(name.c_str());
  }
}

/// Throws IOError if an array that `arguments` name holds no numbers.
void requireNumbers(const ResampleArguments& arguments, vtkDataSet* mesh)
{
  for (const std::string& name : arguments.Arrays)
  {
    vtkDataSetAttributes* const data = mesh->GetPointData()->HasArray(name.c_str())
      ? static_cast<vtkDataSetAttributes*>(mesh->GetPointData())
      : mesh->GetCellData();
    if (data->HasArray(name.c_str()) && !data->GetArray(name.c_str()))
    {
      throw IOError(
        arguments.Input, "has array '" + name + "', but it holds no numbers; name another.");
    }
  }
}

/// Hides the cells of the other ranks' shares, because every rank has read the whole mesh.
void hideOtherShares(vtkDataSet* mesh, Communicator& ranks)
{
  if (ranks.size() == 1)
  {
    return;
  }
  const vtkIdType cells = mesh->GetNumberOfCells();
  vtkNew<vtkUnsignedCharArray> ghosts;
  if (vtkUnsignedCharArray* const own = mesh->GetCellGhostArray())
  {
    ghosts->DeepCopy(own);
  }
  else
  {
    ghosts->SetNumberOfValues(cells);
    ghosts->FillValue(0);
  }
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  const auto [first, last] = ranks.shareOf(cells);
  unsigned char* const values = ghosts->GetPointer(0);
  const auto hide = [](unsigned char& ghost)
  { ghost = (unsigned char)(ghost | vtkDataSetAttributes::HIDDENCELL); };
  std::for_each(values, values + first, hide);
  std::for_each(values + last, values + cells, hide);
  mesh->GetCellData()->AddArray(ghosts);
}

std::set<std::string> namesIn(vtkDataArraySelection* selection)
{
  std::set<std::string> names;
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
  {
    names.insert(selection->GetArrayName(i));
  }
  return names;
}

ArrayNames namesIn(vtkPartitionedUnstructuredReader* reader)
{
  return { namesIn(reader->GetPointDataArraySelection()),
    namesIn(reader->GetCellDataArraySelection()) };
}

void throwFirst(const ErrorKeeper* errors)
{
  if (errors->HasError)
  {
    throw IOError(errors->message());
  }
}

/// Returns a reader of the range of a partitioned or flat mesh, with the named arrays only.
/// Collective.
vtkSmartPointer<vtkPartitionedUnstructuredReader> openReader(
  const ResampleArguments& arguments, Communicator& ranks, ErrorKeeper* errors)
{
  auto reader = vtkSmartPointer<vtkPartitionedUnstructuredReader>::New();
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->SetController(ranks.controller());
  reader->SetFileName(arguments.Input.c_str());
  // The tiling is for a flat mesh, which is read completely in any case.
  reader->SetTiling(ranks.size() == 1 ? "grid:1x1" : "grid:16x16");
  reader->SetNumberOfThreads(arguments.Threads);
  if (!arguments.Bounds.empty())
  {
    reader->SetBounds(arguments.Bounds.data());
    reader->StrictBoundsOn();
  }
  ranks.attempt(
    [&]
    {
      reader->UpdateInformation();
      throwFirst(errors);
    });
  for (vtkDataArraySelection* const selection :
    { reader->GetPointDataArraySelection(), reader->GetCellDataArraySelection() })
  {
    for (const std::string& name :
      arguments.Arrays.empty() ? std::set<std::string>() : namesIn(selection))
    {
      const bool wanted =
        std::find(arguments.Arrays.begin(), arguments.Arrays.end(), name) != arguments.Arrays.end();
      selection->SetArraySetting(name.c_str(), wanted ? 1 : 0);
    }
  }
  return reader;
}

/// Returns the time of the step to sample; none if the mesh has no times. Throws IOError if it does
/// not have the step.
std::optional<double> timeOf(const ResampleArguments& arguments, vtkAlgorithm* reader)
{
  vtkInformation* const information = reader ? reader->GetOutputInformation(0) : nullptr;
  auto* const key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  const int steps = information && information->Has(key) ? information->Length(key) : 0;
  const std::size_t step = parseSteps(arguments.Step, std::size_t(steps), arguments.Input).front();
  return steps > 0 ? std::make_optional(information->Get(key)[int(step)]) : std::nullopt;
}

/// Data from the index of a partitioned mesh.
struct StoredMesh
{
  Box3 Extent = Box3::empty(); ///< bounding box of its points
  bool IsSurface = true;
  std::int64_t CellsInRange = 0; ///< cells of the pieces that meet the range
};

StoredMesh describe(const PartitionedMesh& mesh, const ResampleArguments& arguments)
{
  StoredMesh stored;
  stored.IsSurface = mesh.CellSize == 3;
  const bool isWhole = arguments.Bounds.empty();
  const Box3 range = isWhole ? Box3() : boxOfVtkBounds<3>(arguments.Bounds.data());
  for (const PieceSummary& piece : mesh.Pieces)
  {
    const bool meets = isWhole || range.meets(piece.Box);
    stored.CellsInRange += meets ? piece.Cells : 0;
    stored.Extent.extend(piece.Extent);
  }
  return stored;
}

/// Selects the arrays that `arguments` name, or all except those that the reader adds.
void selectStoredArrays(const ResampleArguments& arguments, const StoredMesh& stored,
  vtkPartitionedUnstructuredReader* reader, vtkRangeResampleFilter* filter)
{
  ArrayNames names = namesIn(reader);
  if (stored.IsSurface && stored.Extent.Min.z < stored.Extent.Max.z)
  {
    names.OfPoints.insert(elevationName);
  }
  selectArrays(arguments, names, filter);
  filter->GetPointDataArraySelection()->DisableArray("GlobalPointIds");
  filter->GetCellDataArraySelection()->DisableArray("GlobalCellIds");
}

/// Throws IOError if a mesh of volumes needs a range along z that is not given.
void requireZ(const ResampleArguments& arguments, bool hasVolumes)
{
  if (hasVolumes && !arguments.BoundsHaveZ)
  {
    throw IOError(arguments.Input,
      "has cells with a volume, for which --bounds needs xmin xmax ymin ymax zmin zmax.");
  }
}

std::optional<double> connectStored(const ResampleArguments& arguments, Communicator& ranks,
  vtkRangeResampleFilter* filter, ErrorKeeper* reading)
{
  const auto reader = openReader(arguments, ranks, reading);
  std::optional<double> time;
  ranks.attempt(
    [&]
    {
      time = timeOf(arguments, reader);
      const PartitionedMesh mesh = openPartitionedMesh(arguments.Input);
      const StoredMesh stored = describe(mesh, arguments);
      selectStoredArrays(arguments, stored, reader, filter);
      requireZ(arguments, !stored.IsSurface);
      if (stored.Extent.isEmpty())
      {
        return; // there are no points
      }
      // The filter cannot find the range itself, because it reads the mesh piece by piece.
      const Box3 bounds =
        arguments.Bounds.empty() ? stored.Extent : boxOfVtkBounds<3>(arguments.Bounds.data());
      requireSensible(mesh, bounds);
      filter->UseInputBoundsOff();
      filter->SetSamplingBounds(vtkBoundsOf(bounds).data());
      if (!arguments.Dimensions.empty())
      {
        const auto& given = arguments.Dimensions;
        const std::array<int, 3> dimensions =
          chosenDimensions(bounds, { given[0], given[1], given[2] }, stored.IsSurface);
        filter->SetSamplingDimensions(dimensions.data());
      }
      const std::uint64_t memory = *parseMemorySize(arguments.Memory);
      const std::uint64_t bytes =
        bytesOfCell * std::uint64_t(stored.CellsInRange) / std::uint64_t(ranks.size());
      filter->SetNumberOfInputPieces(int(std::min<std::uint64_t>(bytes / memory + 1, mostPieces)));
    });
  filter->SetInputConnection(reader->GetOutputPort());
  return time;
}

vtkSmartPointer<vtkDataSet> readFlat(
  const ResampleArguments& arguments, Communicator& ranks, ArrayNames& names)
{
  const vtkNew<ErrorKeeper> errors;
  const auto reader = openReader(arguments, ranks, errors);
  names = namesIn(reader);
  // Before the mesh is read. Whether it has an elevation is known only afterwards.
  std::optional<double> time;
  ranks.attempt(
    [&]
    {
      requireArrays(arguments, names, elevationName);
      time = timeOf(arguments, reader);
    });
  time ? reader->UpdateTimeStep(*time, ranks.rank(), ranks.size(), 0)
       : int(reader->UpdatePiece(ranks.rank(), ranks.size(), 0));
  ranks.attempt([&] { throwFirst(errors); });
  vtkSmartPointer<vtkDataSet> mesh = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  // Remove the arrays that the reader adds: they are not fields to sample.
  for (vtkDataSetAttributes* const data :
    { static_cast<vtkDataSetAttributes*>(mesh->GetPointData()),
      static_cast<vtkDataSetAttributes*>(mesh->GetCellData()) })
  {
    data->RemoveArray(vtkDataSetAttributes::GhostArrayName());
    if (data->GetGlobalIds())
    {
      data->RemoveArray(data->GetGlobalIds()->GetName());
    }
  }
  return mesh;
}

/// Returns this rank's part of a mesh that is not partitioned. `names`: of the arrays of the whole
/// mesh. Collective.
vtkSmartPointer<vtkDataSet> readMesh(
  const ResampleArguments& arguments, Communicator& ranks, ArrayNames& names)
{
  vtkSmartPointer<vtkDataSet> mesh;
  ranks.attempt(
    [&]
    {
      // A .vtu file may be a flat mesh. If it has cells of other types, VTK's reader reads it.
      if (!isFlatMesh(arguments.Input) || isOpenedBy(arguments.Input, Opener::Vtk))
      {
        timeOf(arguments, nullptr);
        mesh = readPointSet(arguments.Input);
        requireNumbers(arguments, mesh);
        names = { arrayNames(mesh->GetPointData()), arrayNames(mesh->GetCellData()) };
        hideOtherShares(mesh, ranks);
      }
    });
  // If a rank cannot read the mesh, attempt() throws on all ranks.
  return mesh ? mesh : readFlat(arguments, ranks, names);
}

std::optional<double> connectMesh(const ResampleArguments& arguments, Communicator& ranks,
  vtkRangeResampleFilter* filter, ErrorKeeper* reading)
{
  if (isPartitionedMesh(arguments.Input))
  {
    return connectStored(arguments, ranks, filter, reading);
  }
  ArrayNames names;
  vtkSmartPointer<vtkDataSet> mesh = readMesh(arguments, ranks, names);
  auto* const points = vtkPointSet::SafeDownCast(mesh);
  ranks.attempt([&] { requireZ(arguments, hasVolumes(points)); });
  // Add the elevation of a surface as an array, so that users can select it by name.
  if (haveElevation({ points }, ranks))
  {
    mesh = withElevation(points);
    names.OfPoints.insert(elevationName);
  }
  filter->SetInputData(mesh);
  ranks.attempt([&] { selectArrays(arguments, names, filter); });
  return std::nullopt;
}

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

void configure(const ResampleArguments& arguments, vtkRangeResampleFilter* filter)
{
  if (!arguments.Bounds.empty())
  {
    filter->UseInputBoundsOff();
    filter->SetSamplingBounds(arguments.Bounds.data());
    filter->StrictBoundsOn();
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
  filter->SetMethod(arguments.Method == "conservative" ? vtkRangeResampleFilter::METHOD_CONSERVATIVE
                                                       : vtkRangeResampleFilter::METHOD_LINEAR);
  filter->SetPassCoveredShare(arguments.CoveredShare);
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

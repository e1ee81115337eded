// SPDX-License-Identifier: BSD-3-Clause
// What 'tipp resample' does with VTK: it samples any mesh with vtkRangeResampleFilter.
#include "Arrays/Scalar.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/ResampleArguments.h"
#include "Commands/ResampleImage.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "OpenCL/Devices.h"
#include "Partitioned/PartitionedMesh.h"
#include "Ranks/Communicator.h"
#include "Reading/PieceSource.h"
#include "Sampling/SamplingRange.h"
#include "Sampling/SimplexParts.h"
#include "Series/StepSelection.h"
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

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Approximate bytes of memory per cell, including its share of the points and of the samples.
constexpr std::uint64_t bytesOfCell = 128;

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
  filter->SetNullValue(nullValueOf(arguments));
  filter->SetUseNoDataValue(arguments.NoData.has_value());
  filter->SetNoDataValue(arguments.NoData.value_or(0));
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

ResampleFigures figuresOf(vtkRangeResampleFilter* filter)
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
  return { number("SamplesHit"), number("Samples"), number("Cells"), seconds,
    figures->GetAbstractArray("Device")->GetVariantValue(0).ToString() };
}

std::vector<ImageArray> arraysOf(vtkDataSetAttributes* data)
{
  std::vector<ImageArray> arrays;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* const array = data->GetArray(i);
    ImageArray view{ array->GetName(), *scalarOf(array->GetDataType()),
      array->GetNumberOfComponents(), array->GetVoidPointer(0) };
    for (int k = 0; array->HasAComponentName() && k < view.Components; ++k)
    {
      const char* const name = array->GetComponentName(k);
      view.ComponentNames.emplace_back(name ? name : "");
    }
    arrays.push_back(std::move(view));
  }
  return arrays;
}

/// Returns a view of the filter's image.
ImageArrays arraysOf(vtkImageData* image)
{
  ImageArrays arrays;
  image->GetExtent(arrays.Grid.Extent.data());
  image->GetOrigin(arrays.Grid.Min.data());
  image->GetSpacing(arrays.Grid.Delta.data());
  arrays.OfPoints = arraysOf(image->GetPointData());
  arrays.OfCells = arraysOf(image->GetCellData());
  return arrays;
}

} // namespace

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
  writeImage(arguments, arraysOf(filter->GetOutput()), before);
  summarize(arguments, figuresOf(filter));
  return Success;
}

} // namespace tipp

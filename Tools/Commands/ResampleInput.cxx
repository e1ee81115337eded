// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/ResampleInput.h"

#include "Commands/PointArguments.h"
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Partitioned/PartitionedMesh.h"
#include "Reading/PieceSource.h"
#include "Sampling/SamplingRange.h"
#include "Vtk/DataSets.h"
#include "vtkPartitionedUnstructuredReader.h"
#include "vtkRangeResampleFilter.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArraySelection.h"
#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <set>

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
  if (arguments.Step > 0 && arguments.Step >= steps)
  {
    throw IOError(arguments.Input,
      "has no time step " + std::to_string(arguments.Step) + "; there are " +
        std::to_string(steps) + ", counted from 0.");
  }
  return steps > 0 ? std::make_optional(information->Get(key)[arguments.Step]) : std::nullopt;
}

/// Data from the index of a partitioned mesh.
struct StoredMesh
{
  Bounds Extent{}; ///< bounds of its points; the lowest exceeds the highest if there are none
  bool IsSurface = true;
  std::int64_t CellsInRange = 0; ///< cells of the pieces that meet the range
};

StoredMesh describe(const ResampleArguments& arguments)
{
  const PartitionedMesh mesh = openPartitionedMesh(arguments.Input);
  StoredMesh stored;
  stored.IsSurface = mesh.CellSize == 3;
  const bool isWhole = arguments.Bounds.empty();
  const vtkBoundingBox range = isWhole ? vtkBoundingBox() : vtkBoundingBox(arguments.Bounds.data());
  vtkBoundingBox extent;
  for (const PieceSummary& piece : mesh.Pieces)
  {
    const bool meets = isWhole || range.Intersects(vtkBoundingBox(piece.Box.data()));
    stored.CellsInRange += meets ? piece.Cells : 0;
    const vtkBoundingBox own(piece.Extent.data());
    if (own.IsValid())
    {
      extent.AddBox(own);
    }
  }
  extent.GetBounds(stored.Extent.data());
  return stored;
}

/// Selects the arrays that `arguments` name, or all except those that the reader adds.
void selectStoredArrays(const ResampleArguments& arguments, const StoredMesh& stored,
  vtkPartitionedUnstructuredReader* reader, vtkRangeResampleFilter* filter)
{
  ArrayNames names = namesIn(reader);
  if (stored.IsSurface && stored.Extent[4] < stored.Extent[5])
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
      const StoredMesh stored = describe(arguments);
      selectStoredArrays(arguments, stored, reader, filter);
      if (stored.Extent[0] > stored.Extent[1])
      {
        return; // there are no points
      }
      // The filter cannot find the range itself, because it reads the mesh piece by piece.
      Bounds bounds = stored.Extent;
      std::copy(arguments.Bounds.begin(), arguments.Bounds.end(), bounds.begin());
      filter->UseInputBoundsOff();
      filter->SetSamplingBounds(bounds.data());
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
        mesh = readDataSet(arguments.Input);
        if (!vtkPointSet::SafeDownCast(mesh))
        {
          throw IOError(arguments.Input,
            std::string("holds a ") + mesh->GetClassName() +
              ", which stores no points; convert it with 'tipp flatten'.");
        }
        requireNumbers(arguments, mesh);
        names = { arrayNames(mesh->GetPointData()), arrayNames(mesh->GetCellData()) };
        hideOtherShares(mesh, ranks);
      }
    });
  // If a rank cannot read the mesh, attempt() throws on all ranks.
  return mesh ? mesh : readFlat(arguments, ranks, names);
}

} // namespace

std::optional<double> connectMesh(const ResampleArguments& arguments, Communicator& ranks,
  vtkRangeResampleFilter* filter, ErrorKeeper* reading)
{
  if (isPartitionedMesh(arguments.Input))
  {
    return connectStored(arguments, ranks, filter, reading);
  }
  ArrayNames names;
  vtkSmartPointer<vtkDataSet> mesh = readMesh(arguments, ranks, names);
  // Add the elevation of a surface as an array, so that users can select it by name.
  auto* const points = vtkPointSet::SafeDownCast(mesh);
  if (haveElevation({ points }, ranks))
  {
    mesh = withElevation(points);
    names.OfPoints.insert(elevationName);
  }
  filter->SetInputData(mesh);
  ranks.attempt([&] { selectArrays(arguments, names, filter); });
  return std::nullopt;
}

} // namespace tipp

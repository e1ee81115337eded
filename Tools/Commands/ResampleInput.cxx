// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/ResampleInput.h"

#include "Commands/PointArguments.h"
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Partitioned/PartitionedMesh.h"
#include "Reading/PieceSource.h"
#include "Sampling/SamplingRange.h"
#include "Vtk/ReadDataSet.h"
#include "vtkPartitionedUnstructuredReader.h"
#include "vtkRangeResampleFilter.h"

#include "vtkBoundingBox.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataArraySelection.h"
#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
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

[[noreturn]] void refuseName(
  const ResampleArguments& arguments, const std::string& name, const std::set<std::string>& names)
{
  throw IOError(
    arguments.Input, "has no array '" + name + "'" + listOfNames(names, "; it has ") + ".");
}

void chooseArrays(const ResampleArguments& arguments, vtkRangeResampleFilter* filter,
  vtkDataSet* mesh, const std::string& associations)
{
  if (arguments.Arrays.empty())
  {
    return;
  }
  filter->GetPointDataArraySelection()->SetUnknownArraySetting(0);
  filter->GetCellDataArraySelection()->SetUnknownArraySetting(0);
  for (std::size_t i = 0; i < arguments.Arrays.size(); ++i)
  {
    const std::string& name = arguments.Arrays[i];
    const char association = associations[i];
    const bool ofPoints = association == 'p';
    (ofPoints ? filter->GetPointDataArraySelection() : filter->GetCellDataArraySelection())
      ->EnableArray(name.c_str());
    if (association == ' ')
    {
      std::set<std::string> names = arrayNames(mesh->GetPointData());
      names.merge(arrayNames(mesh->GetCellData()));
      refuseName(arguments, name, names);
    }
    vtkDataSetAttributes* const data =
      ofPoints ? static_cast<vtkDataSetAttributes*>(mesh->GetPointData()) : mesh->GetCellData();
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

/// Returns a letter for each array name: 'p' if it is a point array in the mesh of all ranks, 'c'
/// for a cell array, ' ' if it is neither. Ranks without cells may lack arrays that others have.
/// Collective.
std::string associationsOf(
  const std::vector<std::string>& arrays, vtkDataSet* mesh, Communicator& ranks)
{
  std::string mine;
  for (const std::string& name : arrays)
  {
    mine += mesh->GetPointData()->HasArray(name.c_str()) ? 'p'
      : mesh->GetCellData()->HasArray(name.c_str())      ? 'c'
                                                         : ' ';
  }
  std::string known(arrays.size(), ' ');
  for (const std::string& associations : ranks.allGather(mine))
  {
    for (std::size_t i = 0; i < known.size(); ++i)
    {
      known[i] = known[i] == ' ' ? associations[i] : known[i];
    }
  }
  return known;
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
    own.IsValid() ? extent.AddBox(own) : void();
  }
  extent.GetBounds(stored.Extent.data());
  return stored;
}

/// Selects the arrays that `arguments` name, or all except those that the reader adds.
void chooseStoredArrays(const ResampleArguments& arguments, const StoredMesh& stored,
  vtkPartitionedUnstructuredReader* reader, vtkRangeResampleFilter* filter)
{
  vtkDataArraySelection* const ofPoints = filter->GetPointDataArraySelection();
  vtkDataArraySelection* const ofCells = filter->GetCellDataArraySelection();
  if (arguments.Arrays.empty())
  {
    ofPoints->DisableArray("GlobalPointIds");
    ofCells->DisableArray("GlobalCellIds");
    return;
  }
  ofPoints->SetUnknownArraySetting(0);
  ofCells->SetUnknownArraySetting(0);
  std::set<std::string> names[] = { namesIn(reader->GetPointDataArraySelection()),
    namesIn(reader->GetCellDataArraySelection()) };
  if (stored.IsSurface && stored.Extent[4] < stored.Extent[5])
  {
    names[0].insert(elevationName);
  }
  for (const std::string& name : arguments.Arrays)
  {
    if (names[0].count(name) + names[1].count(name) == 0)
    {
      names[0].merge(names[1]);
      refuseName(arguments, name, names[0]);
    }
    (names[0].count(name) > 0 ? ofPoints : ofCells)->EnableArray(name.c_str());
  }
}

/// Sets the filter's range and number of samples. The filter cannot find them itself, because it
/// reads the mesh piece by piece.
void setRange(
  const ResampleArguments& arguments, const StoredMesh& stored, vtkRangeResampleFilter* filter)
{
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
}

/// Returns into how many parts each rank divides its reading.
int batches(const ResampleArguments& arguments, const StoredMesh& stored, const Communicator& ranks)
{
  const std::uint64_t memory = *parseMemorySize(arguments.Memory);
  const std::uint64_t bytes =
    bytesOfCell * std::uint64_t(stored.CellsInRange) / std::uint64_t(ranks.size());
  return int(std::min<std::uint64_t>(bytes / std::max<std::uint64_t>(memory, 1) + 1, mostPieces));
}

void connectStored(const ResampleArguments& arguments, Communicator& ranks,
  vtkRangeResampleFilter* filter, ErrorKeeper* reading)
{
  const auto reader = openReader(arguments, ranks, reading);
  ranks.attempt(
    [&]
    {
      const StoredMesh stored = describe(arguments);
      chooseStoredArrays(arguments, stored, reader, filter);
      if (stored.Extent[0] <= stored.Extent[1])
      {
        setRange(arguments, stored, filter);
        filter->SetNumberOfInputPieces(batches(arguments, stored, ranks));
      }
    });
  filter->SetInputConnection(reader->GetOutputPort());
}

vtkSmartPointer<vtkDataSet> readFlat(const ResampleArguments& arguments, Communicator& ranks)
{
  const vtkNew<ErrorKeeper> errors;
  const auto reader = openReader(arguments, ranks, errors);
  std::set<std::string> names = namesIn(reader->GetPointDataArraySelection());
  names.merge(namesIn(reader->GetCellDataArraySelection()));
  ranks.attempt(
    [&]
    {
      for (const std::string& name : arguments.Arrays)
      {
        names.count(name) == 0 && name != elevationName ? refuseName(arguments, name, names)
                                                        : void();
      }
    });
  reader->UpdatePiece(ranks.rank(), ranks.size(), 0);
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

/// Returns this rank's part of a mesh that is not partitioned. Collective.
vtkSmartPointer<vtkDataSet> readMesh(const ResampleArguments& arguments, Communicator& ranks)
{
  vtkSmartPointer<vtkDataSet> mesh;
  ranks.attempt(
    [&]
    {
      // A .vtu file may be a flat mesh. If it has cells of other types, VTK's reader reads it.
      if (!isFlatMesh(arguments.Input) || isVtkFile(arguments.Input))
      {
        mesh = readDataSet(arguments.Input);
        if (!vtkPointSet::SafeDownCast(mesh))
        {
          throw IOError(arguments.Input,
            std::string("holds a ") + mesh->GetClassName() +
              ", which stores no points; convert it with 'tipp flatten'.");
        }
        hideOtherShares(mesh, ranks);
      }
    });
  // If a rank cannot read the mesh, attempt() throws on all ranks.
  return mesh ? mesh : readFlat(arguments, ranks);
}

} // namespace

void connectMesh(const ResampleArguments& arguments, Communicator& ranks,
  vtkRangeResampleFilter* filter, ErrorKeeper* reading)
{
  if (isPartitionedMesh(arguments.Input))
  {
    connectStored(arguments, ranks, filter, reading);
    return;
  }
  vtkSmartPointer<vtkDataSet> mesh = readMesh(arguments, ranks);
  // Add the elevation of a surface as an array, so that users can select it by name.
  auto* const points = vtkPointSet::SafeDownCast(mesh);
  if (haveElevation({ points }, ranks))
  {
    mesh = withElevation(points);
  }
  filter->SetInputData(mesh);
  const std::string associations = associationsOf(arguments.Arrays, mesh, ranks);
  ranks.attempt([&] { chooseArrays(arguments, filter, mesh, associations); });
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPartitionedUnstructuredReader.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Meshes/MeshFiles.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/PartitionMesh.h"
#include "Reading/PieceSource.h"
#include "Series/MeshSeries.h"
#include "Vtk/Compatibility.h"

#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkDataObjectTypes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <new>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkPartitionedUnstructuredReader);

namespace
{

/// A piece that this request owns, or one shared with the cache.
struct HeldPiece
{
  std::shared_ptr<const tipp::Piece> Shared;
  tipp::Piece Own; ///< if Shared is null

  const tipp::Piece& get() const { return this->Shared ? *this->Shared : this->Own; }
  /// Returns a piece whose memory VTK's arrays can take ownership of.
  tipp::Piece take()
  {
    return this->Shared ? tipp::mergePieces({ this->Shared.get() }) : std::move(this->Own);
  }
};

/// The pieces of a request.
struct Fetched
{
  std::vector<HeldPiece> Pieces;
  std::int64_t Read = 0;  ///< number of pieces that were not in the cache
  std::int64_t Bytes = 0; ///< bytes read
};

/// Changes when a file of the mesh changes.
std::string fileStamp(const std::string& path)
{
  namespace fs = std::filesystem;
  std::vector<fs::path> files{ path };
  for (const char* const name :
    { "index.json", "cells.npy", "points.npy", "time.npy", "description.json" })
  {
    files.push_back(fs::path(path) / name);
  }
  std::error_code ignored;
  for (const char* const folder : { "point_data", "cell_data" })
  {
    for (const auto& entry : fs::directory_iterator(fs::path(path) / folder, ignored))
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::string stamp;
  for (const fs::path& file : files)
  {
    const auto time = fs::last_write_time(file, ignored).time_since_epoch().count();
    stamp += "\n" + file.string() + " " + std::to_string(time);
  }
  return stamp;
}

std::unordered_map<std::string, bool> settingsOf(vtkDataArraySelection* selection)
{
  std::unordered_map<std::string, bool> settings;
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
  {
    settings.emplace(selection->GetArrayName(i), selection->GetArraySetting(i) != 0);
  }
  return settings;
}

/// Adds those of the arrays that the selection does not have. Their number may be large: adding
/// them one by one would search the selection for each.
void addMissing(const std::vector<const char*>& arrays, vtkDataArraySelection* selection)
{
  const std::unordered_map<std::string, bool> settings = settingsOf(selection);
  std::vector<const char*> names;
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
  {
    names.push_back(selection->GetArrayName(i));
  }
  const std::size_t known = names.size();
  std::unordered_set<std::string> added;
  for (const char* const array : arrays)
  {
    if (settings.count(array) == 0 && added.insert(array).second)
    {
      names.push_back(array);
    }
  }
  if (names.size() > known)
  {
    selection->SetArrays(names.data(), int(names.size()));
  }
}

/// The last step that is not after the time, or the first step.
int stepAt(const std::vector<double>& times, double time)
{
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  return std::max(int(after - times.begin()) - 1, 0);
}

} // namespace

class vtkPartitionedUnstructuredReader::Internals
{
public:
  std::string Opened; ///< the path that Source was opened with
  std::unique_ptr<tipp::PieceSource> Source;
  tipp::PieceCache Cache;
};

vtkPartitionedUnstructuredReader::vtkPartitionedUnstructuredReader()
  : Inner(new Internals)
{
  this->SetNumberOfInputPorts(0);
  vtkMath::UninitializeBounds(this->Bounds);
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

vtkPartitionedUnstructuredReader::~vtkPartitionedUnstructuredReader() = default;

vtkDataArraySelection* vtkPartitionedUnstructuredReader::GetPointDataArraySelection()
{
  return this->PointDataArraySelection;
}

vtkDataArraySelection* vtkPartitionedUnstructuredReader::GetCellDataArraySelection()
{
  return this->CellDataArraySelection;
}

vtkMTimeType vtkPartitionedUnstructuredReader::GetMTime()
{
  return std::max({ this->Superclass::GetMTime(), this->PointDataArraySelection->GetMTime(),
    this->CellDataArraySelection->GetMTime() });
}

int vtkPartitionedUnstructuredReader::CanReadFile(const char* path)
{
  try
  {
    return path &&
        (tipp::isPartitionedMesh(path) || tipp::isFlatMesh(path) || tipp::isMeshSeries(path))
      ? 1
      : 0;
  }
  catch (const std::exception&)
  {
    return 0; // a damaged file
  }
}

bool vtkPartitionedUnstructuredReader::HasBounds() const
{
  return !(this->Bounds[0] > this->Bounds[1]);
}

void vtkPartitionedUnstructuredReader::CheckBounds() const
{
  const double* const b = this->Bounds;
  if (std::any_of(b, b + 6, [](double bound) { return std::isnan(bound); }))
  {
    throw std::invalid_argument("Bounds hold a NaN; set numbers.");
  }
  if (this->HasBounds() && (b[2] > b[3] || b[4] > b[5]))
  {
    throw std::invalid_argument(
      "Bounds have from > to along y or z; set from <= to, or from > to along x for everything.");
  }
}

int vtkPartitionedUnstructuredReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

int vtkPartitionedUnstructuredReader::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* const info = outputVector->GetInformationObject(0);
  vtkDataObject* const present = vtkDataObject::GetData(info);
  const int wanted = this->MergePieces ? VTK_UNSTRUCTURED_GRID : VTK_PARTITIONED_DATA_SET;
  if (!present || present->GetDataObjectType() != wanted)
  {
    const auto output =
      vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(wanted));
    info->Set(vtkDataObject::DATA_OBJECT(), output);
  }
  return 1;
}

void vtkPartitionedUnstructuredReader::OpenSource()
{
  if (this->FileName.empty())
  {
    throw std::invalid_argument(
      "FileName is not set; name a partitioned or a flat mesh, or the output of a model.");
  }
  const tipp::TilingChoice choice = tipp::TilingChoice::require(this->Tiling);
  const std::string all = this->FileName + "\n" + this->Tiling + "\n" +
    std::to_string(this->MemoryLimit) + "\n" + std::to_string(this->NumberOfThreads);
  std::string stamped = all + fileStamp(this->FileName) + (this->Wrap ? "\nwrapped" : "");
  for (const std::string& values : this->ValuesFileNames)
  {
    stamped += fileStamp(values);
  }
  if (this->Inner->Source && this->Inner->Opened == stamped)
  {
    return;
  }
  this->Inner->Source.reset();
  this->Inner->Cache.clear();
  tipp::SourceOptions options;
  options.Tiling = choice;
  options.MemoryLimit = std::uint64_t(this->MemoryLimit);
  options.Threads = this->NumberOfThreads;
  options.Model = { this->ValuesFileNames, this->Wrap };
  this->Inner->Source = tipp::openPieceSource(this->FileName, options);
  this->Inner->Opened = stamped;
}

namespace
{

/// The text for VTK; null if it is empty.
const char* textOrNull(const std::string& text)
{
  return text.empty() ? nullptr : text.c_str();
}

} // namespace

const char* vtkPartitionedUnstructuredReader::GetTimeUnits() const
{
  return this->Inner->Source ? textOrNull(this->Inner->Source->mesh().Description.TimeUnits)
                             : nullptr;
}

const char* vtkPartitionedUnstructuredReader::GetCalendar() const
{
  return this->Inner->Source ? textOrNull(this->Inner->Source->mesh().Description.Calendar)
                             : nullptr;
}

const char* vtkPartitionedUnstructuredReader::GetReferenceSystem() const
{
  return this->Inner->Source ? textOrNull(this->Inner->Source->mesh().Description.Crs) : nullptr;
}

void vtkPartitionedUnstructuredReader::DescribeArrays()
{
  std::vector<const char*> ofPoints;
  std::vector<const char*> ofCells;
  for (const tipp::StoredArray& array : this->Inner->Source->mesh().Arrays)
  {
    (array.OfPoints ? ofPoints : ofCells).push_back(array.Name.c_str());
  }
  addMissing(ofPoints, this->PointDataArraySelection);
  addMissing(ofCells, this->CellDataArraySelection);
}

int vtkPartitionedUnstructuredReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* const info = outputVector->GetInformationObject(0);
  info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  info->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  info->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  try
  {
    this->OpenSource();
    this->DescribeArrays();
    const std::vector<double>& times = this->Inner->Source->mesh().Times;
    if (!times.empty())
    {
      const double range[] = { times.front(), times.back() };
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), int(times.size()));
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    // With several ranks the error is reported by RequestData, in which the other ranks take part.
    if (this->Controller && this->Controller->GetNumberOfProcesses() > 1)
    {
      return 1;
    }
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

namespace
{

/// The parameters of one request.
struct Request
{
  int Piece = 0;
  int Pieces = 1;
  bool Borrowed = false;
  std::optional<double> Time;

  explicit Request(vtkInformation* info)
  {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    if (info->Has(Pipeline::UPDATE_PIECE_NUMBER()) &&
      info->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()))
    {
      this->Piece = info->Get(Pipeline::UPDATE_PIECE_NUMBER());
      this->Pieces = std::max(info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()), 1);
    }
    if (info->Has(Pipeline::UPDATE_TIME_STEP()))
    {
      this->Time = info->Get(Pipeline::UPDATE_TIME_STEP());
    }
    this->Borrowed = info->Has(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) &&
      info->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) > 0;
  }

  /// This rank's share of the pieces, by weight.
  std::vector<std::size_t> shareOf(
    const std::vector<std::size_t>& numbers, const std::vector<std::int64_t>& weights) const
  {
    if (this->Piece < 0 || this->Piece >= this->Pieces)
    {
      return {};
    }
    std::vector<std::int64_t> some;
    some.reserve(numbers.size());
    for (const std::size_t number : numbers)
    {
      some.push_back(weights[number]);
    }
    const std::vector<std::size_t> starts = tipp::assignPieces(some, this->Pieces);
    const auto first = numbers.begin() + std::ptrdiff_t(starts[std::size_t(this->Piece)]);
    const auto last = numbers.begin() + std::ptrdiff_t(starts[std::size_t(this->Piece) + 1]);
    return { first, last };
  }
};

/// Returns the pieces from the cache or the source; all missing ones are read together. `keep`: add
/// them to the cache.
Fetched fetch(tipp::PieceSource& source, tipp::PieceCache& cache,
  const std::vector<std::size_t>& numbers, const tipp::PieceOptions& options, bool keep)
{
  Fetched fetched;
  fetched.Pieces.resize(numbers.size());
  std::vector<std::size_t> missing;
  std::vector<HeldPiece*> unread;
  const auto keyOf = [&options](std::size_t number) {
    return tipp::PieceCache::Key{ number, options.Borrowed, options.Wanted, options.Step };
  };
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    fetched.Pieces[i].Shared = cache.find(keyOf(numbers[i]));
    if (!fetched.Pieces[i].Shared)
    {
      missing.push_back(numbers[i]);
      unread.push_back(&fetched.Pieces[i]);
    }
  }
  std::vector<tipp::Piece> read = source.read(missing, options);
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    fetched.Bytes += read[i].BytesRead;
    if (keep)
    {
      unread[i]->Shared = std::make_shared<const tipp::Piece>(std::move(read[i]));
      cache.keep(keyOf(missing[i]), unread[i]->Shared);
    }
    else
    {
      unread[i]->Own = std::move(read[i]);
    }
  }
  fetched.Read = std::int64_t(missing.size());
  return fetched;
}

tipp::Piece merged(std::vector<HeldPiece>& pieces)
{
  if (pieces.size() == 1)
  {
    return pieces[0].take();
  }
  std::vector<const tipp::Piece*> pointers;
  pointers.reserve(pieces.size());
  for (const HeldPiece& piece : pieces)
  {
    pointers.push_back(&piece.get());
  }
  return tipp::mergePieces(pointers);
}

void setOutput(vtkDataObject* output, std::vector<HeldPiece>& pieces)
{
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(output))
  {
    if (!pieces.empty())
    {
      grid->ShallowCopy(tipp::makeGrid(merged(pieces)));
    }
    return;
  }
  auto* const set = vtkPartitionedDataSet::SafeDownCast(output);
  set->SetNumberOfPartitions(unsigned(pieces.size()));
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    set->SetPartition(unsigned(i), tipp::makeGrid(pieces[i].take()));
  }
}

} // namespace

void vtkPartitionedUnstructuredReader::ReadPieces(vtkInformation* outInfo)
{
  tipp::PieceSource& source = *this->Inner->Source;
  const tipp::PartitionedMesh& mesh = source.mesh();
  const Request request(outInfo);
  tipp::PieceOptions options;
  options.Step = stepAt(mesh.Times, request.Time.value_or(mesh.Times.empty() ? 0 : mesh.Times[0]));
  const auto ofPoints = settingsOf(this->PointDataArraySelection);
  const auto ofCells = settingsOf(this->CellDataArraySelection);
  for (const tipp::StoredArray& array : mesh.Arrays)
  {
    options.Wanted.push_back((array.OfPoints ? ofPoints : ofCells).at(array.Name));
  }
  const bool borrowed = request.Borrowed || this->BorrowerMode == OWNED_AND_BORROWED;
  std::optional<tipp::RangeFilter> range;
  std::vector<std::size_t> numbers(mesh.Pieces.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t(0));
  if (this->HasBounds())
  {
    const tipp::Box3 box = tipp::boxOfVtkBounds<3>(this->Bounds);
    if (this->StrictBounds)
    {
      tipp::requireSensible(mesh, box);
    }
    range.emplace(mesh, box);
    numbers = range->pieces();
  }
  options.Borrowed = borrowed || range;
  numbers = request.shareOf(numbers, source.weights());
  Fetched fetched = fetch(source, this->Inner->Cache, numbers, options, this->CacheSize > 0);
  this->Inner->Cache.shrink(std::size_t(this->CacheSize));
  this->NumberOfPiecesRead = fetched.Read;
  this->NumberOfBytesRead = fetched.Bytes;
  tipp::forChunks(
    range ? std::int64_t(numbers.size()) : 0, 1, tipp::threadCount(this->NumberOfThreads),
    [this](double done)
    {
      this->UpdateProgress(0.9 * done);
      return true;
    },
    [&](std::int64_t i, std::int64_t, int)
    {
      HeldPiece& piece = fetched.Pieces[std::size_t(i)];
      piece = { nullptr, range->apply(piece.get(), numbers[std::size_t(i)], borrowed) };
    });
  vtkDataObject* const output = vtkDataObject::GetData(outInfo);
  setOutput(output, fetched.Pieces);
  if (!mesh.Times.empty())
  {
    output->GetInformation()->Set(
      vtkDataObject::DATA_TIME_STEP(), mesh.Times[std::size_t(options.Step)]);
  }
}

/// Opens the mesh and reads the requested pieces; again, if it was replaced meanwhile. All ranks
/// read the same mesh. Collective; throws on all ranks.
void vtkPartitionedUnstructuredReader::ReadUnchanged(
  vtkInformation* outInfo, tipp::Communicator& ranks)
{
  for (int triesLeft = 8;; --triesLeft)
  {
    ranks.attempt(
      [this]
      {
        this->CheckBounds();
        this->OpenSource();
        this->DescribeArrays();
      });
    tipp::PieceSource& source = *this->Inner->Source;
    try
    {
      tipp::requireSameMesh(ranks, source.mesh());
      source.prepare(ranks);
      ranks.attempt([&] { this->ReadPieces(outInfo); });
      return;
    }
    catch (const tipp::IOError&)
    {
      // A flat mesh is not replaced as a whole.
      const bool isStored = source.mesh().IndexState.Values.has_value();
      if (!isStored || triesLeft == 0 || !isTrueOnAny(ranks, wasReplaced(source.mesh())))
      {
        throw;
      }
    }
    this->Inner->Source.reset();
    this->Inner->Cache.clear();
    vtkDataObject::GetData(outInfo)->Initialize();
  }
}

int vtkPartitionedUnstructuredReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* const outInfo = outputVector->GetInformationObject(0);
  vtkDataObject* const output = vtkDataObject::GetData(outInfo);
  output->Initialize();
  tipp::Communicator ranks(this->Controller);
  const tipp::PollScope polled(
    [this]
    {
      this->UpdateProgress(this->GetProgress());
      return !tipp::abortRequested(this);
    });
  int isGood = 0;
  try
  {
    this->ReadUnchanged(outInfo, ranks);
    return 1;
  }
  catch (const tipp::WorkAborted&)
  {
    isGood = 1; // an abort is no error
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro(
      "There is not enough memory for the pieces; ask for a range or for fewer pieces.");
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  output->Initialize();
  this->Inner->Source.reset(); // a failed prepare() may have left it incomplete
  this->Inner->Cache.clear();
  return isGood;
}

void vtkPartitionedUnstructuredReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(FileName);
  vtkTIPPPrintMacro(Bounds);
  vtkTIPPPrintMacro(StrictBounds);
  vtkTIPPPrintMacro(BorrowerMode);
  vtkTIPPPrintMacro(MergePieces);
  vtkTIPPPrintMacro(CacheSize);
  vtkTIPPPrintMacro(MemoryLimit);
  vtkTIPPPrintMacro(NumberOfThreads);
  vtkTIPPPrintMacro(Tiling);
  vtkTIPPPrintMacro(ValuesFileNames);
  vtkTIPPPrintMacro(Wrap);
  vtkTIPPPrintMacro(NumberOfPiecesRead);
  vtkTIPPPrintMacro(NumberOfBytesRead);
  os << indent << "Controller: " << this->Controller << "\n";
}

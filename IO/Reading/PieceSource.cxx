// SPDX-License-Identifier: BSD-3-Clause
#include "Reading/PieceSource.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawArray.h"
#include "Flat/FlatMesh.h"
#include "Loading/VertexLoader.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Partition/ClassifyCells.h"
#include "Partitioned/PieceFormat.h"
#include "Partitioning/PartitionMesh.h"
#include "Predicates/SensibleRange.h"
#include "Series/MeshSeries.h"

#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace tipp
{
namespace
{

class StoredPieces : public PieceSource
{
public:
  StoredPieces(const std::string& path, int threads)
    : Threads(threads)
  {
    this->Mesh = openPartitionedMesh(path);
  }

  void prepare(Communicator&) override {}

  std::vector<std::int64_t> weights() const override
  {
    std::vector<std::int64_t> cells;
    cells.reserve(this->Mesh.Pieces.size());
    for (const PieceSummary& piece : this->Mesh.Pieces)
    {
      cells.push_back(piece.Cells + piece.BorrowedCells);
    }
    return cells;
  }

  std::vector<Piece> read(
    const std::vector<std::size_t>& numbers, const PieceOptions& options) override
  {
    std::vector<Piece> pieces(numbers.size());
    parallelFor(std::int64_t(numbers.size()), this->Threads,
      [&](std::int64_t i)
      {
        poll();
        pieces[std::size_t(i)] = readPiece(this->Mesh, numbers[std::size_t(i)], options);
      });
    return pieces;
  }

private:
  int Threads;
};

template <typename T>
Buffer<char> bufferOf(const T* values, std::size_t count)
{
  Buffer<char> buffer(count * sizeof(T));
  std::copy(values, values + count, buffer.template as<T>());
  return buffer;
}

Buffer<char> bufferOf(const std::vector<std::int64_t>& values)
{
  return bufferOf(values.data(), values.size());
}

/// Converts 2 coordinates per point to 3, the third 0.
Buffer<char> withThird(const Buffer<char>& flat, std::int64_t points, std::size_t scalar)
{
  Buffer<char> three(std::size_t(points) * 3 * scalar);
  for (std::size_t i = 0; i < std::size_t(points); ++i)
  {
    std::memcpy(three.data() + 3 * i * scalar, flat.data() + 2 * i * scalar, 2 * scalar);
    std::memset(three.data() + (3 * i + 2) * scalar, 0, scalar);
  }
  return three;
}

/// The pieces of a flat mesh, made in memory. Chunk by chunk, the coordinates of cells are loaded
/// by Direct Load, and the cells are classified. Cells of the requested pieces are kept.
class FlatPieces : public PieceSource
{
public:
  FlatPieces(FlatMesh mesh, const SourceOptions& options)
    : Flat(std::move(mesh))
    , Options(options)
  {
    this->Mesh.Path = this->Flat.Path;
    this->Mesh.CellSize = this->Flat.CellSize;
    this->Mesh.PointType = this->Flat.Points.Type;
    this->Mesh.Points = this->Flat.Points.Tuples;
    this->Mesh.Cells = this->Flat.Cells.Tuples;
    this->Mesh.Tiling = options.Tiling.text(this->dimension());
    this->Mesh.Times = this->Flat.Times;
    this->Arrays = describeArrays(this->Flat, this->Mesh);
  }

  void prepare(Communicator& ranks) override
  {
    // All ranks must agree whether to continue, because the next step is collective.
    if (!isTrueOnAny(ranks, !this->Tiling))
    {
      return;
    }
    this->PointCounts.clear();
    if (this->Flat.Points.Tuples == 0)
    {
      this->Mesh.Pieces.clear();
      return;
    }
    const int threads = threadCount(this->Options.Threads);
    const Box3 domain = boundsOfPoints(this->Flat, ranks, threads);
    BoxTiling tiling = makeTiling(this->Flat, this->Options.Tiling, this->loading(),
      this->chunkCells(), threads, ranks, domain);
    setPieces(this->Mesh, domain, tiling);
    this->Tiling.emplace(std::move(tiling));
    std::vector<std::int64_t> counts(this->Mesh.Pieces.size(), 0);
    ranks.attempt(
      [&]
      {
        const auto [first, last] = ranks.shareOf(this->Flat.Points.Tuples);
        this->forEachOwner(first, last,
          [&counts](std::int64_t, std::int32_t owner) { ++counts[std::size_t(owner)]; });
      });
    ranks.sum(counts);
    this->PointCounts = std::move(counts);
  }

  std::vector<std::int64_t> weights() const override { return this->PointCounts; }

  std::vector<Piece> read(
    const std::vector<std::size_t>& numbers, const PieceOptions& options) override
  {
    std::vector<Piece> pieces;
    if (numbers.empty())
    {
      return pieces;
    }
    std::vector<std::int32_t> draftOf(this->Mesh.Pieces.size(), -1);
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      draftOf[numbers[i]] = std::int32_t(i);
    }
    std::vector<Draft> drafts(numbers.size());
    this->collectCells(draftOf, options.Borrowed, drafts);
    this->forEachOwner(0, this->Flat.Points.Tuples,
      [&](std::int64_t point, std::int32_t owner)
      {
        if (draftOf[std::size_t(owner)] >= 0)
        {
          drafts[std::size_t(draftOf[std::size_t(owner)])].OwnPoints.push_back(point);
        }
      });
    for (Draft& draft : drafts)
    {
      pieces.push_back(this->finish(draft, options));
      draft = {};
    }
    return pieces;
  }

private:
  /// A piece before its arrays are loaded. Ids are indices in the flat mesh.
  struct Draft
  {
    std::vector<std::int64_t> Cells;   ///< owned cells
    std::vector<std::int64_t> Corners; ///< CellSize point ids for each of these cells
    std::vector<std::int64_t> Borrowed;
    std::vector<std::int64_t> BorrowedCorners;
    std::vector<std::int64_t> OwnPoints; ///< ascending, as all the others
  };

  int dimension() const { return this->Flat.CellSize - 1; }

  LoaderOptions loading() const
  {
    LoaderOptions loading;
    loading.MemoryLimit = std::max<std::uint64_t>(this->Options.MemoryLimit / 4, 1);
    loading.Threads = this->Options.Threads;
    return loading;
  }

  /// The number of cells in a chunk: with their coordinates they fit in a quarter of the memory
  /// limit.
  std::int64_t chunkCells() const
  {
    const auto corners = std::size_t(this->Flat.CellSize);
    const auto dimension = std::size_t(this->dimension());
    const std::size_t perCell = corners * (8 + this->Flat.Points.tupleBytes() + 8 * dimension) + 32;
    constexpr std::uint64_t most = 1 << 22;
    return std::int64_t(
      std::clamp<std::uint64_t>(this->Options.MemoryLimit / 4 / perCell, 1, most));
  }

  /// Calls visit(point, owner) for points in ascending order. A point's owner is the first
  /// partition that contains it.
  template <typename Visit>
  void forEachOwner(std::int64_t first, std::int64_t last, const Visit& visit) const
  {
    constexpr std::int64_t chunk = 1 << 18;
    const RawArray& points = this->Flat.Points;
    const std::size_t bytes = points.tupleBytes();
    const auto dimension = std::size_t(this->dimension());
    const InputFile file(points.Path);
    std::vector<char> raw;
    std::vector<std::int32_t> owners;
    for (std::int64_t from = first; from < last; from += chunk)
    {
      const std::int64_t count = std::min(chunk, last - from);
      poll();
      raw.resize(std::size_t(count) * bytes);
      file.read(points.Offset + std::uint64_t(from) * bytes, raw.data(), raw.size());
      owners.resize(std::size_t(count));
      forIndices(
        count,
        [&](std::int64_t i)
        {
          Box3 at;
          takeCoordinates(
            points, raw.data() + std::size_t(i) * bytes, 1, int(dimension), &at.Min.x);
          at.Max = at.Min;
          if (!isFinite(at.Min))
          {
            owners[std::size_t(i)] = 0; // in no box, and as the partitioner has it
            return;
          }
          std::int32_t owner = std::numeric_limits<std::int32_t>::max();
          this->Tiling->forEachMeeting(
            at, [&owner](std::int32_t box) { owner = std::min(owner, box); });
          owners[std::size_t(i)] = owner;
        },
        this->Options.Threads, 1 << 14);
      for (std::int64_t i = 0; i < count; ++i)
      {
        visit(from + i, owners[std::size_t(i)]);
      }
    }
  }

  void collectCells(
    const std::vector<std::int32_t>& draftOf, bool borrowed, std::vector<Draft>& drafts) const
  {
    const auto corners = std::size_t(this->Flat.CellSize);
    const std::int64_t chunk = this->chunkCells();
    const auto loader = makeVertexLoader({ this->Flat.Points }, this->loading());
    ClassifyOptions classify;
    classify.Device.Kind = Device::OpenMP;
    classify.Threads = this->Options.Threads;
    const CellReader reader(this->Flat, this->Options.Threads);
    std::vector<std::int64_t> ids;
    const std::int64_t cells = this->Flat.Cells.Tuples;
    for (std::int64_t first = 0; first < cells; first += chunk)
    {
      reader.read(first, std::min(chunk, cells - first), ids);
      const std::vector<double> coordinates = loadCoordinates(this->Flat, *loader, ids);
      poll();
      const Membership membership =
        classifyCells({ this->dimension(), int(corners), coordinates.data(), ids.size() / corners },
          *this->Tiling, classify);
      for (std::size_t i = 0; i < ids.size() / corners; ++i)
      {
        pollAt(std::int64_t(i));
        const auto take = [&](std::int32_t piece, bool owned)
        {
          if (draftOf[std::size_t(piece)] >= 0)
          {
            Draft& draft = drafts[std::size_t(draftOf[std::size_t(piece)])];
            (owned ? draft.Cells : draft.Borrowed).push_back(first + std::int64_t(i));
            std::vector<std::int64_t>& to = owned ? draft.Corners : draft.BorrowedCorners;
            to.insert(to.end(), ids.begin() + std::ptrdiff_t(i * corners),
              ids.begin() + std::ptrdiff_t((i + 1) * corners));
          }
        };
        take(membership.Owner[i], true);
        for (std::int64_t b = membership.BorrowerStart[i];
             borrowed && b < membership.BorrowerStart[i + 1]; ++b)
        {
          take(membership.Borrowers[std::size_t(b)], false);
        }
      }
    }
  }

  Piece finish(const Draft& draft, const PieceOptions& options) const
  {
    Piece piece;
    const std::vector<std::int64_t> ofOwned = sortedUnique(draft.Corners);
    std::vector<std::int64_t> owned;
    std::set_union(ofOwned.begin(), ofOwned.end(), draft.OwnPoints.begin(), draft.OwnPoints.end(),
      std::back_inserter(owned));
    std::vector<std::int64_t> ghosts;
    const std::vector<std::int64_t> ofBorrowed = sortedUnique(draft.BorrowedCorners);
    std::set_difference(
      ofBorrowed.begin(), ofBorrowed.end(), owned.begin(), owned.end(), std::back_inserter(ghosts));
    piece.CellSize = this->Flat.CellSize;
    piece.PointType = this->Flat.Points.Type;
    piece.OwnedPoints = std::int64_t(owned.size());
    piece.Points = piece.OwnedPoints + std::int64_t(ghosts.size());
    piece.OwnedCells = std::int64_t(draft.Cells.size());
    piece.Cells = piece.OwnedCells + std::int64_t(draft.Borrowed.size());
    std::vector<std::int64_t> ids = owned;
    ids.insert(ids.end(), ghosts.begin(), ghosts.end());
    piece.PointIds = bufferOf(ids);
    piece.PointGhosts = Buffer<char>(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      piece.PointGhosts.data()[i] =
        std::binary_search(draft.OwnPoints.begin(), draft.OwnPoints.end(), ids[i]) ? 0 : 1;
    }
    std::vector<std::int64_t> cells = draft.Cells;
    cells.insert(cells.end(), draft.Borrowed.begin(), draft.Borrowed.end());
    piece.CellIds = bufferOf(cells);
    piece.WideIds = true;
    piece.Connectivity =
      Buffer<char>((draft.Corners.size() + draft.BorrowedCorners.size()) * sizeof(std::int64_t));
    auto* to = piece.Connectivity.as<std::int64_t>();
    for (const std::vector<std::int64_t>* const corners :
      { &draft.Corners, &draft.BorrowedCorners })
    {
      for (const std::int64_t id : *corners)
      {
        const auto own = std::lower_bound(owned.begin(), owned.end(), id);
        const bool isOwn = own != owned.end() && *own == id;
        *to++ = isOwn ? own - owned.begin()
                      : piece.OwnedPoints +
            (std::lower_bound(ghosts.begin(), ghosts.end(), id) - ghosts.begin());
      }
    }
    this->loadData(ids, true, options, piece);
    this->loadData(cells, false, options, piece);
    return piece;
  }

  /// Loads the attributes of points, with their coordinates, or of cells.
  void loadData(const std::vector<std::int64_t>& ids, bool ofPoints, const PieceOptions& options,
    Piece& piece) const
  {
    std::vector<RawArray> arrays;
    std::vector<void*> out;
    const auto add = [&](const RawArray& array)
    {
      Buffer<char> values(ids.size() * array.tupleBytes());
      arrays.push_back(array);
      out.push_back(values.data());
      return values;
    };
    Buffer<char> coordinates;
    if (ofPoints)
    {
      coordinates = add(this->Flat.Points);
    }
    for (std::size_t i = 0; i < this->Arrays.size(); ++i)
    {
      if (this->Mesh.Arrays[i].OfPoints == ofPoints && options.wants(this->Mesh, i))
      {
        piece.Attributes.push_back({ this->Mesh.Arrays[i], add(this->Arrays[i]) });
      }
    }
    if (!arrays.empty())
    {
      makeVertexLoader(std::move(arrays), this->loading())
        ->load(ids.data(), ids.size(), out.data());
    }
    if (ofPoints)
    {
      piece.Coordinates = this->Flat.Points.Components == 3
        ? std::move(coordinates)
        : withThird(coordinates, piece.Points, scalarSize(piece.PointType));
    }
  }

  FlatMesh Flat;
  SourceOptions Options;
  std::vector<RawArray> Arrays; ///< the data of Mesh.Arrays
  std::optional<BoxTiling> Tiling;
  std::vector<std::int64_t> PointCounts; ///< number of points of each piece
};

Buffer<char> numbersBelow(std::int64_t count)
{
  Buffer<char> buffer(std::size_t(count) * sizeof(std::int64_t));
  auto* const numbers = buffer.as<std::int64_t>();
  std::iota(numbers, numbers + count, std::int64_t(0));
  return buffer;
}

/// The output of a model as a mesh of one piece, with its time steps. The mesh is read at once, and
/// values when the piece is; missing ones are NaN.
class SeriesPieces : public PieceSource
{
public:
  SeriesPieces(const std::string& path, const SeriesOptions& options)
    : Series(openMeshSeries(path, options))
    , Content(flattenSeries(*this->Series, false))
  {
    this->Mesh.Path = path;
    this->Mesh.CellSize = this->Content.CellSize;
    this->Mesh.PointType = Scalar::Float64;
    this->Mesh.Points = this->Content.Points.Tuples;
    this->Mesh.Cells = std::int64_t(this->Content.Cells.size()) / this->Content.CellSize;
    this->Mesh.Tiling = "grid:1x1";
    this->Mesh.Times = this->Content.Times;
    this->Mesh.Description = this->Content.Description;
    this->describeArrays();
    this->describePiece();
  }

  void prepare(Communicator&) override {}
  std::vector<std::int64_t> weights() const override { return { this->Mesh.Cells }; }

  std::vector<Piece> read(
    const std::vector<std::size_t>& numbers, const PieceOptions& options) override
  {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      pieces.push_back(this->readPiece(options));
    }
    return pieces;
  }

private:
  /// An array of Content, and its step.
  struct Source
  {
    const FlatArray* Array;
    std::int64_t Step;
  };

  void describeArrays()
  {
    for (const bool ofPoints : { true, false })
    {
      for (const FlatArray& array : ofPoints ? this->Content.PointData : this->Content.CellData)
      {
        for (std::int64_t step = 0; step < std::max<std::int64_t>(array.Steps, 1); ++step)
        {
          this->Mesh.Arrays.push_back({ array.Name, ofPoints, array.Type, array.Components,
            array.Steps > 0 ? int(step) : -1 });
          this->Sources.push_back({ &array, step });
        }
      }
    }
    if (const std::string name = repeatedName(this->Mesh.Arrays); !name.empty())
    {
      throw IOError(this->Mesh.Path,
        "has two arrays named " + name +
          ", or one named as a partitioned mesh names its own; rename it.");
    }
  }

  void describePiece()
  {
    Box3 box = Box3::empty();
    const auto* const xy = static_cast<const double*>(this->Content.Points.Values);
    for (std::int64_t i = 0; i < this->Mesh.Points; ++i)
    {
      if (std::isfinite(xy[2 * i]) && std::isfinite(xy[2 * i + 1]))
      {
        box.extend(Point3{ xy[2 * i], xy[2 * i + 1], 0 });
      }
    }
    this->Mesh.Domain = box;
    PieceSummary piece;
    piece.Box = box;
    piece.Extent = box;
    piece.Points = this->Mesh.Points;
    piece.Cells = this->Mesh.Cells;
    this->Mesh.Pieces.push_back(piece);
  }

  Piece readPiece(const PieceOptions& options) const
  {
    const FlatContent& content = this->Content;
    Piece piece;
    piece.CellSize = content.CellSize;
    piece.WideIds = true;
    piece.Points = piece.OwnedPoints = this->Mesh.Points;
    piece.Cells = piece.OwnedCells = this->Mesh.Cells;
    piece.Coordinates = this->coordinates();
    piece.PointIds = numbersBelow(piece.Points);
    piece.PointGhosts = Buffer<char>(std::size_t(piece.Points));
    std::memset(piece.PointGhosts.data(), 0, piece.PointGhosts.size());
    piece.Connectivity = bufferOf(content.Cells);
    piece.CellIds = numbersBelow(piece.Cells);
    for (std::size_t i = 0; i < this->Sources.size(); ++i)
    {
      if (options.wants(this->Mesh, i))
      {
        piece.Attributes.push_back({ this->Mesh.Arrays[i], valuesOf(this->Sources[i]) });
      }
    }
    return piece;
  }

  Buffer<char> coordinates() const
  {
    Buffer<char> buffer(std::size_t(this->Mesh.Points) * sizeof(Point3));
    const auto* const xy = static_cast<const double*>(this->Content.Points.Values);
    for (std::int64_t i = 0; i < this->Mesh.Points; ++i)
    {
      buffer.as<Point3>()[i] = { xy[2 * i], xy[2 * i + 1], 0 };
    }
    return buffer;
  }

  static Buffer<char> valuesOf(const Source& source)
  {
    const FlatArray& array = *source.Array;
    const std::size_t bytes =
      scalarSize(array.Type) * std::size_t(array.Tuples) * std::size_t(array.Components);
    const void* const values =
      array.StepValues ? array.StepValues(source.Step) : array.Values; // Values has one step
    return bufferOf(static_cast<const char*>(values), bytes);
  }

  std::unique_ptr<MeshSeries> Series;
  FlatContent Content;         ///< reads values from Series
  std::vector<Source> Sources; ///< by array of Mesh
};

} // namespace

PieceSource::~PieceSource() = default;

void requireSameMesh(Communicator& ranks, const PartitionedMesh& mesh)
{
  const std::vector<std::uint64_t> all = ranks.allGather(mesh.IndexChecksum);
  if (std::any_of(
        all.begin(), all.end(), [&all](std::uint64_t checksum) { return checksum != all[0]; }))
  {
    throw IOError(mesh.Path,
      "is not the same mesh for all ranks: it was replaced while it was opened, or ranks see other "
      "folders; read it again.");
  }
}

std::unique_ptr<PieceSource> openPieceSource(const std::string& path, const SourceOptions& options)
{
  const bool isSeries = isMeshSeries(path);
  if (!isSeries && (options.Model.Wrap || !options.Model.Values.empty()))
  {
    throw IOError(path,
      std::string("is not the output of a model, which alone takes ") +
        (options.Model.Wrap ? "--wrap" : "--values") + "; leave it out.");
  }
  if (isPartitionedMesh(path))
  {
    return std::make_unique<StoredPieces>(path, options.Threads);
  }
  if (isFlatMesh(path))
  {
    return std::make_unique<FlatPieces>(openFlatMesh(path), options);
  }
  if (isSeries)
  {
    return std::make_unique<SeriesPieces>(path, options.Model);
  }
  throw IOError(path,
    "is neither a partitioned mesh (its folder or index), nor a flat one (a folder of .npy arrays, "
    "or a .vtu file of appended, raw, uncompressed data), nor the output of a model.");
}

void requireSensible(const PartitionedMesh& mesh, const Box3& range)
{
  if (mesh.Points == 0)
  {
    return;
  }
  try
  {
    requireSensible(range, mesh.Domain,
      mesh.CellSize == 3 ? std::vector<int>{ 0, 1 } : std::vector<int>{ 0, 1, 2 });
  }
  catch (const std::runtime_error& error)
  {
    throw IOError(mesh.Path, std::string("is not read: ") + error.what());
  }
}

} // namespace tipp

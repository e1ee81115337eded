// SPDX-License-Identifier: BSD-3-Clause
#include "Resident/ResidentMesh.h"

#include "Files/IOError.h"
#include "Locate/CellLocator.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <numeric>
#include <unordered_set>
#include <utility>
#include <variant>

namespace tipp
{
/// Finds pieces of a stored mesh: by position with a tree of their boxes, and by the global ids of
/// their own cells or points. The mesh has no index of ids, so the id arrays of pieces are read.
/// The range of each piece's ids is remembered, so that later calls read only pieces that may own
/// an id.
class PieceFinder
{
public:
  explicit PieceFinder(const PartitionedMesh& mesh)
    : Mesh(mesh)
  {
    if (this->Mesh.CellSize == 3)
    {
      this->Tree = this->make<2>();
    }
    else
    {
      this->Tree = this->make<3>();
    }
  }

  /// The first piece whose closed box contains a point, or -1.
  std::int32_t find(const Point3& point) const
  {
    return std::visit([&](const auto& tree) { return this->search(tree, point); }, this->Tree);
  }

  /// For each global id, the piece of [firstPiece, endPiece) that owns it, or -1. Throws IOError.
  /// Thread-safe.
  std::vector<std::int32_t> find(const std::vector<std::int64_t>& ids, bool ofPoints, int threads,
    std::size_t firstPiece, std::size_t endPiece) const
  {
    const std::vector<std::int64_t> asked = sortedUnique(ids);
    const GlobalIdMap map(asked.data(), nullptr, asked.size());
    std::vector<std::int32_t> owners(asked.size(), -1);
    std::vector<IdRange> ranges;
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Ranges[ofPoints].resize(this->Mesh.Pieces.size());
      ranges = this->Ranges[ofPoints];
    }
    // Searches pieces with a known range of ids first, since these may own all ids.
    std::vector<std::size_t> order(endPiece - firstPiece);
    std::iota(order.begin(), order.end(), firstPiece);
    std::stable_partition(order.begin(), order.end(),
      [&ranges](std::size_t piece) { return ranges[piece].High != INT64_MAX; });
    std::atomic<std::size_t> missing{ asked.size() };
    forChunks(std::int64_t(order.size()), 1, threads, {},
      [&](std::int64_t i, std::int64_t, int)
      {
        poll();
        const std::size_t piece = order[std::size_t(i)];
        IdRange& range = ranges[piece];
        const auto first = std::lower_bound(asked.begin(), asked.end(), range.Low);
        if (missing == 0 || first == asked.end() || *first > range.High)
        {
          return;
        }
        const std::vector<std::int64_t> own = this->read(piece, ofPoints);
        range = own.empty() ? IdRange{ INT64_MAX, -1 }
                            : IdRange{ *std::min_element(own.begin(), own.end()),
                                *std::max_element(own.begin(), own.end()) };
        for (const std::int64_t id : own)
        {
          const std::int64_t at = map.find(id);
          if (at >= 0)
          {
            owners[std::size_t(at)] = std::int32_t(piece);
            --missing;
          }
        }
      });
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Ranges[ofPoints] = ranges;
    }
    std::vector<std::int32_t> result;
    result.reserve(ids.size());
    for (const std::int64_t id : ids)
    {
      result.push_back(owners[std::size_t(map.find(id))]);
    }
    return result;
  }

private:
  struct IdRange
  {
    std::int64_t Low = 0;
    std::int64_t High = INT64_MAX;
  };

  /// Reads the global ids of the cells or points that a piece owns.
  std::vector<std::int64_t> read(std::size_t piece, bool ofPoints) const
  {
    return readUnchanged(this->Mesh, [&] { return this->readIds(piece, ofPoints); });
  }

  std::vector<std::int64_t> readIds(std::size_t piece, bool ofPoints) const
  {
    const PieceFile file(this->Mesh, piece);
    // Borrowed cells are in the last part of the piece, if they are duplicated.
    const std::size_t parts =
      file.partStarts(ofPoints).size() - 1 - (this->Mesh.Duplicated ? 1 : 0);
    const auto count = std::size_t(file.partStarts(ofPoints)[parts]);
    std::vector<std::int64_t> ids(count);
    file.read(file.find(ofPoints ? PieceRole::PointIds : PieceRole::CellIds), 0, parts, ids.data());
    file.requireIds(ids.data(), count, ofPoints ? this->Mesh.Points : this->Mesh.Cells);
    if (ofPoints)
    {
      std::vector<std::uint8_t> ghosts(count);
      file.read(file.find(PieceRole::PointGhosts), 0, parts, ghosts.data());
      std::size_t own = 0;
      for (std::size_t i = 0; i < count; ++i)
      {
        ids[own] = ids[i];
        own += ghosts[i] == 0 ? 1 : 0;
      }
      ids.resize(own);
    }
    return ids;
  }

  template <int D>
  BoxTree<D> make() const
  {
    return BoxTree<D>(std::int64_t(this->Mesh.Pieces.size()), 1,
      [this](std::int64_t i) { return projected<D>(this->Mesh.Pieces[std::size_t(i)].Box); });
  }

  template <int D>
  std::int32_t search(const BoxTree<D>& tree, const Point3& point) const
  {
    std::int32_t found = -1;
    const Point<D> at = projected<D>(point);
    const auto offer = [&](std::int32_t piece)
    {
      const Box<D> box = projected<D>(this->Mesh.Pieces[std::size_t(piece)].Box);
      found = (found < 0 || piece < found) && box.contains(at) ? piece : found;
    };
    if (isFinite(at))
    {
      tree.search(Box<D>::of(at), offer);
    }
    return found;
  }

  const PartitionedMesh& Mesh;
  std::variant<BoxTree<2>, BoxTree<3>> Tree;
  mutable std::mutex Mutex;
  mutable std::vector<IdRange> Ranges[2]; ///< ranges of cells, ranges of points; by piece
};

namespace
{

constexpr const char* elevation = "elevation";

PartitionedMesh describe(const MeshPart& part, int threads)
{
  PartitionedMesh mesh;
  mesh.CellSize = part.Mesh.Dimension + 1;
  mesh.PointType = part.Mesh.Float ? Scalar::Float32 : Scalar::Float64;
  mesh.Points = part.Mesh.PointCount;
  mesh.Cells = part.OwnedCells;
  for (const MeshPart::Array& array : part.Arrays)
  {
    mesh.Arrays.push_back(array.Description);
  }
  withAccess(part.Mesh,
    [&](const auto& access)
    {
      mesh.Domain = boundsOf<3>(part.Mesh.PointCount, threads,
        [&](std::int64_t i)
        {
          Point3 at = access.point(i);
          at.z = part.Mesh.Dimension == 3 ? at.z : 0; // the z of triangles may be NaN
          return Box3::of(at);
        });
    });
  mesh.Pieces.emplace_back();
  mesh.Pieces[0].Points = mesh.Points;
  mesh.Pieces[0].Cells = mesh.Cells;
  return mesh;
}

} // namespace

ResidentMesh::ResidentMesh(const std::string& path, const ResidentOptions& options)
  : ResidentMesh(openPartitionedMesh(path), {}, options)
{
}

ResidentMesh::ResidentMesh(const MeshPart& part, const ResidentOptions& options)
  : ResidentMesh(tipp::describe(part, threadCount(options.Threads)),
      { { std::make_shared<const MeshPart>(part), nullptr, nullptr, {} } }, options)
{
}

ResidentMesh::ResidentMesh(const ResidentMesh& mesh, ResidentPiece piece)
  : ResidentMesh(mesh.Mesh, { std::move(piece) }, mesh.Options)
{
}

ResidentMesh::ResidentMesh(
  PartitionedMesh mesh, std::vector<ResidentPiece> inMemory, const ResidentOptions& options)
  : InMemory(std::move(inMemory))
  , Mesh(std::move(mesh))
  , Options(options)
  , Finder(isStored() ? std::make_shared<const PieceFinder>(this->Mesh) : nullptr)
  , Resident(
      isStored() ? options.MemoryLimit : std::numeric_limits<std::uint64_t>::max() / 2,
      [this](std::size_t number, const PieceNeeds& needs) { return this->estimate(number, needs); },
      [this](std::size_t number, const PieceNeeds& needs, const ResidentPiece& before)
      { return this->load(number, needs, before); },
      [this](std::size_t number, std::uint64_t bytes) { this->refusePiece(number, bytes); })
{
  for (std::size_t i = 0; i < this->Mesh.Arrays.size(); ++i)
  {
    const StoredArray& array = this->Mesh.Arrays[i];
    if (array.Step < 0 || array.Step == options.Step)
    {
      this->ByName.try_emplace(array.Name, i);
    }
  }
  const auto steps = std::int64_t(this->Mesh.Times.size());
  if (this->isStored() && options.Step != 0 && (options.Step < 0 || options.Step >= steps))
  {
    this->refuse("has no time step " + std::to_string(options.Step) + "; there are " +
      std::to_string(steps) + ", counted from 0.");
  }
}

std::int32_t ResidentMesh::addPiece(MeshPart part) const
{
  this->InMemory.push_back(
    { std::make_shared<const MeshPart>(std::move(part)), nullptr, nullptr, {} });
  return std::int32_t(this->InMemory.size() - 1);
}

std::vector<std::string> ResidentMesh::names() const
{
  std::vector<std::string> names;
  std::unordered_set<std::string> known;
  for (const StoredArray& array : this->Mesh.Arrays)
  {
    if (known.insert(array.Name).second)
    {
      names.push_back(array.Name);
    }
  }
  if (this->Mesh.CellSize == 3 && known.count(elevation) == 0)
  {
    names.insert(names.begin(), elevation);
  }
  return names;
}

const StoredArray* ResidentMesh::find(const std::string& name) const
{
  const auto found = this->ByName.find(name);
  if (found != this->ByName.end())
  {
    return &this->Mesh.Arrays[found->second];
  }
  const std::vector<std::string> known = this->names();
  if (name != elevation || std::find(known.begin(), known.end(), name) == known.end())
  {
    this->refuse("has no array '" + name + "'" +
      listOfNames({ known.begin(), known.end() }, "; there are ") + ".");
  }
  return nullptr;
}

const StoredArray* ResidentMesh::fieldOf(
  const std::string& name, int component, bool allowsCells) const
{
  if (this->Mesh.CellSize != 3)
  {
    this->refuse("has tetrahedra; ask this of a mesh of triangles.");
  }
  const StoredArray* const array = this->find(name);
  if (array && !array->OfPoints && !allowsCells)
  {
    this->refuse("has '" + name + "' at cells; this needs an array of points.");
  }
  if (component < 0 || component >= (array ? array->Components : 1))
  {
    this->refuse("has no component " + std::to_string(component) + " of '" + name + "'.");
  }
  return array;
}

PieceNeeds ResidentMesh::needsOf(const std::vector<std::string>& names) const
{
  PieceNeeds needs;
  needs.Arrays.assign(this->Mesh.Arrays.size(), false);
  for (const std::string& name : names)
  {
    if (const StoredArray* const array = this->find(name))
    {
      needs.Arrays[std::size_t(array - this->Mesh.Arrays.data())] = true;
    }
  }
  return needs;
}

std::vector<StoredArray> ResidentMesh::describe(const std::vector<std::string>& names) const
{
  std::vector<StoredArray> arrays;
  for (const std::string& name : names)
  {
    const StoredArray* const array = this->find(name);
    arrays.push_back(array ? *array : StoredArray{ name, true, this->Mesh.PointType });
  }
  return arrays;
}

std::uint64_t ResidentMesh::bytesOf(const PieceNeeds& needs, bool ofPoints) const
{
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < needs.Arrays.size(); ++i)
  {
    const StoredArray& array = this->Mesh.Arrays[i];
    bytes += needs.Arrays[i] && array.OfPoints == ofPoints
      ? std::uint64_t(array.Components) * scalarSize(array.Type)
      : 0;
  }
  return bytes;
}

std::uint64_t ResidentMesh::estimate(std::size_t number, const PieceNeeds& needs) const
{
  if (!this->isStored())
  {
    return 0;
  }
  const PieceSummary& piece = this->Mesh.Pieces[number];
  const auto cells = std::uint64_t(piece.Cells + piece.BorrowedCells);
  const auto points = std::uint64_t(piece.Points + piece.BorrowedCells);
  // Includes a pass over the cells, which needs a position per point.
  const std::uint64_t ofPoint =
    3 * scalarSize(this->Mesh.PointType) + 8 + 1 + 6 + this->bytesOf(needs, true);
  const std::uint64_t ofCell =
    std::uint64_t(this->Mesh.CellSize) * 4 + 8 + this->bytesOf(needs, false);
  std::uint64_t bytes = points * ofPoint + cells * ofCell;
  bytes += needs.Locator
    ? std::uint64_t(CellLocator::bytesFor(std::int64_t(cells), this->Mesh.CellSize - 1))
    : 0;
  bytes += needs.Topology ? PartTopology::bytesFor(points, cells, this->Mesh.CellSize) : 0;
  return bytes;
}

void ResidentMesh::refusePiece(std::size_t number, std::uint64_t bytes) const
{
  const auto text = [](std::uint64_t b)
  {
    return b >> 20 > 1 ? std::to_string((b + (1 << 20) - 1) >> 20) + " MB"
                       : std::to_string(b) + " bytes";
  };
  throw IOError(this->Mesh.Path,
    "needs " + text(bytes) + " of memory for this query, for piece " + std::to_string(number) +
      " alone, but the limit is " + text(this->Options.MemoryLimit) +
      "; raise it, or partition the mesh into smaller pieces.");
}

ResidentPiece ResidentMesh::load(
  std::size_t number, const PieceNeeds& needs, const ResidentPiece& before) const
{
  ResidentPiece piece = before;
  PieceNeeds arrays;
  arrays.Arrays = needs.Arrays;
  if (!this->isStored())
  {
    piece = before.Part ? before : this->InMemory[number];
  }
  else if (!piece.Part || !before.Has.cover(arrays))
  {
    PieceOptions options;
    options.Step = this->Options.Step;
    options.Wanted = needs.Arrays;
    options.Wanted.resize(this->Mesh.Arrays.size());
    piece = {};
    piece.Part = std::make_shared<const MeshPart>(partOf(readPiece(this->Mesh, number, options)));
  }
  const MeshPart& part = *piece.Part;
  if (needs.Locator && !piece.Locator)
  {
    // For a stored mesh, several threads may be making locators for different pieces.
    const int threads = this->isStored() ? 1 : threadCount(this->Options.Threads);
    piece.Locator = std::make_shared<const CellLocator>(part.Mesh, part.CellIds, threads);
  }
  if (needs.Topology && !piece.Topology)
  {
    piece.Topology = std::make_shared<const PartTopology>(part);
  }
  return piece;
}

std::vector<std::int32_t> ResidentMesh::piecesOf(const Point3* points, std::int64_t count) const
{
  std::vector<std::int32_t> pieces(std::size_t(count), 0);
  if (this->isStored())
  {
    forChunks(count, 1 << 12, threadCount(this->Options.Threads), {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
        {
          pieces[i] = this->Finder->find(points[i]);
        }
      });
  }
  return pieces;
}

std::vector<std::int32_t> ResidentMesh::piecesAround(
  const std::vector<std::int64_t>&, const std::vector<Point3>& positions) const
{
  return this->piecesOf(positions.data(), std::int64_t(positions.size()));
}

void ResidentMesh::refuseId(std::int64_t id, bool ofPoints) const
{
  const std::string item = ofPoints ? "point" : "cell";
  this->refuse("has no " + item + " " + std::to_string(id) + "; ids are from 0 to " +
    std::to_string((ofPoints ? this->Mesh.Points : this->Mesh.Cells) - 1) + ".");
}

void ResidentMesh::refuse(const std::string& problem) const
{
  throw this->isStored() ? IOError(this->Mesh.Path, problem) : IOError("The mesh " + problem);
}

std::vector<std::int32_t> ResidentMesh::piecesOfIds(
  const std::vector<std::int64_t>& ids, bool ofPoints, std::size_t first, std::size_t end) const
{
  if (!this->isStored())
  {
    return std::vector<std::int32_t>(ids.size(), 0); // the topology refuses ids that do not exist
  }
  const std::int64_t count = ofPoints ? this->Mesh.Points : this->Mesh.Cells;
  for (const std::int64_t id : ids)
  {
    if (id < 0 || id >= count)
    {
      this->refuseId(id, ofPoints);
    }
  }
  return this->Finder->find(ids, ofPoints, threadCount(this->Options.Threads), first, end);
}

} // namespace tipp

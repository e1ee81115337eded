// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/MeshTiling.h"

#include "Arrays/Buffer.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/TextFile.h"
#include "Parallel/ParallelFor.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <string_view>

namespace tipp
{

std::optional<TilingChoice> TilingChoice::parse(const std::string& text)
{
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string kind = text.substr(0, colon);
  const std::string_view rest = std::string_view(text).substr(std::min(colon + 1, text.size()));
  TilingChoice choice;
  if (kind == "quadtree" || kind == "octree")
  {
    choice.Threshold = wholeNumber<std::int64_t>(rest).value_or(0);
    return choice.Threshold >= 1 ? std::make_optional(choice) : std::nullopt;
  }
  std::vector<std::string_view> counts;
  splitFields(rest, 'x', counts);
  constexpr int most = 10000;
  bool isValid = kind == "grid" && (counts.size() == 2 || counts.size() == 3);
  for (std::size_t axis = 0; isValid && axis < counts.size(); ++axis)
  {
    choice.Boxes[axis] = wholeNumber<int>(counts[axis]).value_or(0);
    isValid = choice.Boxes[axis] >= 1 && choice.Boxes[axis] <= most;
  }
  return isValid ? std::make_optional(choice) : std::nullopt;
}

TilingChoice TilingChoice::require(const std::string& text)
{
  const std::optional<TilingChoice> choice = parse(text);
  return choice ? *choice
                : throw IOError("Tiling is '" + text +
                    "'; it is grid:COLUMNSxROWS[xLAYERS] or quadtree:CELLS.");
}

std::string TilingChoice::text(int dimension) const
{
  if (this->Threshold > 0)
  {
    return (dimension == 2 ? "quadtree:" : "octree:") + std::to_string(this->Threshold);
  }
  std::string counts = std::to_string(this->Boxes[0]) + "x" + std::to_string(this->Boxes[1]);
  if (dimension == 3)
  {
    counts += "x" + std::to_string(this->Boxes[2]);
  }
  return "grid:" + counts;
}

namespace
{

constexpr std::int64_t blockPoints = 1 << 16;

/// Calls work(first point, count, coordinates) for blocks of this rank's share.
template <typename Work>
void forEachBlock(const FlatMesh& mesh, Communicator& ranks, int threads, const Work& work)
{
  const InputFile file(mesh.Points.Path);
  const auto [from, to] = ranks.shareOf(mesh.Points.Tuples);
  const std::int64_t blocks = (to - from + blockPoints - 1) / blockPoints;
  parallelFor(blocks, threads,
    [&, from = from, to = to](std::int64_t block)
    {
      poll();
      const std::int64_t first = from + block * blockPoints;
      const std::int64_t count = std::min(blockPoints, to - first);
      std::vector<char> raw(std::size_t(count) * mesh.Points.tupleBytes());
      file.read(mesh.Points.Offset + std::uint64_t(first) * mesh.Points.tupleBytes(), raw.data(),
        raw.size());
      const int dimension = mesh.CellSize - 1;
      std::vector<double> coordinates(std::size_t(count) * std::size_t(dimension));
      takeCoordinates(mesh.Points, raw.data(), std::size_t(count), dimension, coordinates.data());
      work(block, first, count, coordinates.data());
    });
}

bool isFinite(const double* point, std::size_t dimension)
{
  return std::all_of(point, point + dimension, [](double value) { return std::isfinite(value); });
}

/// Points that are not finite are left out. If a cell has one, loadCoordinates() fails.
Box3 boundsOfFinite(const FlatMesh& mesh, std::int64_t count, const double* values)
{
  const std::size_t dimension = std::size_t(mesh.CellSize) - 1;
  Box3 box = Box3::empty();
  for (std::size_t i = 0; i < std::size_t(count); ++i)
  {
    Point3 point{};
    std::copy_n(values + i * dimension, dimension, &point.x);
    if (isFinite(point))
    {
      box.extend(point);
    }
  }
  return box;
}

void requirePieces(std::int64_t boxes, const FlatMesh& mesh)
{
  if (boxes > mostPieces)
  {
    throw IOError(mesh.Path,
      "would be cut into " + std::to_string(boxes) + " pieces, more than the " +
        std::to_string(mostPieces) + " that a mesh can have; choose a coarser tiling.");
  }
}

/// Greedy runs of weight at most `most`, which no single piece exceeds, leaving at least one piece
/// for each later rank. The last rank gets the rest.
std::vector<std::size_t> runsOf(
  const std::vector<std::int64_t>& weights, std::size_t ranks, std::int64_t most)
{
  std::vector<std::size_t> starts = { 0 };
  std::size_t piece = 0;
  for (std::size_t later = ranks - 1; later > 0; --later)
  {
    const std::size_t end = weights.size() > later ? weights.size() - later : 0;
    std::int64_t sum = 0;
    const std::size_t first = piece;
    for (; piece < end && weights[piece] <= most - sum; ++piece)
    {
      sum += weights[piece];
    }
    // With fewer pieces than ranks, the first ranks get one each.
    piece = std::min(std::max(piece, first + 1), weights.size());
    starts.push_back(piece);
  }
  starts.push_back(weights.size());
  return starts;
}

} // namespace

RefinementTree::RefinementTree(int dimension, const Box3& domain)
  : Dimension(dimension)
  , ChildCount(BoxTiling::childCount(dimension, domain))
  , FirstChild{ -1 }
  , Boxes{ domain }
  , Depths{ 0 }
{
}

double RefinementTree::length(std::int32_t node) const
{
  const Box3& box = this->box(node);
  double longest = 0.0;
  for (std::size_t axis = 0; axis < std::size_t(this->Dimension); ++axis)
  {
    longest = std::max(longest, box.width(axis));
  }
  return longest;
}

bool RefinementTree::canSplit(std::int32_t node) const
{
  if (this->ChildCount == 1 || this->Depths[at(node)] >= BoxTiling::MaxDepth)
  {
    return false;
  }
  const Box3& box = this->box(node);
  const Box3 lowest = BoxTiling::childBox(this->Dimension, this->domain(), box, 0);
  for (std::size_t axis = 0; axis < std::size_t(this->Dimension); ++axis)
  {
    const bool cut = this->domain().Min[axis] < this->domain().Max[axis];
    const double middle = lowest.Max[axis];
    if (cut && (middle <= box.Min[axis] || middle >= box.Max[axis]))
    {
      return false;
    }
  }
  return true;
}

void RefinementTree::split(std::int32_t leaf)
{
  constexpr std::size_t most = std::size_t(1) << 24;
  if (this->size() + std::size_t(this->ChildCount) > most)
  {
    throw IOError("The tree of partitions would have more than " + std::to_string(most) +
      " nodes; allow more cells a partition.");
  }
  this->FirstChild[at(leaf)] = std::int32_t(this->size());
  const auto depth = std::uint8_t(this->Depths[at(leaf)] + 1);
  for (int which = 0; which < this->ChildCount; ++which)
  {
    this->Boxes.push_back(
      BoxTiling::childBox(this->Dimension, this->domain(), this->box(leaf), which));
    this->FirstChild.push_back(-1);
    this->Depths.push_back(depth);
  }
}

std::string RefinementTree::structure() const
{
  std::string letters;
  letters.reserve(this->size());
  const auto add = [&](const auto& self, std::int32_t node) -> void
  {
    letters.push_back(this->isLeaf(node) ? '0' : '1');
    for (int which = 0; which < this->ChildCount && !this->isLeaf(node); ++which)
    {
      self(self, this->firstChild(node) + which);
    }
  };
  add(add, 0);
  return letters;
}

void RefinementTree::refine(const std::string& structure)
{
  // Stack of nodes whose letter has not been read, the next one last.
  std::vector<std::int32_t> waiting = { 0 };
  const auto require = [](bool isValid)
  {
    if (!isValid)
    {
      throw IOError("A rank sent nodes that do not make a tree of partitions.");
    }
  };
  for (const char letter : structure)
  {
    require(!waiting.empty() && (letter == '0' || letter == '1'));
    const std::int32_t node = waiting.back();
    waiting.pop_back();
    if (letter == '0')
    {
      continue;
    }
    require(this->Depths[at(node)] < BoxTiling::MaxDepth);
    if (this->isLeaf(node))
    {
      this->split(node);
    }
    for (int which = this->ChildCount - 1; which >= 0; --which)
    {
      waiting.push_back(this->firstChild(node) + which);
    }
  }
  require(waiting.empty());
}

BoxTiling RefinementTree::tiling(const std::function<bool(std::int32_t)>& keep) const
{
  std::vector<std::int32_t> nodes = { -1 };
  const auto add = [&](const auto& self, std::int32_t from, std::size_t to) -> void
  {
    if (this->isLeaf(from) || !keep(from))
    {
      return;
    }
    const std::size_t first = nodes.size();
    nodes[to] = std::int32_t(first);
    nodes.insert(nodes.end(), std::size_t(this->ChildCount), -1);
    for (int which = 0; which < this->ChildCount; ++which)
    {
      self(self, this->firstChild(from) + which, first + std::size_t(which));
    }
  };
  add(add, 0, 0);
  return BoxTiling::tree(this->Dimension, this->domain(), nodes);
}

Box3 boundsOfPoints(const FlatMesh& mesh, Communicator& ranks, int threads)
{
  Box3 all = Box3::empty();
  ranks.attempt(
    [&]
    {
      const auto [from, to] = ranks.shareOf(mesh.Points.Tuples);
      std::vector<Box3> blocks(std::size_t((to - from + blockPoints - 1) / blockPoints));
      forEachBlock(mesh, ranks, threads,
        [&](std::int64_t block, std::int64_t, std::int64_t count, const double* values)
        { blocks[std::size_t(block)] = boundsOfFinite(mesh, count, values); });
      for (const Box3& block : blocks)
      {
        all.extend(block);
      }
    });
  const Box3 box = ranks.boundsOfAll(all);
  if (mesh.Points.Tuples > 0 && box.isEmpty())
  {
    throw IOError(mesh.Path, "has no point with finite coordinates.");
  }
  return box;
}

void writeOwners(const FlatMesh& mesh, const BoxTiling& tiling, const std::string& path,
  Communicator& ranks, int threads)
{
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        const OutputFile made(path);
      }
    });
  ranks.attempt(
    [&]
    {
      const OutputFile file = OutputFile::shared(path);
      const std::size_t dimension = std::size_t(mesh.CellSize) - 1;
      forEachBlock(mesh, ranks, threads,
        [&](std::int64_t, std::int64_t first, std::int64_t count, const double* values)
        {
          std::vector<std::int32_t> owners(std::size_t(count), -1);
          for (std::size_t i = 0; i < owners.size(); ++i)
          {
            Box3 point;
            std::copy_n(values + i * dimension, dimension, &point.Min.x);
            point.Max = point.Min;
            int met = 0;
            std::int32_t owner = 0;
            if (isFinite(values + i * dimension, dimension)) // else no cell has it
            {
              tiling.forEachMeeting(
                point, [&](std::int32_t id) { owner = met++ == 0 ? id : owner; });
            }
            owners[i] = met == 1 ? owner : -1 - owner;
          }
          file.write(std::uint64_t(first) * 4, owners.data(), owners.size() * 4);
        });
    });
}

std::vector<double> loadCoordinates(
  const FlatMesh& mesh, VertexLoader& loader, const std::vector<std::int64_t>& ids)
{
  poll();
  Buffer<char> raw(ids.size() * mesh.Points.tupleBytes());
  void* const out[] = { raw.data() };
  loader.load(ids.data(), ids.size(), out);
  const int dimension = mesh.CellSize - 1;
  std::vector<double> coordinates(ids.size() * std::size_t(dimension));
  takeCoordinates(mesh.Points, raw.data(), ids.size(), dimension, coordinates.data());
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (!isFinite(coordinates.data() + i * std::size_t(dimension), std::size_t(dimension)))
    {
      throw IOError(mesh.Points.Path,
        "point " + std::to_string(ids[i]) +
          " has a coordinate that is not finite; leave such points out.");
    }
  }
  return coordinates;
}

BoxTiling makeTiling(const FlatMesh& mesh, const TilingChoice& choice, const LoaderOptions& loading,
  std::int64_t chunkCells, int threads, Communicator& ranks, const Box3& domain)
{
  const int dimension = mesh.CellSize - 1;
  if (choice.Threshold == 0)
  {
    std::array<int, 3> boxes = choice.Boxes;
    // In 2D there is no third axis to split.
    boxes[2] = dimension == 2 ? 1 : boxes[2];
    requirePieces(std::int64_t(boxes[0]) * boxes[1] * boxes[2], mesh);
    return BoxTiling::grid(dimension, domain, boxes);
  }
  // Chunks are loaded with their coordinates, because the points' owners are not known yet.
  std::optional<CellReader> reader;
  std::unique_ptr<VertexLoader> loader;
  ranks.attempt(
    [&]
    {
      reader.emplace(mesh, threads);
      loader = makeVertexLoader({ mesh.Points }, loading);
    });
  std::vector<std::int64_t> ids;
  const CellSource source{ dimension, mesh.CellSize, mesh.Cells.Tuples,
    [&](std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
    {
      reader->read(first, count, ids);
      std::vector<double>().swap(coordinates); // frees the previous chunk before the next is loaded
      coordinates = loadCoordinates(mesh, *loader, ids);
    } };
  const TreeOptions options{ choice.Threshold, chunkCells, threads };
  BoxTiling tiling = buildTree(source, domain, options, ranks.controller());
  requirePieces(tiling.count(), mesh);
  return tiling;
}

void setPieces(PartitionedMesh& mesh, const Box3& domain, const BoxTiling& tiling)
{
  mesh.Domain = domain;
  mesh.Pieces.assign(std::size_t(tiling.count()), {});
  for (std::int64_t i = 0; i < tiling.count(); ++i)
  {
    mesh.Pieces[std::size_t(i)].Box = tiling.box(i);
  }
}

std::vector<std::size_t> assignPieces(std::vector<std::int64_t> weights, int ranks)
{
  std::int64_t low = 0;
  std::int64_t high = 0;
  for (std::int64_t& weight : weights)
  {
    weight = std::max<std::int64_t>(weight, 0);
    low = std::max(low, weight);
    high += weight;
  }
  const auto count = std::size_t(std::max(ranks, 1));
  // Bisection for the least possible weight of the heaviest run.
  while (low < high)
  {
    const std::int64_t most = low + (high - low) / 2;
    const auto last = std::ptrdiff_t(runsOf(weights, count, most)[count - 1]);
    if (std::accumulate(weights.begin() + last, weights.end(), std::int64_t(0)) <= most)
    {
      high = most;
    }
    else
    {
      low = most + 1;
    }
  }
  return runsOf(weights, count, low);
}

} // namespace tipp

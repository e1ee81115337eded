// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/MakeTiling.h"

#include "Files/IOError.h"
#include "Flat/CellReader.h"
#include "Parallel/Poll.h"
#include "Partitioning/BuildTree.h"
#include "Partitioning/PointCoordinates.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

/// Loads chunks of cells with their coordinates, for building the tree: the points' owners are not
/// known yet.
class LoadedCells
{
public:
  LoadedCells(const FlatMesh& mesh, const LoaderOptions& loading, int threads)
    : Mesh(mesh)
    , Reader(mesh, 0, -1, threads)
    , Loader(makeVertexLoader({ mesh.Points }, loading))
  {
  }

  void read(std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
  {
    const RawArray& points = this->Mesh.Points;
    this->Ids.resize(std::size_t(count) * std::size_t(this->Mesh.CellSize));
    this->Reader.read(first, count, this->Ids.data());
    this->Raw.resize(this->Ids.size() * points.tupleBytes());
    void* const out[] = { this->Raw.data() };
    poll();
    this->Loader->load(this->Ids.data(), this->Ids.size(), out);
    const int dimension = this->Mesh.CellSize - 1;
    coordinates.resize(this->Ids.size() * std::size_t(dimension));
    takeCoordinates(points, this->Raw.data(), this->Ids.size(), dimension, coordinates.data());
  }

private:
  const FlatMesh& Mesh;
  CellReader Reader;
  std::unique_ptr<VertexLoader> Loader;
  std::vector<std::int64_t> Ids;
  std::vector<char> Raw;
};

void requirePieces(std::int64_t boxes, const FlatMesh& mesh)
{
  if (boxes > mostPieces)
  {
    throw IOError(mesh.Path,
      "would be cut into " + std::to_string(boxes) + " pieces, more than the " +
        std::to_string(mostPieces) + " that a mesh can have; choose a coarser tiling.");
  }
}

Bounds boundsOf(const Box3& box)
{
  return { box.Min[0], box.Max[0], box.Min[1], box.Max[1], box.Min[2], box.Max[2] };
}

} // namespace

BoxTiling makeTiling(const FlatMesh& mesh, const TilingChoice& choice, const LoaderOptions& loading,
  std::int64_t chunkCells, int threads, const Ranks& ranks, const Box3& domain)
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
  std::optional<LoadedCells> loaded;
  ranks.attempt([&] { loaded.emplace(mesh, loading, threads); });
  const CellSource source{ dimension, mesh.CellSize, mesh.Cells.Tuples,
    [&](std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
    { loaded->read(first, count, coordinates); } };
  TreeOptions options;
  options.Dimension = dimension;
  options.Threshold = choice.Threshold;
  options.ChunkCells = chunkCells;
  options.Threads = threads;
  BoxTiling tiling = buildTree(source, domain, options, ranks.controller()).Tiling;
  requirePieces(tiling.count(), mesh);
  return tiling;
}

void setPieces(PartitionedMesh& mesh, const Box3& domain, const BoxTiling& tiling)
{
  mesh.Domain = boundsOf(domain);
  mesh.Pieces.assign(std::size_t(tiling.count()), {});
  for (std::int64_t i = 0; i < tiling.count(); ++i)
  {
    mesh.Pieces[std::size_t(i)].Box = boundsOf(tiling.box(i));
  }
}

} // namespace tipp

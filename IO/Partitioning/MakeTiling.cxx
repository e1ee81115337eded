// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/MakeTiling.h"

#include "Flat/CellReader.h"
#include "Partitioning/BuildTree.h"
#include "Partitioning/PartitionRun.h"
#include "Partitioning/PointCoordinates.h"

#include <optional>

namespace tipp
{
namespace
{

/// Chunks of cells with all coordinates, for the tree, which has no homes yet.
class LoadedCells
{
public:
  explicit LoadedCells(const PartitionRun& run)
    : Run(run)
    , Reader(run.Mesh, 0, -1, run.Threads)
    , Loader(makeVertexLoader({ run.Mesh.Points }, run.loaderOptions()))
  {
  }

  void read(std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
  {
    const RawArray& points = this->Run.Mesh.Points;
    this->Ids.resize(std::size_t(count) * std::size_t(this->Run.Rows.Corners));
    this->Reader.read(first, count, this->Ids.data());
    this->Raw.resize(this->Ids.size() * points.tupleBytes());
    void* const out[] = { this->Raw.data() };
    this->Loader->load(this->Ids.data(), this->Ids.size(), out);
    const int dimension = this->Run.Rows.Dimension;
    coordinates.resize(this->Ids.size() * std::size_t(dimension));
    takeCoordinates(points, this->Raw.data(), this->Ids.size(), dimension, coordinates.data());
  }

private:
  const PartitionRun& Run;
  CellReader Reader;
  std::unique_ptr<VertexLoader> Loader;
  std::vector<std::int64_t> Ids;
  std::vector<char> Raw;
};

} // namespace

BoxTiling makeTiling(const PartitionRun& run, const Box3& domain)
{
  const TilingChoice& choice = run.Options.Tiling;
  if (choice.Threshold == 0)
  {
    std::array<int, 3> boxes = choice.Boxes;
    // The plane has no third axis to cut.
    boxes[2] = run.Rows.Dimension == 2 ? 1 : boxes[2];
    return BoxTiling::grid(run.Rows.Dimension, domain, boxes);
  }
  std::optional<LoadedCells> loaded;
  run.Team.attempt([&] { loaded.emplace(run); });
  const CellSource source{ run.Rows.Dimension, run.Rows.Corners, run.Mesh.Cells.Tuples,
    [&](std::int64_t first, std::int64_t count, std::vector<double>& coordinates)
    { loaded->read(first, count, coordinates); } };
  TreeOptions options;
  options.Dimension = run.Rows.Dimension;
  options.Threshold = choice.Threshold;
  // A chunk here has its coordinates in memory twice beside its ids.
  options.ChunkCells = std::max<std::int64_t>(1, run.ChunkCells / 4);
  options.Threads = run.Threads;
  return buildTree(source, domain, options, run.Team.controller()).Tiling;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "ExpectIOError.h"
#include "Flat/FlatMesh.h"
#include "Partitioning/PartitionMesh.h"
#include "Query/Queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

using namespace tipp;
using namespace tipp::test;

namespace
{

using Ids = std::vector<std::int64_t>;

Ids cornersOf(const SourceMesh& source, std::int64_t cell)
{
  const auto begin = source.Cells.begin() + cell * source.CellSize;
  return { begin, begin + source.CellSize };
}

Ids allIds(std::size_t count)
{
  Ids ids(count);
  std::iota(ids.begin(), ids.end(), std::int64_t(0));
  return ids;
}

Ids listOf(const IdLists& lists, std::size_t i)
{
  return { lists.Ids.begin() + lists.Starts[i], lists.Ids.begin() + lists.Starts[i + 1] };
}

/// Neighbour ids by comparing each cell with all others.
Ids neighborsByForce(const SourceMesh& source)
{
  std::map<Ids, Ids> cellsOfFaces;
  const auto faceOf = [&source](std::int64_t cell, int i)
  {
    Ids face = cornersOf(source, cell);
    face.erase(face.begin() + i);
    std::sort(face.begin(), face.end());
    return face;
  };
  for (std::size_t cell = 0; cell < source.cells(); ++cell)
  {
    for (int i = 0; i < source.CellSize; ++i)
    {
      cellsOfFaces[faceOf(std::int64_t(cell), i)].push_back(std::int64_t(cell));
    }
  }
  Ids neighbors;
  for (std::size_t cell = 0; cell < source.cells(); ++cell)
  {
    for (int i = 0; i < source.CellSize; ++i)
    {
      Ids cells = cellsOfFaces[faceOf(std::int64_t(cell), i)];
      cells.erase(std::remove(cells.begin(), cells.end(), std::int64_t(cell)), cells.end());
      neighbors.push_back(cells.empty() ? -1 : *std::min_element(cells.begin(), cells.end()));
    }
  }
  return neighbors;
}

/// The ids of all cells that have one of the points.
std::set<std::int64_t> cellsAt(const SourceMesh& source, const std::set<std::int64_t>& points)
{
  std::set<std::int64_t> cells;
  for (std::size_t i = 0; i < source.Cells.size(); ++i)
  {
    if (points.count(source.Cells[i]) > 0)
    {
      cells.insert(std::int64_t(i) / source.CellSize);
    }
  }
  return cells;
}

std::set<std::int64_t> pointsOf(const SourceMesh& source, const std::set<std::int64_t>& cells)
{
  std::set<std::int64_t> points;
  for (const std::int64_t cell : cells)
  {
    const Ids corners = cornersOf(source, cell);
    points.insert(corners.begin(), corners.end());
  }
  return points;
}

/// A mesh with holes, in memory and stored in several ways. It is made once for all tests.
struct Stored
{
  explicit Stored(SourceMesh source)
    : Source(std::move(source))
  {
    const bool inSpace = this->Source.CellSize == 4;
    store(this->Source, this->path(0), inSpace ? "grid:2x2x2" : "grid:4x4", false);
    store(this->Source, this->path(1), inSpace ? "octree:20" : "quadtree:10", true);
    store(this->Source, this->path(2), inSpace ? "grid:1x3x5" : "grid:7x1", false);
  }
  std::string path(int number) const
  {
    return this->Folder.path("mesh" + std::to_string(number) + ".tipp");
  }

  SourceMesh Source;
  TemporaryFolder Folder;
};

/// Calls work(mesh) for the mesh in memory and for each stored one.
template <typename Work>
void withEach(const Stored& stored, const Work& work)
{
  work(ResidentMesh(inMemory(stored.Source)));
  for (int i = 0; i < 3; ++i)
  {
    SCOPED_TRACE("stored " + std::to_string(i));
    ResidentOptions options;
    options.Threads = 2;
    work(ResidentMesh(stored.path(i), options));
  }
}

/// Meshes with holes, and with parts that touch only at points.
class Around : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    for (const SourceMesh& source :
      { makeSource(latticeTriangles(9, 0.3)), withHoles(makeSource(latticeTriangles(10, 0.2)), 4),
        withHoles(makeSource(latticeTriangles(8, 0)), 2), makeSource(latticeTetrahedra(3, 0.3)),
        withHoles(makeSource(latticeTetrahedra(3, 0)), 3) })
    {
      Scenes.push_back(std::make_unique<Stored>(source));
    }
  }
  static void TearDownTestSuite() { Scenes.clear(); }

  static std::vector<std::unique_ptr<Stored>> Scenes;
};
std::vector<std::unique_ptr<Stored>> Around::Scenes;

} // namespace

TEST_F(Around, NeighborsAreThoseThatShareAFace)
{
  for (const auto& scene : Scenes)
  {
    const SourceMesh& source = scene->Source;
    const Ids expected = neighborsByForce(source);
    withEach(*scene,
      [&](const ResidentMesh& mesh)
      { EXPECT_EQ(expected, neighborsOf(mesh, allIds(source.cells()))); });
  }
}

TEST_F(Around, PartitioningStoresNeighborIds)
{
  for (const auto& scene : Scenes)
  {
    const TemporaryFolder folder;
    writeFlat(scene->Source, folder.path("flat"));
    PartitionOptions options;
    options.Tiling = *TilingChoice::parse("quadtree:15");
    options.Neighbors = true;
    options.MemoryLimit = 1 << 20;
    partitionMesh(openFlatMesh(folder.path("flat")), folder.path("mesh.tipp"), options);
    const ResidentMesh mesh(folder.path("mesh.tipp"));
    const std::vector<std::string> names = mesh.names();
    for (const char* const name : { "NeighborIds", "label", "value" })
    {
      EXPECT_EQ(1, std::count(names.begin(), names.end(), name)) << name;
    }
    EXPECT_EQ(neighborsByForce(scene->Source), neighborsOf(mesh, allIds(scene->Source.cells())));
    const auto left = std::filesystem::directory_iterator(folder.path(""));
    EXPECT_EQ(2, std::distance(begin(left), end(left))); // no temporary files are left
  }
}

TEST_F(Around, StarsAreAllCellsAtAPoint)
{
  for (const auto& scene : Scenes)
  {
    const SourceMesh& source = scene->Source;
    withEach(*scene,
      [&](const ResidentMesh& mesh)
      {
        const IdLists stars = starsOf(mesh, allIds(source.points()));
        for (std::size_t i = 0; i < source.points(); ++i)
        {
          const std::set<std::int64_t> cells = cellsAt(source, { std::int64_t(i) });
          EXPECT_EQ(Ids(cells.begin(), cells.end()), listOf(stars, i));
        }
      });
  }
}

TEST_F(Around, RingsGrowStepByStep)
{
  for (const auto& scene : Scenes)
  {
    const SourceMesh& source = scene->Source;
    const Ids points = { 0, 5, 17, 17 };
    const Ids cells = { 1, 6, 20 };
    withEach(*scene,
      [&](const ResidentMesh& mesh)
      {
        for (const int k : { 0, 1, 3 })
        {
          const IdLists ofPoints = ringsOfPoints(mesh, points, k);
          for (std::size_t i = 0; i < points.size(); ++i)
          {
            std::set<std::int64_t> ball = { points[i] };
            for (int step = 0; step < k; ++step)
            {
              ball.merge(pointsOf(source, cellsAt(source, ball)));
            }
            ball.erase(points[i]);
            EXPECT_EQ(Ids(ball.begin(), ball.end()), listOf(ofPoints, i));
          }
          const IdLists ofCells = ringsOfCells(mesh, cells, k);
          for (std::size_t i = 0; i < cells.size(); ++i)
          {
            std::set<std::int64_t> ball = { cells[i] };
            for (int step = 0; step < k; ++step)
            {
              ball = cellsAt(source, pointsOf(source, ball));
            }
            ball.erase(cells[i]);
            EXPECT_EQ(Ids(ball.begin(), ball.end()), listOf(ofCells, i));
          }
        }
      });
  }
}

TEST_F(Around, BoundaryHasEachEdgeWithOneTriangleOnce)
{
  for (const auto& scene : Scenes)
  {
    const SourceMesh& source = scene->Source;
    if (source.CellSize == 4)
    {
      continue;
    }
    std::map<std::pair<std::int64_t, std::int64_t>, int> uses;
    for (std::size_t cell = 0; cell < source.cells(); ++cell)
    {
      const Ids c = cornersOf(source, std::int64_t(cell));
      for (std::size_t i = 0; i < 3; ++i)
      {
        ++uses[std::minmax(c[i], c[(i + 1) % 3])];
      }
    }
    const ResidentMesh whole(inMemory(source));
    const BoundaryLoops expected = boundaryOf(whole);
    withEach(*scene,
      [&](const ResidentMesh& mesh)
      {
        const BoundaryLoops loops = boundaryOf(mesh);
        EXPECT_EQ(expected.Points.Ids, loops.Points.Ids);
        EXPECT_EQ(expected.Points.Starts, loops.Points.Starts);
        EXPECT_EQ(expected.Positions, loops.Positions);
      });
    double area = 0;
    std::set<std::pair<std::int64_t, std::int64_t>> found;
    for (std::size_t i = 0; i + 1 < expected.Points.Starts.size(); ++i)
    {
      const Ids loop = listOf(expected.Points, i);
      EXPECT_LE(3U, loop.size());
      for (std::size_t k = 0; k < loop.size(); ++k)
      {
        const std::int64_t a = loop[k];
        const std::int64_t b = loop[(k + 1) % loop.size()];
        EXPECT_TRUE(found.insert(std::minmax(a, b)).second);
        EXPECT_EQ(1, uses[std::minmax(a, b)]);
        const double* p = &source.Coordinates[std::size_t(2 * a)];
        const double* q = &source.Coordinates[std::size_t(2 * b)];
        area += (p[0] * q[1] - p[1] * q[0]) / 2;
      }
    }
    EXPECT_EQ(std::count_if(uses.begin(), uses.end(), [](auto& use) { return use.second == 1; }),
      std::int64_t(found.size()));
    // With the mesh on their left, the loops' areas add up to that of the triangles.
    double triangles = 0;
    for (std::size_t cell = 0; cell < source.cells(); ++cell)
    {
      const Ids c = cornersOf(source, std::int64_t(cell));
      const auto at = [&](std::size_t i) { return &source.Coordinates[std::size_t(2 * c[i])]; };
      triangles += std::abs((at(1)[0] - at(0)[0]) * (at(2)[1] - at(0)[1]) -
                     (at(1)[1] - at(0)[1]) * (at(2)[0] - at(0)[0])) /
        2;
    }
    EXPECT_NEAR(triangles, area, 1e-9);
  }
}

TEST_F(Around, BordersThatTouchAtAPointAreSeparate)
{
  // Two triangles that share only point 2.
  SourceMesh source;
  source.Coordinates = { 0, 0, 1, 0, 1, 1, 2, 1, 1, 2 };
  source.Cells = { 0, 1, 2, 2, 3, 4 };
  source.Labels = { 0, 0 };
  source.Values.assign(10, 0);
  withEach(Stored(source),
    [&](const ResidentMesh& mesh)
    {
      const BoundaryLoops loops = boundaryOf(mesh);
      EXPECT_EQ(Ids({ 0, 3, 6 }), loops.Points.Starts);
      EXPECT_EQ(Ids({ 0, 1, 2, 2, 3, 4 }), loops.Points.Ids);
      const Components components = componentsOf(mesh);
      EXPECT_EQ(Ids({ 0, 1 }), components.OfCells);
    });
}

TEST_F(Around, ComponentsAreConnectedByFaces)
{
  for (const auto& scene : Scenes)
  {
    const SourceMesh& source = scene->Source;
    const Ids neighbors = neighborsByForce(source);
    Ids labels(source.cells(), -1);
    Ids sizes;
    for (std::size_t first = 0; first < labels.size(); ++first)
    {
      if (labels[first] >= 0)
      {
        continue;
      }
      std::vector<std::size_t> open = { first };
      labels[first] = std::int64_t(sizes.size());
      sizes.push_back(0);
      while (!open.empty())
      {
        const std::size_t cell = open.back();
        open.pop_back();
        ++sizes.back();
        for (int i = 0; i < source.CellSize; ++i)
        {
          const std::int64_t other =
            neighbors[cell * std::size_t(source.CellSize) + std::size_t(i)];
          if (other >= 0 && labels[std::size_t(other)] < 0)
          {
            labels[std::size_t(other)] = labels[first];
            open.push_back(std::size_t(other));
          }
        }
      }
    }
    withEach(*scene,
      [&](const ResidentMesh& mesh)
      {
        const Components components = componentsOf(mesh);
        EXPECT_EQ(labels, components.OfCells);
        EXPECT_EQ(sizes, components.Sizes);
      });
  }
}

TEST_F(Around, RefusesIdsThatTheMeshDoesNotHave)
{
  withEach(*Scenes[0],
    [&](const ResidentMesh& mesh)
    {
      for (const std::int64_t id : { std::int64_t(-1), std::int64_t(1000) })
      {
        EXPECT_THROW(neighborsOf(mesh, { id }), IOError);
        EXPECT_THROW(starsOf(mesh, { id }), IOError);
        EXPECT_THROW(ringsOfPoints(mesh, { id }, 1), IOError);
        EXPECT_THROW(ringsOfCells(mesh, { id }, 1), IOError);
      }
      EXPECT_TRUE(neighborsOf(mesh, {}).empty());
    });
}

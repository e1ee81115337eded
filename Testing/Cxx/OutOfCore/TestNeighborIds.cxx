// SPDX-License-Identifier: BSD-3-Clause
// The neighbour ids in a mesh in pieces, compared with neighbours computed from its edges.
#include "OutOfCoreTesting.h"

#include "Arrays/FindNeighbors.h"
#include "ExpectIOError.h"
#include "Npy/NpyFile.h"
#include "Partitioned/FinishedPieces.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <utility>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

using Ids = std::vector<std::int64_t>;

/// Three neighbour ids per triangle, computed with a map of all edges.
Ids neighborsByEdges(const Ids& corners)
{
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> edges;
  const auto ends = [&](std::size_t h)
  {
    const std::size_t t = h - h % 3;
    return std::pair<std::int64_t, std::int64_t>(
      std::minmax(corners[t + (h + 1) % 3], corners[t + (h + 2) % 3]));
  };
  for (std::size_t h = 0; h < corners.size(); ++h)
  {
    edges[ends(h)].push_back(h);
  }
  Ids neighbors;
  for (std::size_t h = 0; h < corners.size(); ++h)
  {
    const std::vector<std::size_t>& both = edges.at(ends(h));
    EXPECT_LE(both.size(), 2U);
    const std::size_t other = both.front() == h ? both.back() : both.front();
    neighbors.push_back(other == h ? -1 : std::int64_t(other / 3));
  }
  return neighbors;
}

/// The mesh's array of neighbours, in the order of the cells' global ids.
Ids neighborsIn(const std::string& path)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  Ids neighbors(3 * std::size_t(mesh.Cells), -2);
  EXPECT_LE(0, findNeighborIds(mesh));
  PieceOptions options;
  options.Borrowed = false;
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    const Piece piece = readPiece(mesh, number, options);
    const Buffer<char>& values = piece.Attributes.at(std::size_t(findNeighborIds(mesh))).Values;
    for (std::int64_t cell = 0; cell < piece.Cells; ++cell)
    {
      std::copy_n(values.as<std::int64_t>() + 3 * cell, 3,
        &neighbors.at(3 * std::size_t(piece.CellIds.as<std::int64_t>()[cell])));
    }
  }
  return neighbors;
}

class NeighborIds : public testing::TestWithParam<std::string>
{
protected:
  NeighborIds() { this->Options.Neighbors = true; }

  void cutIntoPiecesOf(std::int64_t points)
  {
    this->Options.PiecePoints = points;
    this->Options.PartitionPoints = points / 4;
  }

  void triangulate(const Coordinates& xy) { triangulateFile(this->Folder, xy, this->Options); }

  OutOfCoreStatistics resume()
  {
    this->Options.Resume = true;
    const auto points = openPointStream({ this->Folder.path("points.npy") });
    return triangulateOutOfCore(*points, this->Mesh, this->Options);
  }

  TemporaryFolder Folder;
  const std::string Mesh = Folder.path("mesh.tipp");
  OutOfCoreOptions Options;
};

TEST_P(NeighborIds, EqualThoseOfTheEdgesForAllPiecesAndThreads)
{
  const Coordinates xy = makePointSet(GetParam(), 1500);
  for (const std::int64_t points : { 0, 60, 400 })
  {
    this->cutIntoPiecesOf(points);
    std::map<std::string, std::string> files;
    for (const int threads : { 1, 3 })
    {
      this->Options.Threads = threads;
      this->triangulate(xy);
      ASSERT_EQ(neighborsByEdges(sourceOf(this->Mesh, xy).Cells), neighborsIn(this->Mesh))
        << points << " points a piece, " << threads << " threads";
      ASSERT_TRUE(files.empty() || files == filesOf(this->Mesh)) << points << " points a piece";
      files = filesOf(this->Mesh);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, NeighborIds,
  testing::Values("uniform", "clustered", "lattice", "coast", "duplicates", "parabola", "collinear",
    "huge-1e300"),
  [](const auto& info)
  {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  });

TEST_F(NeighborIds, AreMadeOnlyOnRequest)
{
  this->Options.Neighbors = false;
  this->triangulate(makePointSet("uniform", 500));
  EXPECT_EQ(-1, findNeighborIds(openPartitionedMesh(this->Mesh)));
}

TEST_F(NeighborIds, NeedLittleMemory)
{
  const Coordinates xy = makePointSet("clustered", 20000);
  this->Options.MemoryLimit = 1 << 20;
  this->triangulate(xy);
  EXPECT_EQ(neighborsByEdges(sourceOf(this->Mesh, xy).Cells), neighborsIn(this->Mesh));
}

TEST_F(NeighborIds, AreTheSameAfterInterruptedRuns)
{
  this->cutIntoPiecesOf(150);
  this->Options.MapDuplicates = true;
  const Coordinates xy = makePointSet("duplicates", 2500);
  this->triangulate(xy);
  const auto expected = filesOf(this->Mesh);
  constexpr double numbered = 0.9;
  int after = 0;
  for (bool isEnded = true; isEnded; after += 12)
  {
    fs::remove_all(this->Mesh);
    int calls = after;
    this->Options.Progress = [&calls](double done) { return done < numbered || calls-- > 0; };
    isEnded = this->resume().Aborted;
    this->Options.Progress = {};
    EXPECT_TRUE(!isEnded || this->resume().Resumed);
    ASSERT_TRUE(expected == filesOf(this->Mesh)) << after;
  }
  EXPECT_GT(after, 35); // at least one call per piece for ids, and one for neighbours
}

class NeighborIdsOfDamagedPieces : public NeighborIds
{
protected:
  NeighborIdsOfDamagedPieces()
  {
    this->cutIntoPiecesOf(150);
    this->Options.Threads = 1;
    writePoints(this->Folder.path("points.npy"), makePointSet("uniform", 2500));
  }

  void damage() const
  {
    std::string content = contentOf(this->Damaged);
    for (std::size_t at = content.size() / 4; at < content.size(); at += 40)
    {
      content[at] ^= 1;
    }
    std::ofstream(this->Damaged, std::ios::binary) << content;
  }

  const std::string Damaged = Folder.path(".mesh.tipp.part/mesh.tipp/pieces/000003.vtu");
};

TEST_F(NeighborIdsOfDamagedPieces, AreNotMade)
{
  this->Options.Progress = [this, isDone = false](double done) mutable
  {
    if (done >= 0.92 && !std::exchange(isDone, true)) // just before neighbours are found
    {
      this->damage();
    }
    return true;
  };
  expectIOError(this->Damaged, "checksum", [this] { this->resume(); });
  EXPECT_FALSE(fs::exists(this->Mesh));
  EXPECT_TRUE(fs::exists(this->Folder.path(".mesh.tipp.part/.points.0")));
}

TEST_F(NeighborIdsOfDamagedPieces, AreMadeAfterThePiecesAreRemade)
{
  this->resume();
  const auto expected = filesOf(this->Mesh);
  fs::remove_all(this->Mesh);
  this->Options.Progress = [](double done) { return done < 0.9; };
  EXPECT_TRUE(this->resume().Aborted);
  this->Options.Progress = {};
  this->damage();
  std::string warning;
  this->Options.Warn = [&](const std::string& sentence) { warning = sentence; };
  this->resume();
  EXPECT_EQ(0U, warning.find(this->Damaged)) << warning;
  EXPECT_TRUE(expected == filesOf(this->Mesh));
}

template <typename Index>
void expectNeighbors(const Ids& corners)
{
  const std::vector<Index> narrow(corners.begin(), corners.end());
  std::vector<Index> neighbors(narrow.size());
  findNeighbors(narrow.data(), narrow.size() / 3, neighbors.data());
  EXPECT_EQ(neighborsByEdges(corners), Ids(neighbors.begin(), neighbors.end()));
}

TEST(FindNeighbors, EqualThoseOfTheEdgesInAnyOrder)
{
  std::mt19937 random(1);
  for (const std::size_t count : { 3, 4, 5, 10, 1000 })
  {
    Triangles triangles = reference(makePointSet("uniform", count)).Mesh;
    std::shuffle(triangles.begin(), triangles.end(), random);
    Ids corners;
    for (const auto& triangle : triangles)
    {
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    }
    expectNeighbors<std::int32_t>(corners);
    expectNeighbors<std::int64_t>(corners);
  }
  expectNeighbors<std::int32_t>({});
}

TEST(FindNeighbors, AreFoundAroundAHubOfManyTriangles)
{
  constexpr std::int64_t spokes = 200000;
  Ids corners;
  for (std::int64_t i = 0; i < spokes; ++i)
  {
    const std::int64_t j = i * 99991 % spokes; // a stride that is coprime to the number of spokes
    corners.insert(corners.end(), { 0, 1 + j, 1 + (j + 1) % spokes });
  }
  expectNeighbors<std::int32_t>(corners);
}

} // namespace

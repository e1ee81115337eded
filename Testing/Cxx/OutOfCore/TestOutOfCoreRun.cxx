// SPDX-License-Identifier: BSD-3-Clause
// How a run handles its input and options.
#include "OutOfCoreTesting.h"

#include "Distributions/GeneratePoints.h"
#include "ExpectIOError.h"
#include "Npy/NpyFile.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioned/PartitionedMesh.h"

#include <cmath>
#include <filesystem>
#include <sstream>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

std::map<std::string, std::string> filesFor(const Coordinates& xy, const OutOfCoreOptions& options)
{
  const TemporaryFolder folder;
  triangulateFile(folder, xy, options);
  EXPECT_EQ(2U, folder.fileCount());
  return filesOf(folder.path("mesh.tipp"));
}

TEST(OutOfCore, MakesTheSameFilesWithAnyNumberOfThreads)
{
  const Coordinates xy = makePointSet("clustered", 4000);
  OutOfCoreOptions options;
  options.PiecePoints = 300;
  options.PartitionPoints = 70;
  options.Threads = 1;
  const auto expected = filesFor(xy, options);
  for (const int threads : { 2, 3, 8 })
  {
    options.Threads = threads;
    EXPECT_TRUE(expected == filesFor(xy, options)) << threads;
  }
}

TEST(OutOfCore, AcceptsAGridOfPieces)
{
  const Coordinates xy = makePointSet("clustered", 2000);
  const TemporaryFolder folder;
  OutOfCoreOptions options;
  options.Columns = 5;
  options.Rows = 3;
  EXPECT_EQ(15, triangulateFile(folder, xy, options).Pieces);
  EXPECT_TRUE(meshMatches(folder.path("mesh.tipp"), xy, reference(xy)));
}

TEST(OutOfCore, AcceptsAbsurdlyLittleMemory)
{
  const Coordinates xy = makePointSet("coast", 30000);
  const Reference expected = reference(xy);
  for (const std::uint64_t limit : { 1, 1000, 1000000 })
  {
    const TemporaryFolder folder;
    OutOfCoreOptions options;
    options.MemoryLimit = limit;
    options.Threads = 2;
    EXPECT_GT(triangulateFile(folder, xy, options).Pieces, 4) << limit;
    EXPECT_TRUE(meshMatches(folder.path("mesh.tipp"), xy, expected)) << limit;
  }
}

TEST(OutOfCore, CountsAndMapsDuplicates)
{
  const Coordinates xy = makePointSet("duplicates", 3000);
  const Reference expected = reference(xy);
  const TemporaryFolder folder;
  OutOfCoreOptions options;
  options.PiecePoints = 300;
  options.MapDuplicates = true;
  const OutOfCoreStatistics statistics = triangulateFile(folder, xy, options);
  std::int64_t duplicates = 0;
  const PartitionedMesh mesh = openPartitionedMesh(folder.path("mesh.tipp"));
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    const Piece piece = readPiece(mesh, number);
    ASSERT_EQ(1U, piece.Attributes.size());
    EXPECT_EQ("RepresentativePointId", piece.Attributes[0].Description.Name);
    const auto* ids = piece.PointIds.as<std::int64_t>();
    const auto* representatives = piece.Attributes[0].Values.as<std::int64_t>();
    for (std::int64_t i = 0; i < piece.Points; ++i)
    {
      ASSERT_EQ(expected.Representative[std::size_t(ids[i])], representatives[i]) << ids[i];
      const bool isOwn = piece.PointGhosts.as<std::uint8_t>()[i] == 0;
      duplicates += isOwn && representatives[i] != ids[i] ? 1 : 0;
    }
  }
  EXPECT_EQ(statistics.Duplicates, duplicates);
  EXPECT_GT(duplicates, 100);
}

TEST(OutOfCore, WritesTheColumnsOfAllFiles)
{
  const TemporaryFolder folder;
  const Coordinates xy = makePointSet("uniform", 2000);
  std::ostringstream first;
  std::ostringstream second;
  first << "x,y,depth,z,name\n";
  second << "x,y,depth,z,name\n";
  for (std::size_t i = 0; i < xy.size() / 2; ++i)
  {
    std::ostringstream& text = i < 700 ? first : second;
    text.precision(17);
    text << xy[2 * i] << ',' << xy[2 * i + 1] << ',' << 2 * i << ',' << 3 * i << ",buoy\n";
  }
  const auto points =
    openPointStream({ folder.file("a.csv", first.str()), folder.file("b.csv", second.str()) });
  OutOfCoreOptions options;
  options.PiecePoints = 300;
  triangulateOutOfCore(*points, folder.path("mesh.tipp"), options);
  EXPECT_TRUE(meshMatches(folder.path("mesh.tipp"), xy, reference(xy)));
  const PartitionedMesh mesh = openPartitionedMesh(folder.path("mesh.tipp"));
  ASSERT_EQ(1U, mesh.Arrays.size());
  EXPECT_EQ("depth", mesh.Arrays[0].Name);
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    const Piece piece = readPiece(mesh, number);
    for (std::int64_t i = 0; i < piece.Points; ++i)
    {
      const auto id = double(piece.PointIds.as<std::int64_t>()[i]);
      ASSERT_EQ(3 * id, piece.Coordinates.as<double>()[3 * i + 2]);
      ASSERT_EQ(2 * id, piece.Attributes[0].Values.as<double>()[i]);
    }
  }
}

TEST(OutOfCore, HeightsNeedNotBeFinite)
{
  for (const char* const height : { "inf", "-inf", "nan" })
  {
    const TemporaryFolder folder;
    const std::string rows = std::string("x,y,z\n0,0,1\n1,0,") + height + "\n0,1,2\n";
    const auto points = openPointStream({ folder.file("points.csv", rows) });
    EXPECT_EQ(1, triangulateOutOfCore(*points, folder.path("mesh.tipp")).Triangles) << height;
    const PartitionedMesh mesh = openPartitionedMesh(folder.path("mesh.tipp"));
    EXPECT_EQ((std::array<double, 6>{ 0, 1, 0, 1, 1, 2 }), vtkBoundsOf(mesh.Pieces.at(0).Extent))
      << height;
  }
}

TEST(OutOfCore, RefusesFilesOfDifferentColumns)
{
  const TemporaryFolder folder;
  const std::string other = folder.file("b.csv", "x,y,depth\n0,0,1\n1,0,1\n0,1,1\n");
  expectIOError(other, "other columns",
    [&]
    {
      const auto points = openPointStream({ folder.file("a.csv", "x,y\n0,0\n1,0\n0,1\n"), other });
      triangulateOutOfCore(*points, folder.path("mesh.tipp"));
    });
}

TEST(OutOfCore, WritesCollinearPointsWithoutTriangles)
{
  const Coordinates xy = makePointSet("collinear", 500);
  const TemporaryFolder folder;
  OutOfCoreOptions options;
  options.PiecePoints = 100;
  EXPECT_EQ(0, triangulateFile(folder, xy, options).Triangles);
  const PartitionedMesh mesh = openPartitionedMesh(folder.path("mesh.tipp"));
  std::int64_t points = 0;
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    points += readPiece(mesh, number).OwnedPoints;
  }
  EXPECT_EQ(500, points);
}

TEST(OutOfCore, ReportsThatThereAreNoPoints)
{
  const TemporaryFolder folder;
  const Coordinates none = { NAN, 0, 0, INFINITY };
  EXPECT_THROW(triangulateFile(folder, none, {}), IOError);
  EXPECT_EQ(1U, folder.fileCount());
}

TEST(OutOfCore, ReportsAnInputThatEndsEarly)
{
  const TemporaryFolder folder;
  writePoints(folder.path("points.npy"), makePointSet("uniform", 2000));
  fs::resize_file(folder.path("points.npy"), 20000);
  expectIOError(folder.path("points.npy"), "copy",
    [&]
    {
      const auto points = openPointStream({ folder.path("points.npy") });
      triangulateOutOfCore(*points, folder.path("mesh.tipp"));
    });
}

TEST(OutOfCore, NoticesAnInputThatChangesWhileItIsRead)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("points.npy");
  writePoints(path, makePointSet("uniform", 2000));
  const auto points = openPointStream({ path });
  OutOfCoreOptions options;
  bool isChanged = false;
  options.Progress = [&](double)
  {
    if (!isChanged)
    {
      isChanged = true;
      writePoints(path, makePointSet("uniform", 2100, 3));
    }
    return true;
  };
  expectIOError(
    path, "changed", [&] { triangulateOutOfCore(*points, folder.path("mesh.tipp"), options); });
  EXPECT_EQ(1U, folder.fileCount());
}

TEST(OutOfCore, MakesTheSameFilesInLittleMemory)
{
  const Coordinates xy = makePointSet("uniform", 3000);
  OutOfCoreOptions options;
  options.PiecePoints = 150;
  options.PartitionPoints = 40;
  const TemporaryFolder roomy;
  triangulateFile(roomy, xy, options);
  options.MemoryLimit = 1;
  const TemporaryFolder narrow;
  triangulateFile(narrow, xy, options);
  EXPECT_TRUE(filesOf(roomy.path("mesh.tipp")) == filesOf(narrow.path("mesh.tipp")));
}

TEST(OutOfCore, UsesAnotherFolderForSpilledPoints)
{
  const TemporaryFolder folder;
  const Coordinates xy = makePointSet("uniform", 2000);
  OutOfCoreOptions options;
  options.Scratch = folder.path("scratch");
  bool isThere = false;
  options.Progress = [&](double)
  {
    isThere = isThere || fs::exists(folder.path("scratch/.mesh.tipp.part/.points.0"));
    return true;
  };
  triangulateFile(folder, xy, options);
  EXPECT_TRUE(isThere);
  EXPECT_TRUE(fs::is_empty(folder.path("scratch")));
  EXPECT_TRUE(meshMatches(folder.path("mesh.tipp"), xy, reference(xy)));
}

TEST(OutOfCore, RefusesASecondRunForTheSameMesh)
{
  const TemporaryFolder folder;
  const Coordinates xy = makePointSet("uniform", 2000);
  OutOfCoreOptions options;
  int refused = 0;
  options.Progress = [&](double)
  {
    if (refused++ == 0)
    {
      const auto points = openPointStream({ folder.path("points.npy") });
      expectIOError(folder.path("mesh.tipp"), "another process",
        [&] { triangulateOutOfCore(*points, folder.path("mesh.tipp")); });
    }
    return true;
  };
  triangulateFile(folder, xy, options);
  EXPECT_GT(refused, 0);
  EXPECT_TRUE(meshMatches(folder.path("mesh.tipp"), xy, reference(xy)));
}

TEST(OutOfCore, CountsAndSumsTrianglesWithoutWritingThem)
{
  const Coordinates xy = makePointSet("duplicates", 3000);
  const TemporaryFolder folder;
  OutOfCoreOptions options;
  options.PiecePoints = 300;
  options.CountOnly = true;
  const OutOfCoreStatistics statistics = triangulateFile(folder, xy, options);
  std::uint64_t expected = 0;
  const Triangles triangles = reference(xy).Mesh;
  for (const Triangle& t : triangles)
  {
    expected += hashTriangle(t[0], t[1], t[2]);
  }
  EXPECT_EQ(std::int64_t(triangles.size()), statistics.Triangles);
  EXPECT_EQ(expected, statistics.TriangleSum);
  EXPECT_EQ(1U, folder.fileCount());
}

TEST(OutOfCore, TriangulatesGeneratedPoints)
{
  const TemporaryFolder folder;
  const auto points = openPointStream({ "uniform:3000" });
  OutOfCoreOptions options;
  options.PiecePoints = 300;
  triangulateOutOfCore(*points, folder.path("mesh.tipp"), options);
  const Coordinates xy = generatePoints(Distribution::Uniform, 3000, 1);
  EXPECT_TRUE(meshMatches(folder.path("mesh.tipp"), xy, reference(xy)));
}

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
// The out-of-core triangulation in space gives the same tetrahedra as the one in memory.
#include "PointsInSpace.h"
#include "RunTipp.h"

#include "Files/IOError.h"
#include "OutOfCore/OutOfCoreTetrahedralization.h"
#include "Partitioned/FinishedPieces.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Points/ReadPoints.h"
#include "Predicates/ExactPredicates3.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include <sys/resource.h>

namespace
{

using namespace tipp;
using namespace tipp::test;

struct StoredMesh
{
  std::vector<Tetrahedron> Cells;              ///< sorted
  std::map<std::int64_t, std::int64_t> Points; ///< representative of each point
};

/// Reads all pieces. Checks that points have their coordinates and data, tetrahedra have positive
/// orientation, and cell ids are consecutive.
StoredMesh read(const std::string& path, const std::vector<Point3>& points)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  EXPECT_EQ(4, mesh.CellSize);
  StoredMesh stored;
  for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
  {
    const Piece piece = readPiece(mesh, number);
    const auto* ids = piece.PointIds.as<std::int64_t>();
    const auto* at = piece.Coordinates.as<Point3>();
    for (std::int64_t i = 0; i < piece.Points; ++i)
    {
      EXPECT_TRUE(at[i] == points.at(std::size_t(ids[i])));
      EXPECT_EQ(double(ids[i]), piece.Attributes.at(0).Values.as<double>()[i]);
      if (piece.PointGhosts.as<std::uint8_t>()[i] == 0)
      {
        EXPECT_TRUE(
          stored.Points.emplace(ids[i], piece.Attributes.at(1).Values.as<std::int64_t>()[i])
            .second);
      }
    }
    for (std::int64_t cell = 0; cell < piece.OwnedCells; ++cell)
    {
      EXPECT_EQ(std::int64_t(stored.Cells.size()), piece.CellIds.as<std::int64_t>()[cell]);
      Tetrahedron corners{};
      std::array<Point3, 4> p{};
      for (int i = 0; i < 4; ++i)
      {
        corners[std::size_t(i)] = ids[piece.corner(cell, i)];
        p[std::size_t(i)] = at[piece.corner(cell, i)];
      }
      EXPECT_GT(orientation3(p[0], p[1], p[2], p[3]), 0);
      std::sort(corners.begin(), corners.end());
      stored.Cells.push_back(corners);
    }
  }
  EXPECT_EQ(mesh.Cells, std::int64_t(stored.Cells.size()));
  std::sort(stored.Cells.begin(), stored.Cells.end());
  return stored;
}

using FourEach = std::vector<std::int64_t>; ///< four values per tetrahedron

/// Four neighbour ids per tetrahedron, computed with a map of all facets.
FourEach neighborsByFacets(const FourEach& ids)
{
  std::map<std::array<std::int64_t, 3>, std::vector<std::size_t>> facets;
  const auto facetOf = [&ids](std::size_t slot)
  {
    std::array<std::int64_t, 3> facet{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      facet[k] = ids[slot / 4 * 4 + (slot + k + 1) % 4];
    }
    std::sort(facet.begin(), facet.end());
    return facet;
  };
  for (std::size_t slot = 0; slot < ids.size(); ++slot)
  {
    facets[facetOf(slot)].push_back(slot);
  }
  FourEach neighbors;
  for (std::size_t slot = 0; slot < ids.size(); ++slot)
  {
    const std::vector<std::size_t>& both = facets.at(facetOf(slot));
    const std::size_t other = both.front() == slot ? both.back() : both.front();
    neighbors.push_back(other == slot ? -1 : std::int64_t(other / 4));
  }
  return neighbors;
}

/// The contents of all files in a folder, by relative path.
std::map<std::string, std::string> filesOf(const std::string& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file())
    {
      files[entry.path().string().substr(folder.size())] = contentOf(entry.path().string());
    }
  }
  return files;
}

class OutOfCore3D : public testing::Test
{
protected:
  OutOfCoreStatistics3 make(const std::vector<Point3>& points, std::int64_t piecePoints,
    int threads = 1, std::uint64_t memory = 1 << 20, const std::string& name = "mesh.tipp") const
  {
    OutOfCoreOptions3 options;
    options.PiecePoints = piecePoints;
    options.Threads = threads;
    options.MemoryLimit = memory;
    options.MapDuplicates = true;
    return tetrahedralizeOutOfCore(*streamOf(points), this->path(name), options);
  }

  std::string path(const std::string& name) const { return this->Folder.path(name); }

  /// Expects the mesh of tetrahedralize().
  void expectSame(const std::vector<Point3>& points, const std::string& what) const
  {
    const Tetrahedralization mesh = tetrahedralize(points.data(), points.size());
    const StoredMesh stored = read(this->path("mesh.tipp"), points);
    EXPECT_TRUE(sortedCells(mesh) == stored.Cells) << what;
    EXPECT_EQ(points.size() - mesh.Rejected.size(), stored.Points.size()) << what;
    for (const Duplicate& duplicate : mesh.Duplicates)
    {
      EXPECT_EQ(duplicate.Representative, stored.Points.at(duplicate.Point)) << what;
    }
  }

  /// The error message of a run, or an empty string if it succeeds.
  std::string errorOf(const std::vector<Point3>& points, std::uint64_t memory = 1 << 20) const
  {
    try
    {
      this->make(points, 0, 1, memory);
    }
    catch (const IOError& error)
    {
      return error.what();
    }
    return "";
  }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(OutOfCore3D, TetrahedraAreThoseInMemory)
{
  for (const std::string& kind : kindsOfPoints())
  {
    const auto points = pointsInSpace(kind, kind == "lines" ? 100 : 1200, 5);
    for (const std::int64_t pieceOf : { 60, 300, 5000 })
    {
      const OutOfCoreStatistics3 made = this->make(points, pieceOf, 1 + int(pieceOf % 7) % 2);
      this->expectSame(points, kind + " " + std::to_string(pieceOf));
      EXPECT_EQ(std::int64_t(points.size()), made.Points);
    }
  }
}

TEST_F(OutOfCore3D, MostPointsAreNotSentToOtherPieces)
{
  const auto points = pointsInSpace("uniform", 20000);
  const OutOfCoreStatistics3 made = this->make(points, 2000, 2);
  EXPECT_EQ(10, made.Pieces);
  EXPECT_GT(made.WorkerVertices, 20000);
  EXPECT_LT(made.WorkerVertices, 60000);
  this->expectSame(points, "uniform");
}

TEST_F(OutOfCore3D, FilesAreTheSameForAnyNumberOfThreads)
{
  for (const char* const kind : { "uniform", "clustered", "lattice" })
  {
    const auto points = pointsInSpace(kind, 6000);
    this->make(points, 250, 1, 1 << 20, "one.tipp");
    this->make(points, 250, 2, 1 << 20, "two.tipp");
    this->make(points, 250, 5, 1 << 20, "five.tipp");
    const auto one = filesOf(this->path("one.tipp"));
    EXPECT_GT(one.size(), 10U) << kind;
    EXPECT_TRUE(one == filesOf(this->path("two.tipp"))) << kind;
    EXPECT_TRUE(one == filesOf(this->path("five.tipp"))) << kind;
  }
}

TEST_F(OutOfCore3D, TheMemoryLimitDecidesTheNumberOfPieces)
{
  const auto points = pointsInSpace("uniform", 30000);
  EXPECT_EQ(1, this->make(points, 0, 2, 1 << 28).Pieces);
  this->expectSame(points, "much memory");
  EXPECT_EQ(8, this->make(points, 0, 2, 1 << 20).Pieces);
  this->expectSame(points, "little memory");
}

TEST_F(OutOfCore3D, SurfacesAreOnePieceIfMemoryAllows)
{
  const auto points = pointsInSpace("sphere", 2500);
  EXPECT_EQ(1, this->make(points, 300, 2, 1 << 26).Pieces);
  this->expectSame(points, "sphere");
}

TEST_F(OutOfCore3D, PointsThatAreNotFiniteAreLeftOut)
{
  auto points = pointsInSpace("coarse", 1000);
  points[0].z = std::nan("");
  points[77].x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(2, this->make(points, 100).Rejected);
  this->expectSame(points, "coarse");
}

TEST_F(OutOfCore3D, PointsWithoutTetrahedraAreAnError)
{
  const auto flat = [](int count, double y, double z)
  {
    std::vector<Point3> points;
    for (int i = 0; i < count; ++i)
    {
      points.push_back({ double(i % 5), y * double(i / 5), z });
    }
    return points;
  };
  EXPECT_NE(std::string::npos, this->errorOf(flat(20, 1, 3)).find("in one plane"));
  EXPECT_NE(std::string::npos, this->errorOf(flat(20, 0, 3)).find("on one line"));
  EXPECT_NE(std::string::npos, this->errorOf(flat(1, 0, 3)).find("coincide"));
  EXPECT_NE(std::string::npos, this->errorOf(flat(3, 1, std::nan(""))).find("no point"));
  EXPECT_TRUE(filesOf(this->Folder.path("")).empty());
}

TEST_F(OutOfCore3D, AnAbortedRunIsKeptOnceThePointsAreSpilled)
{
  const auto points = pointsInSpace("uniform", 5000);
  for (const double end : { 0.0, 0.05, 0.3, 0.9, 0.97 })
  {
    OutOfCoreOptions3 options;
    options.PiecePoints = 300;
    options.Threads = 2;
    options.Progress = [end](double done) { return done <= end; };
    const auto run = [&]
    { return tetrahedralizeOutOfCore(*streamOf(points), this->path("mesh.tipp"), options); };
    const OutOfCoreStatistics3 ended = run();
    EXPECT_TRUE(ended.Aborted);
    EXPECT_EQ(end > 0.1, ended.Kept) << end;
    EXPECT_EQ(!ended.Kept, std::filesystem::is_empty(this->path("."))) << end;
    options.Progress = {};
    options.Resume = true;
    EXPECT_EQ(ended.Kept, run().Resumed) << end;
    EXPECT_EQ(1U, this->Folder.fileCount()) << end;
    std::filesystem::remove_all(this->path("mesh.tipp"));
  }
}

TEST_F(OutOfCore3D, TheToolMakesChecksAndResamplesAMesh)
{
  const auto run = [this](const std::vector<std::string>& words)
  {
    Outcome outcome = runTipp(this->Folder, words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome;
  };
  std::ofstream csv(this->path("points.csv"));
  csv << "x,y,z,weight\n" << std::setprecision(17);
  for (const Point3& p : pointsInSpace("uniform", 20000))
  {
    csv << p.x << "," << p.y << "," << p.z << "," << p.x * p.z << "\n";
  }
  csv.close();
  run({ "delaunay3d", "points.csv", "-o", "mesh.tipp", "--memory", "1M", "--threads", "2",
    "--scratch", "scratch", "--stats", "run.json" });
  EXPECT_NE(std::string::npos, contentOf(this->path("run.json")).find("\"tetrahedra\""));
  EXPECT_FALSE(std::filesystem::exists(this->path("scratch/.points")));
  EXPECT_NE(std::string::npos,
    run({ "check", "points.csv", "mesh.tipp", "--tie-rule" }).Out.find("correct"));
  run({ "delaunay3d", "points.csv", "-o", "mesh.vtu" });
  run({ "resample", "mesh.tipp", "-o", "pieces.npy", "--arrays", "weight", "--dims", "20", "20",
    "20" });
  run({ "resample", "mesh.vtu", "-o", "whole.npy", "--arrays", "weight", "--dims", "20", "20",
    "20" });
  EXPECT_TRUE(contentOf(this->path("pieces.npy")) == contentOf(this->path("whole.npy")));
}

TEST_F(OutOfCore3D, NeighboursShareAFacet)
{
  for (const std::string& kind : kindsOfPoints())
  {
    const auto points = pointsInSpace(kind, kind == "lines" ? 100 : 1200, 5);
    for (const std::int64_t pieceOf : { 60, 300, 5000 })
    {
      OutOfCoreOptions3 options;
      options.PiecePoints = pieceOf;
      options.Threads = 2;
      options.MemoryLimit = 1 << 20;
      options.Neighbors = true;
      tetrahedralizeOutOfCore(*streamOf(points), this->path("mesh.tipp"), options);
      FourEach ids;
      FourEach neighbors;
      const PartitionedMesh mesh = openPartitionedMesh(this->path("mesh.tipp"));
      for (std::size_t number = 0; number < mesh.Pieces.size(); ++number)
      {
        const Piece piece = readPiece(mesh, number);
        for (std::int64_t slot = 0; slot < 4 * piece.OwnedCells; ++slot)
        {
          ids.push_back(piece.PointIds.as<std::int64_t>()[piece.corner(slot / 4, int(slot % 4))]);
          neighbors.push_back(piece.Attributes.at(1).Values.as<std::int64_t>()[slot]);
        }
      }
      EXPECT_TRUE(neighborsByFacets(ids) == neighbors) << kind << " " << pieceOf;
    }
  }
}

TEST_F(OutOfCore3D, TheToolWritesNeighboursThatPassTheCheck)
{
  EXPECT_EQ(0,
    runTipp(this->Folder,
      { "delaunay3d", "uniform:9000", "-o", "mesh.tipp", "--memory", "1M", "--neighbors" })
      .ExitCode);
  const Outcome checked = runTipp(this->Folder, { "check", "uniform:9000", "mesh.tipp" });
  EXPECT_EQ(0, checked.ExitCode) << checked.Out << checked.Err;
  EXPECT_LE(0, findNeighborIds(openPartitionedMesh(this->path("mesh.tipp"))));
}

TEST_F(OutOfCore3D, TheCheckFindsOtherPoints)
{
  EXPECT_EQ(0,
    runTipp(this->Folder, { "delaunay3d", "uniform:5000", "-o", "mesh.tipp", "--memory", "1M" })
      .ExitCode);
  const Outcome good = runTipp(this->Folder, { "check", "uniform:5000", "mesh.tipp" });
  EXPECT_EQ(0, good.ExitCode) << good.Err;
  const Outcome bad = runTipp(this->Folder, { "check", "uniform:5001", "mesh.tipp" });
  EXPECT_EQ(1, bad.ExitCode);
  EXPECT_NE(std::string::npos, bad.Err.find("are not the")) << bad.Err;
}

TEST_F(OutOfCore3D, GoesOnAfterADiskThatIsFull)
{
  for (const rlim_t most : { 100000, 400000 })
  {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{ most, before.rlim_max };
    setrlimit(RLIMIT_FSIZE, &small);
    std::signal(SIGXFSZ, SIG_IGN);
    const std::vector<std::string> words = { "delaunay3d", "uniform:12000", "-o", "mesh.tipp",
      "--memory", "1M", "--resume" };
    const Outcome outcome = runTipp(this->Folder, words);
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(1, outcome.ExitCode) << most;
    EXPECT_NE(std::string::npos, outcome.Err.find("cannot be written")) << outcome.Err;
    EXPECT_FALSE(std::filesystem::exists(this->path("mesh.tipp")));
    const Outcome resumed = runTipp(this->Folder, words);
    EXPECT_EQ(0, resumed.ExitCode) << resumed.Err;
    EXPECT_EQ(0, runTipp(this->Folder, { "check", "uniform:12000", "mesh.tipp" }).ExitCode);
    std::filesystem::remove_all(this->path("mesh.tipp"));
  }
}

TEST_F(OutOfCore3D, WrongUsageIsRefused)
{
  const auto code = [this](const std::vector<std::string>& more)
  {
    std::vector<std::string> words = { "delaunay3d", "uniform:1000" };
    words.insert(words.end(), more.begin(), more.end());
    return runTipp(this->Folder, words).ExitCode;
  };
  EXPECT_EQ(2, code({ "-o", "mesh.vtu", "--memory", "1M" }));
  EXPECT_EQ(2, code({ "-o", "mesh.vtu", "--scratch", "there" }));
  EXPECT_EQ(2, code({ "-o", "mesh.vtu", "--resume" }));
  EXPECT_EQ(2, code({ "-o", "mesh.tipp", "--partitions", "4" }));
  EXPECT_EQ(2, code({ "-o", "mesh.tipp", "--memory", "much" }));
  const Outcome missing = runTipp(this->Folder, { "delaunay3d", "none.csv", "-o", "mesh.tipp" });
  EXPECT_EQ(1, missing.ExitCode);
  EXPECT_NE(std::string::npos, missing.Err.find("none.csv")) << missing.Err;
  std::ofstream(this->path("flat.csv")) << "x,y\n0,0\n1,0\n0,1\n";
  const Outcome flat = runTipp(this->Folder, { "delaunay3d", "flat.csv", "-o", "mesh.tipp" });
  EXPECT_EQ(1, flat.ExitCode);
  EXPECT_NE(std::string::npos, flat.Err.find("column z")) << flat.Err;
}

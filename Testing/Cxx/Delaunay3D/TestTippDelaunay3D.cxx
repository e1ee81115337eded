// SPDX-License-Identifier: BSD-3-Clause
// The commands 'tipp delaunay3d' and 'tipp check' for tetrahedra.
#include "PointsInSpace.h"
#include "RunTipp.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <set>
#include <string>
#include <vector>

namespace
{

using namespace tipp::test;

class TippDelaunay3D : public testing::Test
{
protected:
  void write(const std::string& name, const std::vector<tipp::Point3>& points) const
  {
    std::ofstream csv(this->Folder.path(name));
    csv << "x,y,z,number\n" << std::setprecision(17);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      csv << points[i].x << "," << points[i].y << "," << points[i].z << "," << i << "\n";
    }
  }

  /// Runs the tool and expects success.
  Outcome run(const std::vector<std::string>& words) const
  {
    Outcome outcome = runTipp(this->Folder, words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome;
  }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(TippDelaunay3D, MeshesPassTheCheck)
{
  for (const char* const kind : { "uniform", "lattice", "coarse" })
  {
    this->write("points.csv", pointsInSpace(kind, 1000));
    for (const char* const mesh : { "mesh.vtu", "mesh.npy" })
    {
      this->run({ "delaunay3d", "points.csv", "-o", mesh, "--threads", "2", "--partitions", "5" });
      const Outcome checked = this->run({ "check", "points.csv", mesh, "--tie-rule" });
      EXPECT_NE(std::string::npos, checked.Out.find("correct")) << checked.Out;
    }
  }
}

TEST_F(TippDelaunay3D, PointsThatAreNotFiniteGiveAWarning)
{
  std::vector<tipp::Point3> points = pointsInSpace("uniform", 100);
  points[5].x = NAN;
  this->write("points.csv", points);
  for (const char* const mesh : { "mesh.vtu", "mesh.tipp" })
  {
    const Outcome outcome = this->run({ "delaunay3d", "points.csv", "-o", mesh });
    EXPECT_NE(std::string::npos,
      outcome.Err.find("tipp: warning: 1 of 100 points have a NaN or infinite coordinate"))
      << outcome.Err;
  }
}

TEST_F(TippDelaunay3D, NeighboursAndDuplicatesAreWritten)
{
  this->write("points.csv", pointsInSpace("coarse", 1000));
  this->run({ "delaunay3d", "points.csv", "-o", "mesh.vtu", "--neighbors", "--map-duplicates",
    "--stats", "run.json" });
  this->run({ "check", "points.csv", "mesh.vtu" });
  const std::string mesh = contentOf(this->Folder.path("mesh.vtu"));
  for (const char* const array : { "NeighborIds", "RepresentativePointId", "number" })
  {
    EXPECT_NE(std::string::npos, mesh.find(array)) << array;
  }
  const auto json = nlohmann::json::parse(contentOf(this->Folder.path("run.json")));
  EXPECT_EQ(
    std::vector<std::string>{ "points.csv" }, json["input"].get<std::vector<std::string>>());
  EXPECT_EQ(1000, json["points"].get<int>());
  const auto points = pointsInSpace("coarse", 1000);
  std::set<std::array<double, 3>> distinct;
  for (const tipp::Point3& p : points)
  {
    distinct.insert({ p.x, p.y, p.z });
  }
  EXPECT_EQ(1000 - distinct.size(), json["duplicates"].get<std::size_t>());
  EXPECT_GT(json["tetrahedra"].get<int>(), 500);
}

TEST_F(TippDelaunay3D, TheCheckFindsOtherPoints)
{
  this->write("points.csv", pointsInSpace("uniform", 300, 1));
  this->write("others.csv", pointsInSpace("uniform", 300, 2));
  this->run({ "delaunay3d", "points.csv", "-o", "mesh.npy" });
  const Outcome checked = runTipp(this->Folder, { "check", "others.csv", "mesh.npy" });
  EXPECT_EQ(1, checked.ExitCode);
  EXPECT_NE(std::string::npos, checked.Out.find("FAULTY")) << checked.Out;
}

TEST_F(TippDelaunay3D, PointsInAPlaneMakeTrianglesAndAWarning)
{
  this->write("points.csv", { { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } });
  for (const std::string mesh : { "mesh.vtu", "mesh.npy" })
  {
    const Outcome outcome =
      this->run({ "delaunay3d", "points.csv", "-o", mesh, "--stats", "run.json" });
    EXPECT_NE(std::string::npos, outcome.Err.find("in one plane")) << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Out.find("1 duplicates")) << outcome.Out;
    const auto json = nlohmann::json::parse(contentOf(this->Folder.path("run.json")));
    EXPECT_EQ(2, json["triangles"].get<int>());
    const Outcome checked = this->run({ "check", "points.csv", mesh });
    EXPECT_NE(std::string::npos, checked.Out.find("correct")) << checked.Out;
  }
  this->run({ "delaunay3d", "points.csv", "-o", "mesh.vtu", "--neighbors", "--map-duplicates" });
  const std::string mesh = contentOf(this->Folder.path("mesh.vtu"));
  EXPECT_NE(std::string::npos, mesh.find("NeighborIds"));
  EXPECT_NE(std::string::npos, mesh.find("RepresentativePointId"));
}

TEST_F(TippDelaunay3D, GeneratedPointsNeedAPartitionedMesh)
{
  for (const char* const command : { "delaunay3d", "delaunay" })
  {
    const Outcome outcome = runTipp(this->Folder, { command, "uniform:100", "-o", "mesh.vtu" });
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("name an output that ends in .tipp"))
      << outcome.Err;
    const Outcome wrong = runTipp(this->Folder, { command, "uniform:many", "-o", "mesh.vtu" });
    EXPECT_EQ(1, wrong.ExitCode);
    EXPECT_NE(std::string::npos, wrong.Err.find("no number of points")) << wrong.Err;
  }
}

TEST_F(TippDelaunay3D, PointsWithoutThirdCoordinateAreAnError)
{
  std::ofstream(this->Folder.path("flat.csv")) << "x,y\n0,0\n1,0\n0,1\n";
  const Outcome outcome = runTipp(this->Folder, { "delaunay3d", "flat.csv", "-o", "mesh.vtu" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("column z")) << outcome.Err;
}

TEST_F(TippDelaunay3D, WrongUsageIsRefused)
{
  this->write("points.csv", pointsInSpace("uniform", 10));
  EXPECT_EQ(2, runTipp(this->Folder, { "delaunay3d", "points.csv", "-o", "mesh.vtp" }).ExitCode);
  EXPECT_EQ(2,
    runTipp(this->Folder, { "delaunay3d", "points.csv", "-o", "mesh.npy", "--neighbors" })
      .ExitCode);
}

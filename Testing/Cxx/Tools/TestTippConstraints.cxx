// SPDX-License-Identifier: BSD-3-Clause
// The command 'tipp delaunay' with --constraints.
#include "RunTipp.h"

#include "Meshes/MeshFiles.h"
#include "Points/ReadPoints.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace tipp::test;
using Words = std::vector<std::string>;

/// A square, and inside it a smaller square around a point.
class TippConstraints : public testing::Test
{
protected:
  TippConstraints()
  {
    this->Folder.file(
      "points.csv", "x,y,z\n0,0,0\n8,0,0\n8,8,8\n0,8,8\n3,3,0\n5,3,0\n5,5,0\n3,5,0\n4,4.25,0\n");
    this->Folder.file("cross.csv", "x1,y1,x2,y2\n0,0,8,8\n0,8,8,0\n");
  }

  Outcome delaunay(const Words& more) const
  {
    Words arguments{ "delaunay", "points.csv" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runTipp(this->Folder, arguments);
  }

  void expectUsageError(const Words& more, const std::string& words) const
  {
    const Outcome outcome = this->delaunay(more);
    EXPECT_EQ(2, outcome.ExitCode) << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Err.find(words)) << outcome.Err;
  }

  double area(const std::string& name) const
  {
    const tipp::TriangleMesh mesh = tipp::readMesh(this->Folder.path(name));
    double area = 0;
    for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
    {
      const double* p[3];
      for (std::size_t k = 0; k < 3; ++k)
      {
        p[k] = &mesh.XY[2 * std::size_t(mesh.Triangles[i + k])];
      }
      area +=
        ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) / 2;
    }
    return area;
  }

  const TemporaryFolder Folder;
};

TEST_F(TippConstraints, CrossingIsAddedAndReported)
{
  const Outcome outcome = this->delaunay({ "-o", "mesh.vtp", "--constraints", "cross.csv" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  // The first line passes through two corners of the smaller square and the crossing: it has four
  // edges.
  EXPECT_NE(std::string::npos, outcome.Out.find("2 constraints of 8 edges, 1 crossings"))
    << outcome.Out;
  const tipp::PointTable points = tipp::readPoints(this->Folder.path("mesh.vtp"));
  ASSERT_EQ(10u, points.size());
  EXPECT_EQ(4, points.XY[18]);
  EXPECT_EQ(4, points.XY[19]);
  EXPECT_EQ(64, this->area("mesh.vtp"));
}

TEST_F(TippConstraints, CrossingIsRefused)
{
  const Outcome outcome =
    this->delaunay({ "-o", "mesh.vtp", "--constraints", "cross.csv", "--refuse-crossings" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("cross.csv")) << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Err.find("crosses constraint 1")) << outcome.Err;
}

TEST_F(TippConstraints, NewPointsNeedAnOutputThatHoldsThem)
{
  const Outcome outcome = this->delaunay({ "-o", "mesh.npy", "--constraints", "cross.csv" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("adds 1 points")) << outcome.Err;
}

TEST_F(TippConstraints, PolygonsKeepTheirInside)
{
  this->Folder.file("square.vtk",
    "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n3 3 1\n5 3 1\n5 5 "
    "1\n3 5 1\n"
    "POLYGONS 1 5\n4 0 1 2 3\n");
  ASSERT_EQ(0, this->delaunay({ "-o", "mesh.vtp", "--constraints", "square.vtk" }).ExitCode);
  EXPECT_EQ(4, this->area("mesh.vtp"));
}

TEST_F(TippConstraints, HolesAreRemovedBySeeds)
{
  this->Folder.file(
    "square.poly", "4 2 0 0\n1 3 3\n2 5 3\n3 5 5\n4 3 5\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  const Words constraints{ "-o", "mesh.vtp", "--constraints", "square.poly" };
  ASSERT_EQ(0, this->delaunay(constraints).ExitCode);
  EXPECT_EQ(64, this->area("mesh.vtp"));
  Words hole = constraints;
  hole.insert(hole.end(), { "--hole", "4", "4" });
  const Outcome outcome = this->delaunay(hole);
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(60, this->area("mesh.vtp"));
  hole = constraints;
  hole.insert(hole.end(), { "--hole", "9", "4" });
  EXPECT_EQ(1, this->delaunay(hole).ExitCode);
}

/// Boundary lines may have any orientation. An inner ring is a hole.
TEST_F(TippConstraints, BoundaryRemovesWhatIsOutside)
{
  this->Folder.file("ring.csv",
    "x1,y1,x2,y2\n1,1,7,1\n7,7,7,1\n7,7,1,7\n1,7,1,1\n3,3,5,3\n5,3,5,5\n5,5,3,5\n3,5,3,3\n");
  const Outcome outcome = this->delaunay({ "-o", "mesh.vtp", "--boundary", "ring.csv" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(32, this->area("mesh.vtp"));
}

/// Only the smaller square is left: the triangles between it and the boundary have long edges.
TEST_F(TippConstraints, BoundaryCanBeCombinedWithALongestEdge)
{
  this->Folder.file("square.csv", "x1,y1,x2,y2\n1,1,7,1\n7,1,7,7\n7,7,1,7\n1,7,1,1\n");
  const Outcome outcome =
    this->delaunay({ "-o", "mesh.vtp", "--boundary", "square.csv", "--max-edge", "2.5" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(4, this->area("mesh.vtp"));
  // Its boundary is neither constraints nor edges of the convex hull.
  Words check{ "check", "points.csv", "mesh.vtp", "--constraints", "square.csv", "--cut" };
  EXPECT_EQ(1, runTipp(this->Folder, check).ExitCode);
  check.emplace_back("--boundary-free");
  const Outcome checked = runTipp(this->Folder, check);
  EXPECT_EQ(0, checked.ExitCode) << checked.Out << checked.Err;
}

TEST_F(TippConstraints, BoundaryCanBeCombinedWithConstraints)
{
  this->Folder.file("square.csv", "x1,y1,x2,y2\n1,1,7,1\n7,1,7,7\n7,7,1,7\n1,7,1,1\n");
  const Outcome outcome =
    this->delaunay({ "-o", "mesh.vtp", "--constraints", "cross.csv", "--boundary", "square.csv" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(36, this->area("mesh.vtp"));
  EXPECT_NE(std::string::npos, outcome.Out.find("6 constraints")) << outcome.Out;
}

TEST_F(TippConstraints, BoundaryMustBeClosed)
{
  this->Folder.file("open.csv", "x1,y1,x2,y2\n1,1,7,1\n7,1,7,7\n");
  const Outcome outcome = this->delaunay({ "-o", "mesh.vtp", "--boundary", "open.csv" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("not closed: a line ends at (1, 1)"))
    << outcome.Err;
}

TEST_F(TippConstraints, ConflictingOptionsAreUsageErrors)
{
  this->expectUsageError({ "-o", "mesh.vtp", "--constraints", "cross.csv", "--mark-constraints" },
    "an output named .tipp");
  this->expectUsageError({ "-o", "mesh.vtp", "--refuse-crossings" }, "needs --constraints");
  this->expectUsageError({ "-o", "mesh.vtp", "--hole", "1", "2" }, "needs --constraints");
}

TEST_F(TippConstraints, CheckVerifiesThem)
{
  ASSERT_EQ(0, this->delaunay({ "-o", "mesh.vtp", "--constraints", "cross.csv" }).ExitCode);
  const auto check = [this](const Words& more)
  {
    Words arguments{ "check", "points.csv", "mesh.vtp", "--tie-rule" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runTipp(this->Folder, arguments);
  };
  const Outcome good = check({ "--constraints", "cross.csv" });
  EXPECT_EQ(0, good.ExitCode) << good.Out << good.Err;
  EXPECT_EQ(1, check({}).ExitCode) << "a point more";
  this->Folder.file("other.csv", "0,8\n");
  const Outcome lost = check({ "--constraints", "other.csv" });
  EXPECT_EQ(1, lost.ExitCode);
  EXPECT_NE(std::string::npos, lost.Out.find("1 constraints are not chains of edges")) << lost.Out;
}

TEST_F(TippConstraints, CheckIgnoresPointsAndConstraintsThatAreNotFinite)
{
  // A std::map with NaN in its keys has no order, so it may not find other points.
  std::string points = "x,y\n";
  std::string lines = "nan,0,1,1\n";
  const auto position = [](int i) { return fmt::format("{},{}", i * 37 % 101, i * 61 % 97); };
  for (int i = 0; i < 60; ++i)
  {
    points += (i % 5 == 1 ? fmt::format("nan,{}\n", i * 61 % 97) : "") + position(i) + "\n";
    lines += i % 2 == 0 ? position(i) + "," + position(i + 1) + "\n" : "";
  }
  this->Folder.file("gaps.csv", points);
  this->Folder.file("lines.csv", lines);
  const Outcome made = runTipp(
    this->Folder, { "delaunay", "gaps.csv", "-o", "mesh.vtp", "--constraints", "lines.csv" });
  ASSERT_EQ(0, made.ExitCode) << made.Err;
  const Outcome outcome =
    runTipp(this->Folder, { "check", "gaps.csv", "mesh.vtp", "--constraints", "lines.csv" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Out << outcome.Err;
}

TEST_F(TippConstraints, CheckAcceptsAMeshThatIsCut)
{
  this->Folder.file("square.poly",
    "4 2 0 0\n1 3 3\n2 5 3\n3 5 5\n4 3 5\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n1\n1 4 4\n");
  ASSERT_EQ(0, this->delaunay({ "-o", "mesh.vtp", "--constraints", "square.poly" }).ExitCode);
  const Outcome outcome =
    runTipp(this->Folder, { "check", "points.csv", "mesh.vtp", "--constraints", "square.poly" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Out << outcome.Err;
}

/// One line leaves the polygon, and another line is outside it.
TEST_F(TippConstraints, CheckAcceptsConstraintsOutsideAMeshThatIsCut)
{
  this->Folder.file("lines.vtk",
    "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 8 double\n0 0 0\n8 8 0\n1 1 "
    "0\n7 1 0\n7 7 0\n1 7 0\n0 4 0\n0.5 8 0\nLINES 2 6\n2 0 1\n2 6 7\nPOLYGONS 1 5\n4 2 3 4 5\n");
  this->Folder.file("other.csv", "3,3,5,5\n3,5,5,3\n");
  for (const std::string mesh : { "mesh.vtp", "mesh.tipp" })
  {
    ASSERT_EQ(0, this->delaunay({ "-o", mesh, "--constraints", "lines.vtk" }).ExitCode);
    const auto outcome = [&](const std::string& file) {
      return runTipp(this->Folder, { "check", "points.csv", mesh, "--constraints", file, "--cut" });
    };
    const Outcome good = outcome("lines.vtk");
    EXPECT_EQ(0, good.ExitCode) << mesh << good.Out << good.Err;
    EXPECT_NE(
      std::string::npos, outcome("other.csv").Out.find("1 constraints are not chains of edges"))
      << "the second is crossed";
  }
}

/// One rank uses the same code as several ranks.
TEST_F(TippConstraints, AreInsertedOnRanks)
{
  const Outcome outcome =
    this->delaunay({ "-o", "ranks.vtp", "--masters", "single", "--constraints", "cross.csv" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Out.find("2 constraints of 8 segments, 1 crossings"))
    << outcome.Out;
  const Outcome checked = runTipp(this->Folder,
    { "check", "points.csv", "ranks.vtp", "--tie-rule", "--constraints", "cross.csv" });
  EXPECT_EQ(0, checked.ExitCode) << checked.Out << checked.Err;
}

TEST_F(TippConstraints, PartitionedMeshesAreMadeAndChecked)
{
  const Outcome made = this->delaunay({ "-o", "mesh.tipp", "--memory", "1M", "--constraints",
    "cross.csv", "--neighbors", "--mark-constraints" });
  ASSERT_EQ(0, made.ExitCode) << made.Err;
  EXPECT_NE(std::string::npos, made.Out.find("2 constraints of 8 segments, 1 crossings"))
    << made.Out;
  const auto check = [this](const std::string& constraints)
  {
    return runTipp(this->Folder,
      { "check", "points.csv", "mesh.tipp", "--tie-rule", "--constraints", constraints });
  };
  const Outcome good = check("cross.csv");
  EXPECT_EQ(0, good.ExitCode) << good.Out << good.Err;
  this->Folder.file("ids.csv", "0,6\n6,2\n");
  EXPECT_EQ(0, check("ids.csv").ExitCode);
  this->Folder.file("other.csv", "0,8\n");
  const Outcome lost = check("other.csv");
  EXPECT_EQ(1, lost.ExitCode);
  EXPECT_NE(std::string::npos, lost.Out.find("1 constraints are not chains of edges")) << lost.Out;
}

TEST_F(TippConstraints, PartitionedMeshesAreCutToABoundary)
{
  this->Folder.file("square.csv", "x1,y1,x2,y2\n1,1,7,1\n7,1,7,7\n7,7,1,7\n1,7,1,1\n");
  ASSERT_EQ(0, this->delaunay({ "-o", "cut.tipp", "--boundary", "square.csv" }).ExitCode);
  const Words check{ "check", "points.csv", "cut.tipp", "--constraints", "square.csv" };
  EXPECT_EQ(1, runTipp(this->Folder, check).ExitCode) << "not the whole hull";
  Words cut = check;
  cut.push_back("--cut");
  const Outcome outcome = runTipp(this->Folder, cut);
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Out << outcome.Err;
}

TEST_F(TippConstraints, HolesByPointsWorkWithPartitionedMeshesAndRanks)
{
  this->Folder.file("square.poly",
    "4 2 0 0\n1 3 3\n2 5 3\n3 5 5\n4 3 5\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n1\n1 4 4\n");
  for (const Words& output : { Words{ "hole.tipp" }, { "hole.vtp", "--masters", "single" } })
  {
    Words arguments{ "--constraints", "square.poly", "-o" };
    arguments.insert(arguments.end(), output.begin(), output.end());
    ASSERT_EQ(0, this->delaunay(arguments).ExitCode);
    const Outcome outcome = runTipp(
      this->Folder, { "check", "points.csv", output.front(), "--constraints", "square.poly" });
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Out << outcome.Err;
  }
  EXPECT_EQ(60, this->area("hole.vtp"));
}

TEST_F(TippConstraints, MissingFileIsNamed)
{
  const Outcome outcome = this->delaunay({ "-o", "mesh.vtp", "--constraints", "lost.csv" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("lost.csv")) << outcome.Err;
}

/// The second constraint ends at a point that is on the first one but for rounding. As none crosses
/// it, the first one is straight. The check cannot know whether another one had crossed it there.
TEST_F(TippConstraints, CheckMayBeUnableToDecide)
{
  this->Folder.file("few.csv", "x,y\n0,0\n3,1\n1,0.33333333333333331\n1,-2\n1,2\n");
  this->Folder.file("lines.csv", "first,last\n0,1\n2,3\n");
  this->Folder.file("through.vtk",
    "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n0 0 0\n3 1 0\n1 "
    "0.33333333333333331 0\n1 -2 0\n1 2 0\nPOLYGONS 4 16\n3 0 2 4\n3 2 1 4\n3 0 3 2\n3 2 3 1\n");
  const Words check{ "check", "few.csv", "through.vtk", "--constraints", "lines.csv" };
  const Outcome outcome = runTipp(this->Folder, check);
  EXPECT_EQ(3, outcome.ExitCode) << outcome.Out << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Out.find("cannot decide\n")) << outcome.Out;
  ASSERT_EQ(0,
    runTipp(
      this->Folder, { "delaunay", "few.csv", "-o", "right.vtp", "--constraints", "lines.csv" })
      .ExitCode);
  EXPECT_EQ(0,
    runTipp(this->Folder, { "check", "few.csv", "right.vtp", "--constraints", "lines.csv" })
      .ExitCode);
}

TEST_F(TippConstraints, FilesWithoutLinesAreRefused)
{
  this->Folder.file("none.csv", "x1,y1,x2,y2\n");
  this->Folder.file("none.poly", "0 2 0 0\n0 0\n0\n");
  this->Folder.file("none.node", "1 2 0 0\n1 5 5\n");
  for (const std::string file : { "none.csv", "none.poly" })
  {
    for (const char* const option : { "--constraints", "--boundary" })
    {
      for (const char* const output : { "mesh.vtp", "mesh.tipp" })
      {
        const Outcome outcome = this->delaunay({ "-o", output, option, file });
        EXPECT_EQ(1, outcome.ExitCode) << option;
        EXPECT_NE(std::string::npos, outcome.Err.find(file + ": holds no ")) << outcome.Err;
      }
    }
  }
}

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
// File formats that commands read and write.
#include "LazText.h"
#include "RunTipp.h"

#include "Points/ReadPoints.h"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

namespace
{

using namespace tipp::test;

using Words = std::vector<std::string>;

class TippFormats : public testing::Test
{
protected:
  Outcome run(const Words& words) const
  {
    Outcome outcome = runTipp(this->Folder, words);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    return outcome;
  }
  std::string content(const std::string& name) const { return contentOf(this->Folder.path(name)); }

  /// Runs the tool with a file as standard input.
  int runWithInput(const std::string& input, const std::string& words) const
  {
    const std::string command = "cd '" + this->Folder.path("") + "' && " TIPP_EXECUTABLE " " +
      words + " < " + input + " > out.txt 2>&1";
    return std::system(command.c_str());
  }

  TemporaryFolder Folder;
};

constexpr const char* boundaries = "1 = number of open boundaries\n"
                                   "2 = total number of open boundary nodes\n"
                                   "2 = number of nodes of boundary 1\n"
                                   "10\n20\n"
                                   "1 = number of land boundaries\n"
                                   "2 = total number of land boundary nodes\n"
                                   "1 24 = a weir\n"
                                   "30 40 1.5 1.0 1.0\n";

TEST_F(TippFormats, AnAdcircGridKeepsItsNodesAndBoundaries)
{
  this->Folder.file("fort.14",
    std::string("A title\n1 4\n10 0 0 3.25\n20 4 0 -1\n40 4 4 0.1\n30 0 4 2\n1 3 10 20 40\n") +
      boundaries);
  this->run({ "delaunay", "fort.14", "-o", "out.14" });
  const std::string out = this->content("out.14");
  EXPECT_EQ(0U, out.find("A title\n2 4\n10 0 0 3.25\n20 4 0 -1\n40 4 4 0.1\n30 0 4 2\n1 3 "))
    << out;
  EXPECT_EQ(out.size() - std::string(boundaries).size(), out.find(boundaries)) << out;
  this->run({ "delaunay", "fort.14", "-o", "triangles.npy" });
  this->run({ "check", "fort.14", "out.14" });
}

TEST_F(TippFormats, ThinningAnAdcircGridWarnsOfItsBoundaries)
{
  const std::string grid = "A title\n1 4\n10 0 0 3\n20 4 0 -1\n40 4 4 1\n30 0 4 2\n1 3 10 20 40\n";
  this->Folder.file("fort.14", grid + boundaries);
  this->Folder.file("none.14", grid);
  const Outcome outcome =
    runTipp(this->Folder, { "delaunay", "fort.14", "-o", "out.14", "--thin", "3:nearest" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_EQ(std::string::npos, outcome.Err.find("boundaries")) << outcome.Err;
  for (const std::string input : { "fort.14", "none.14" })
  {
    const Outcome thinned =
      runTipp(this->Folder, { "delaunay", input, "-o", "out.14", "--thin", "100:nearest" });
    EXPECT_EQ(0, thinned.ExitCode) << thinned.Err;
    EXPECT_EQ(input == "fort.14", thinned.Err.find("boundaries") != std::string::npos)
      << thinned.Err;
  }
}

TEST_F(TippFormats, AnAdcircGridOfOtherPointsHasDepthsAndNoBoundaries)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n1,0,-2.5\n0,1,0\n");
  this->run({ "delaunay", "points.csv", "-o", "out.14" });
  EXPECT_NE(std::string::npos,
    this->content("out.14").find(
      "\n1 3\n1 0 0 -1\n2 1 0 2.5\n3 0 1 0\n1 3 1 2 3\n0 = number of open boundaries\n"))
    << this->content("out.14");
}

TEST_F(TippFormats, AnAdcircGridCannotHavePointsThatAreNotFinite)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n1,0,2\n0,1,0\nnan,1,1\n");
  const Outcome outcome = runTipp(this->Folder, { "delaunay", "points.csv", "-o", "out.14" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("cannot hold point 3")) << outcome.Err;
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path("out.14")));
}

TEST_F(TippFormats, AnAdcircGridCannotHaveArrays)
{
  this->Folder.file("points.csv", "x,y\n0,0\n1,0\n0,1\n");
  for (const std::string option : { "--neighbors", "--map-duplicates" })
  {
    EXPECT_EQ(
      2, runTipp(this->Folder, { "delaunay", "points.csv", "-o", "out.14", option }).ExitCode);
  }
}

TEST_F(TippFormats, MeshesOfModelsAreWrittenAndRead)
{
  this->Folder.file("points.csv", "x,y,z\n0,0,1\n1,0,-2.5\n1.5,1,4\n0,1,0\n");
  std::string before = "points.csv";
  for (const std::string name : { "a.gr3", "a.2dm", "a.msh", "a.node", "a.14" })
  {
    this->run({ "delaunay", before, "-o", name });
    this->run({ "check", "points.csv", name });
    this->run({ "flatten", name, "-o", name + "-flat" });
    before = name;
  }
  this->run({ "check", "points.csv", "a.ele" });
  EXPECT_NE(std::string::npos, this->content("a.14").find("\n2 1 0 2.5\n"));
}

TEST_F(TippFormats, ASchismGridKeepsItsBoundaries)
{
  this->Folder.file("hgrid.gr3",
    std::string("A title\n1 4\n10 0 0 3.25\n20 4 0 -1\n40 4 4 0.1\n30 0 4 2\n1 3 10 20 40\n") +
      boundaries);
  this->run({ "delaunay", "hgrid.gr3", "-o", "out.gr3" });
  EXPECT_NE(std::string::npos, this->content("out.gr3").find(boundaries));
}

TEST_F(TippFormats, AnInputIsNotReplacedByTheOtherFileOfAMesh)
{
  this->Folder.file("a.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
  this->Folder.file("b.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
  this->Folder.file("b.poly", "0 2 0 0\n1 0\n1 1 2\n0\n");
  for (const Words& words : { Words{ "delaunay", "a.node", "-o", "a.ele" },
         Words{ "delaunay", "a.node", "--constraints", "b.poly", "-o", "b.ele" } })
  {
    EXPECT_EQ(1, runTipp(this->Folder, words).ExitCode);
  }
  EXPECT_EQ(0U, this->content("a.node").find("3 2 0 0\n1 0 0\n"));
  EXPECT_EQ(0U, this->content("b.node").find("3 2 0 0\n1 0 0\n"));
}

TEST_F(TippFormats, PointsComeFromTheStandardInput)
{
  std::ofstream csv(this->Folder.path("points.csv"));
  csv << "x,y,z\n";
  for (int i = 0; i < 3000; ++i)
  {
    csv << i * 37 % 101 << "," << i * 53 % 97 << "," << i % 11 << "\n";
  }
  csv.close();
  this->run({ "delaunay", "points.csv", "-o", "file.vtu" });
  EXPECT_EQ(0, this->runWithInput("points.csv", "delaunay - -o input.vtu"))
    << this->content("out.txt");
  EXPECT_EQ(this->content("file.vtu"), this->content("input.vtu"));
  this->run({ "dem", "points.csv", "-o", "file.npy", "--resolution", "1" });
  for (const std::string memory : { "", " --memory 2M" })
  {
    EXPECT_EQ(0, this->runWithInput("points.csv", "dem - -o input.npy --resolution 1" + memory))
      << this->content("out.txt");
    EXPECT_EQ(this->content("file.npy"), this->content("input.npy"));
  }
}

TEST_F(TippFormats, NumbersMayHaveDecimalCommas)
{
  const std::vector<double> xy = { 1.5, 2.25, -3, 4.5 };
  for (const char* const text : { "x;y;z\n1,5;2,25;7\n-3;4,5;8,5\n", "1,5 2,25 7\n-3,0 4,5 8,5\n",
         "x\ty\tz\n1,5\t2,25\t7\n-3\t4,5\t8,5\n" })
  {
    const tipp::PointTable points = tipp::readPoints(this->Folder.file("points.txt", text));
    EXPECT_EQ(xy, points.XY) << text;
    EXPECT_EQ((std::vector<double>{ 7, 8.5 }), points.Columns.at(0).Values) << text;
  }
  // Commas that separate columns are not decimal commas.
  EXPECT_EQ((std::vector<double>{ 1, 5, 3, 4 }),
    tipp::readPoints(this->Folder.file("plain.txt", "1, 5, 2\n3, 4, 7\n")).XY);
}

TEST_F(TippFormats, CompressedPointsGiveTheSameRaster)
{
  for (const LazInput& input : lazInputs)
  {
    const LasAndLaz files = filesOf(input);
    this->Folder.file("a.las", files.Plain);
    this->Folder.file("b.laz", files.Compressed);
    for (const std::string memory : { "1G", "16M" })
    {
      for (const std::string name : { "a.las", "b.laz" })
      {
        this->run({ "dem", name, "-o", name + ".npy", "--keep", "withheld,synthetic,overlap",
          "--resolution", "1e5", "--threads", "2", "--memory", memory });
      }
      EXPECT_EQ(this->content("a.las.npy"), this->content("b.laz.npy")) << input.Format;
    }
  }
  const std::string info = this->run({ "info", "b.laz" }).Out;
  EXPECT_NE(std::string::npos, info.find("point format 10, compressed, 40 points")) << info;
}

TEST_F(TippFormats, OtherKindsNameTheCommandThatConvertsThem)
{
  const std::vector<std::pair<std::string, std::string>> kinds = {
    { "mesh.ex2", "'meshio convert mesh.ex2 out.vtu'" },
    { "mesh.xml.gz",
      "'gunzip mesh.xml.gz', and convert it, as with 'meshio convert mesh.xml out.vtu'" },
  };
  for (const auto& [name, command] : kinds)
  {
    this->Folder.file(name, "1 2 3\n");
    for (const Words& words : { Words{ "delaunay", name, "-o", "out.vtu" },
           Words{ "dem", name, "-o", "out.npy", "--resolution", "1" } })
    {
      const Outcome outcome = runTipp(this->Folder, words);
      EXPECT_EQ(1, outcome.ExitCode) << name;
      EXPECT_NE(std::string::npos, outcome.Err.find(command)) << outcome.Err;
    }
  }
}

} // namespace

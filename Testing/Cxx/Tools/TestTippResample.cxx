// SPDX-License-Identifier: BSD-3-Clause
#include "RunTipp.h"

#include "Distributions/GeneratePoints.h"
#include "Npy/NpyFile.h"
#include "Points/ReadPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

using namespace tipp;
using namespace tipp::test;

namespace
{

using Words = std::vector<std::string>;

/// A VTK file of a triangulation with the field z at its points.
class TippMesh : public testing::Test
{
protected:
  TippMesh()
  {
    std::ofstream csv(this->Folder.path("points.csv"));
    csv << "x,y,height\n";
    const std::vector<double> xy = generatePoints(Distribution::Uniform, 500, 3);
    for (std::size_t i = 0; i < xy.size(); i += 2)
    {
      csv << xy[i] << "," << xy[i + 1] << "," << xy[i] - 2 * xy[i + 1] << "\n";
    }
    csv.close();
    EXPECT_EQ(0, this->run({ "delaunay", "points.csv", "-o", "mesh.vtu" }).ExitCode);
  }

  Outcome run(const Words& words) const { return runTipp(this->Folder, words); }
  bool exists(const std::string& name) const
  {
    return std::filesystem::exists(this->Folder.path(name));
  }

  /// The .npy image of a range of the mesh.
  std::string imageOf(const std::string& mesh) const
  {
    const Outcome outcome = this->run({ "resample", mesh, "-o", "image.npy", "--arrays", "height",
      "--bounds", "0.2", "0.7", "0.1", "0.6", "0", "0", "--dims", "40", "30", "1" });
    EXPECT_EQ(0, outcome.ExitCode) << mesh << ": " << outcome.Err;
    return outcome.ExitCode == 0 ? contentOf(this->Folder.path("image.npy")) : "";
  }

  TemporaryFolder Folder;
};

using TippFlatten = TippMesh;
using TippResample = TippMesh;
using TippPointsLike = TippMesh;

TEST_F(TippFlatten, WritesAFolderOfArrays)
{
  const Outcome outcome = this->run({ "flatten", "mesh.vtu", "-o", "flat" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(std::string::npos, outcome.Out.find("500 points")) << outcome.Out;
  EXPECT_TRUE(this->exists("flat/cells.npy"));
  EXPECT_TRUE(this->exists("flat/point_data/height.npy"));
}

TEST_F(TippFlatten, KeepsAFolderOfOthers)
{
  std::filesystem::create_directory(this->Folder.path("flat"));
  this->Folder.file("flat/notes", "mine");
  const Outcome outcome = this->run({ "flatten", "mesh.vtu", "-o", "flat" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("exists already")) << outcome.Err;
  EXPECT_FALSE(this->exists("flat/cells.npy"));
}

TEST_F(TippFlatten, RefusesAnArrayNameThatNoFileCanHave)
{
  const std::string name(300, 'n');
  this->Folder.file("long.csv", "x,y," + name + "\n0,0,1\n1,0,2\n0,1,3\n");
  ASSERT_EQ(0, this->run({ "delaunay", "long.csv", "-o", "long.vtu" }).ExitCode);
  const Outcome outcome = this->run({ "flatten", "long.vtu", "-o", "flat" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_EQ("tipp: The array '" + name.substr(0, 40) +
      "...' needs a file name of 304 bytes, more than 255; give it a shorter name.\n",
    outcome.Err);
  EXPECT_FALSE(this->exists("flat"));
}

TEST_F(TippFlatten, RefusesValuesWithoutAGrid)
{
  EXPECT_EQ(2, this->run({ "flatten", "mesh.vtu", "-o", "flat", "--values", "fort.63" }).ExitCode);
}

TEST_F(TippResample, OfAStoredMeshEqualsThatOfItsSource)
{
  ASSERT_EQ(0, this->run({ "flatten", "mesh.vtu", "-o", "flat" }).ExitCode);
  ASSERT_EQ(
    0, this->run({ "partition", "flat", "-o", "mesh.tipp", "--tiling", "grid:3x3" }).ExitCode);
  const std::string expected = this->imageOf("mesh.vtu");
  EXPECT_GT(expected.size(), 40U * 30 * 8);
  EXPECT_TRUE(expected == this->imageOf("flat"));
  EXPECT_TRUE(expected == this->imageOf("mesh.tipp"));
  EXPECT_TRUE(expected == this->imageOf("mesh.tipp/index.json"));
}

TEST_F(TippResample, OfAMeshReadInPartsEqualsThatOfTheWhole)
{
  this->run({ "partition", "mesh.vtu", "-o", "mesh.tipp", "--tiling", "grid:5x3" });
  const auto imageOf = [&](const Words& words)
  {
    Words all = { "resample", "mesh.tipp", "-o", "image.vti" };
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = this->run(all);
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    EXPECT_EQ("", outcome.Err);
    return outcome.ExitCode == 0 ? contentOf(this->Folder.path("image.vti")) : "";
  };
  const std::vector<Words> cases = { { "--dims", "50", "0", "1" },
    { "--delta", "0.03", "0.04", "0" },
    { "--bounds", "0.2", "0.7", "0.1", "0.6", "-9", "9", "--dims", "20", "30", "1" },
    { "--arrays", "height", "--dims", "9", "8", "1" } };
  for (Words words : cases)
  {
    const std::string whole = imageOf(words);
    words.insert(words.end(), { "--memory", "10K" });
    EXPECT_TRUE(whole == imageOf(words)) << words.front();
  }
}

TEST_F(TippResample, HasOnlyTheArraysOfTheMesh)
{
  ASSERT_EQ(0, this->run({ "partition", "mesh.vtu", "-o", "mesh.tipp" }).ExitCode);
  const Outcome outcome =
    this->run({ "resample", "mesh.tipp", "-o", "image.vti", "--dims", "8", "8", "1" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  const std::string image = contentOf(this->Folder.path("image.vti"));
  EXPECT_NE(std::string::npos, image.find("height"));
  EXPECT_EQ(std::string::npos, image.find("Global"));
}

TEST_F(TippResample, ListsTheArraysOfTheMesh)
{
  ASSERT_EQ(0, this->run({ "flatten", "mesh.vtu", "-o", "flat" }).ExitCode);
  ASSERT_EQ(0, this->run({ "partition", "flat", "-o", "mesh.tipp" }).ExitCode);
  for (const std::string mesh : { "mesh.vtu", "flat", "mesh.tipp" })
  {
    const Outcome outcome = this->run(
      { "resample", mesh, "-o", "image.npy", "--arrays", "depth", "--dims", "8", "8", "1" });
    EXPECT_EQ(1, outcome.ExitCode);
    // The points of a flat mesh are not read before, so it is not known whether it has heights.
    const std::string names = mesh == "flat" ? "'height'" : "'elevation', 'height'";
    EXPECT_EQ("tipp: " + mesh + ": has no array 'depth'; it has " + names + ".\n", outcome.Err);
  }
}

TEST_F(TippResample, ReportsAFailureInOneSentence)
{
  const Outcome outcome = this->run({ "resample", "mesh.vtu", "-o", "image.vti", "--dims", "8", "8",
    "1", "--bounds", "nan", "1", "0", "1", "0", "0" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_EQ("tipp: mesh.vtu: cannot be resampled: the range along x is from nan to 1.000000: give "
            "finite bounds, the lower one first.\n",
    outcome.Err);
}

TEST_F(TippResample, RefusesARangeOutsideOfTheMeshWithBothBoxes)
{
  ASSERT_EQ(0, this->run({ "flatten", "mesh.vtu", "-o", "flat" }).ExitCode);
  ASSERT_EQ(0, this->run({ "partition", "mesh.vtu", "-o", "mesh.tipp" }).ExitCode);
  for (const char* const mesh : { "mesh.vtu", "mesh.tipp", "flat" })
  {
    const Outcome outcome = this->run({ "resample", mesh, "-o", "image.vti", "--dims", "8", "8",
      "1", "--bounds", "5", "6", "5", "6", "0", "0" });
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(std::string::npos,
      outcome.Err.find(
        "the bounds, x from 5 to 6 and y from 5 to 6, do not meet those of the points, "
        "x from 0"))
      << outcome.Err;
    EXPECT_EQ(0U, outcome.Err.find(std::string("tipp: ") + mesh + ": ")) << outcome.Err;
    EXPECT_EQ(1, std::count(outcome.Err.begin(), outcome.Err.end(), '\n')) << outcome.Err;
  }
}

TEST_F(TippResample, TakesARangeWithoutZ)
{
  const Words words{ "resample", "mesh.vtu", "-o", "image.npy", "--arrays", "height", "--dims", "9",
    "9", "1", "--bounds", "0.2", "0.7", "0.1", "0.6" };
  ASSERT_EQ(0, this->run(words).ExitCode);
  const std::string image = contentOf(this->Folder.path("image.npy"));
  Words whole = words;
  whole.insert(whole.end(), { "0", "0" });
  ASSERT_EQ(0, this->run(whole).ExitCode);
  EXPECT_EQ(contentOf(this->Folder.path("image.npy")), image);
  whole.pop_back();
  EXPECT_NE(std::string::npos, this->run(whole).Err.find("needs four numbers, or six"));
}

TEST_F(TippResample, NeedsZOfARangeOfTetrahedra)
{
  this->Folder.file("space.csv", "x,y,z\n0,0,5\n1,0,5\n0,1,5\n0,0,6\n1,1,7\n");
  for (const char* const mesh : { "space.vtu", "space.tipp" })
  {
    ASSERT_EQ(0, this->run({ "delaunay3d", "space.csv", "-o", mesh }).ExitCode);
    const Outcome outcome = this->run({ "resample", mesh, "-o", "image.vti", "--dims", "4", "4",
      "4", "--bounds", "0", "1", "0", "1" });
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("--bounds needs xmin xmax ymin ymax zmin zmax"))
      << outcome.Err;
  }
}

TEST_F(TippResample, RefusesARangeInTheOrderOfGdal)
{
  const Outcome outcome = this->run({ "resample", "mesh.vtu", "-o", "image.vti", "--dims", "8", "8",
    "1", "--bounds", "0.5", "20", "0.6", "30", "0", "0" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("more than ten times as long along x"))
    << outcome.Err;
}

TEST_F(TippResample, RefusesAGridWithImplicitPoints)
{
  ASSERT_EQ(
    0, this->run({ "resample", "mesh.vtu", "-o", "image.vti", "--dims", "8", "8", "1" }).ExitCode);
  const Outcome outcome =
    this->run({ "resample", "image.vti", "-o", "again.vti", "--dims", "8", "8", "1" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("holds a vtkImageData")) << outcome.Err;
}

/// Files that crash or end VTK's readers, or with ids of points that do not exist.
class TippDamagedFile : public testing::Test
{
protected:
  /// Expects that all commands that read the mesh fail with one line that begins with `start`.
  void expectRefusal(const std::string& file, const std::string& start) const
  {
    for (const Words& words :
      { Words{ "resample", file, "-o", "image.vti", "--dims", "8", "8", "1" },
        Words{ "flatten", file, "-o", "flat" }, Words{ "partition", file, "-o", "mesh.tipp" },
        Words{ "delaunay", file, "-o", "mesh.npy" }, Words{ "check", file, file } })
    {
      const Outcome outcome = runTipp(this->Folder, words);
      EXPECT_EQ(1, outcome.ExitCode) << words[0];
      EXPECT_EQ(0U, outcome.Err.find("tipp: " + file + ": " + start)) << words[0] << outcome.Err;
      EXPECT_EQ(outcome.Err.size() - 1, outcome.Err.find('\n')) << words[0] << outcome.Err;
    }
    EXPECT_EQ(1U, this->Folder.fileCount() - 2); // runTipp() keeps two files
  }

  static std::string surface(const std::string& components, const std::string& id)
  {
    return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" "
           "NumberOfCells=\"1\"><PointData><DataArray type=\"Float64\" Name=\"heat\" "
           "NumberOfComponents=\"" +
      components +
      "\" format=\"ascii\">1 2 3</DataArray></PointData><Points><DataArray type=\"Float64\" "
      "Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0"
      "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
      "format=\"ascii\">0 1 " +
      id +
      "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5</DataArray></Cells></Piece>"
      "</UnstructuredGrid></VTKFile>";
  }

  TemporaryFolder Folder;
};

TEST_F(TippDamagedFile, WithInvalidPointIdsIsRefused)
{
  for (const char* const id : { "-1", "3", "4294967299", "999999999999" })
  {
    this->Folder.file("bad.vtu", surface("1", id));
    this->expectRefusal("bad.vtu", std::string("its cells refer to point ") + id);
  }
}

TEST_F(TippDamagedFile, WithACountThatItCannotHoldIsRefused)
{
  this->Folder.file("bad.vtu", surface("4294967296", "2"));
  this->expectRefusal("bad.vtu", "gives NumberOfComponents=\"4294967296\"");
}

TEST_F(TippDamagedFile, ThatCrashesVtksReaderIsRefused)
{
  this->Folder.file("bad.ply",
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 "
    "0 "
    "1 999999999\n");
  this->expectRefusal("bad.ply", "cannot be read as a VTK file (VTK's reader crashed)");
}

TEST_F(TippResample, SamplesTheHeightsOfASurface)
{
  this->Folder.file("hill.xyz", "0 0 1\n2 0 3\n0 2 5\n2 2 7\n");
  ASSERT_EQ(0, this->run({ "delaunay", "hill.xyz", "-o", "hill.vtu" }).ExitCode);
  const Outcome outcome =
    this->run({ "resample", "hill.vtu", "-o", "hill.npy", "--dims", "3", "3", "1" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  const std::string file = contentOf(this->Folder.path("hill.npy"));
  std::vector<double> heights(9);
  std::copy_n(file.end() - 72, 72, reinterpret_cast<char*>(heights.data()));
  EXPECT_EQ((std::vector<double>{ 1, 2, 3, 3, 4, 5, 5, 6, 7 }), heights);
  this->Folder.file("flat.csv", "x,y,q\n0,0,1\n2,0,3\n0,2,5\n");
  ASSERT_EQ(0, this->run({ "delaunay", "flat.csv", "-o", "flat.vtu" }).ExitCode);
  const Outcome flat =
    this->run({ "resample", "flat.vtu", "-o", "flat.npy", "--dims", "3", "3", "1" });
  EXPECT_EQ(1, flat.ExitCode);
  EXPECT_NE(std::string::npos, flat.Err.find("has no array 'elevation'; it has 'q'")) << flat.Err;
}

TEST_F(TippResample, ReportsAMissingArray)
{
  for (const char* const mesh : { "mesh.vtu", "mesh.tipp" })
  {
    ASSERT_EQ(0, this->run({ "partition", "mesh.vtu", "-o", "mesh.tipp" }).ExitCode);
    const Outcome outcome = this->run(
      { "resample", mesh, "-o", "image.npy", "--arrays", "depth", "--dims", "8", "8", "1" });
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(std::string::npos, outcome.Err.find("no array 'depth'")) << outcome.Err;
  }
}

TEST_F(TippResample, RefusesAnArrayOfWords)
{
  this->Folder.file("words.vtk",
    "# vtk DataFile Version 3.0\nwords\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n"
    "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\nFIELD f 1\n"
    "names 1 3 string\na\nb\nc\n");
  const Outcome outcome = this->run(
    { "resample", "words.vtk", "-o", "image.npy", "--arrays", "names", "--dims", "8", "8", "1" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("holds no numbers")) << outcome.Err;
}

TEST_F(TippResample, ChecksTheOutputBeforeTheWork)
{
  const Outcome outcome =
    this->run({ "resample", "none.vtu", "-o", "none/image.vti", "--dims", "8", "8", "1" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("none/image.vti")) << outcome.Err;
}

TEST_F(TippPointsLike, AreInTheBoxOfTheOthers)
{
  const Outcome outcome = this->run(
    { "points", "--like", "points.csv", "--count", "300", "--seed", "4", "-o", "more.npy" });
  EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
  const std::vector<double> xy = readPoints(this->Folder.path("more.npy")).XY;
  EXPECT_EQ(600U, xy.size());
  EXPECT_TRUE(std::all_of(xy.begin(), xy.end(), [](double c) { return c >= 0 && c <= 1; }));
}

TEST_F(TippResample, SamplesTheTimeStepAskedFor)
{
  this->Folder.file(
    "fort.14", "grid\n2 4\n1 0 0 5\n2 8 0 5\n3 8 8 5\n4 0 8 5\n1 3 1 2 3\n2 3 1 3 4\n0\n0\n0\n0\n");
  this->Folder.file(
    "fort.63", "run\n2 4 1 1 1\n1 1\n1 10\n2 10\n3 10\n4 10\n2 2\n1 20\n2 20\n3 20\n4 20\n");
  ASSERT_EQ(0, this->run({ "flatten", "fort.14", "-o", "steps", "--values", "fort.63" }).ExitCode);
  ASSERT_EQ(
    0, this->run({ "partition", "steps", "-o", "steps.tipp", "--tiling", "grid:2x2" }).ExitCode);
  for (const char* const mesh : { "steps", "steps.tipp" })
  {
    for (const int step : { 0, 1 })
    {
      const Outcome outcome = this->run({ "resample", mesh, "-o", "step.npy", "--arrays", "fort.63",
        "--dims", "3", "3", "1", "--step", std::to_string(step) });
      ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
      const std::string image = contentOf(this->Folder.path("step.npy"));
      double last;
      std::memcpy(&last, image.data() + image.size() - sizeof last, sizeof last);
      EXPECT_EQ(10 * (step + 1), last) << mesh;
    }
    const Outcome outcome = this->run({ "resample", mesh, "-o", "step.npy", "--arrays", "fort.63",
      "--dims", "3", "3", "1", "--step", "2" });
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(
      std::string::npos, outcome.Err.find("has no time step 2; there are 2, counted from 0."))
      << outcome.Err;
  }
  const Outcome outcome =
    this->run({ "resample", "mesh.vtu", "-o", "step.vti", "--dims", "3", "3", "1", "--step", "1" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("has no time step 1; there are 0, counted from 0."))
    << outcome.Err;
}

} // namespace

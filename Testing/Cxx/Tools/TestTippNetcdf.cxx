// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfFile.h"
#include "Series/MeshSeries.h"
#include "TippSeries.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace tipp;
using namespace tipp::test;

class TippNetcdf : public TippResampleSeries
{
};

TEST_F(TippNetcdf, HoldsGridsInTheMannerOfCf)
{
  const Outcome outcome =
    this->run({ "-o", "maps.nc", "--step", "all", "--no-data=-99999", "--crs", "EPSG:4326" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  NetcdfFile file(this->Folder.path("maps.nc"));
  const NetcdfContent& content = file.content();
  const NetcdfVariable* const level = content.find("level");
  ASSERT_NE(nullptr, level);
  EXPECT_EQ((std::vector<std::int64_t>{ 4, 5, 5 }), content.shape(*level));
  EXPECT_EQ(Scalar::Float32, level->Type);
  EXPECT_EQ((std::vector<std::int64_t>{ 5, 5 }), content.shape(*content.find("depth")));
  EXPECT_EQ((std::vector<double>{ 0, 60, 120, 240 }), file.read(*content.find("time")));
  EXPECT_EQ((std::vector<double>{ 0, 0.25, 0.5, 0.75, 1 }), file.read(*content.find("lon")));
  EXPECT_EQ("degrees_north", content.find("lat")->text("units"));
  EXPECT_EQ("crs", level->text("grid_mapping"));
  EXPECT_EQ("latitude_longitude", content.find("crs")->text("grid_mapping_name"));
  EXPECT_EQ(0u, content.find("crs")->text("crs_wkt").find("GEOGCS"));
  const std::vector<double> values = file.read(*level);
  EXPECT_EQ(20.25, values[51]);
  EXPECT_TRUE(std::isnan(values[74]));
}

/// `tipp flatten` with an output in NetCDF.
class TippUgrid : public TippResampleSeries
{
protected:
  void flatten(const Words& arguments, const std::string& output) const
  {
    Words words = { "flatten" };
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.insert(words.end(), { "-o", output });
    const Outcome outcome = runTipp(this->Folder, words);
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  }

  /// Expects the flat mesh "surge" in a file.
  void expectSurge(const std::string& name) const
  {
    const auto series = openMeshSeries(this->Folder.path(name));
    EXPECT_EQ("UGRID", series->Kind);
    EXPECT_EQ((std::vector<double>{ 0, 60, 120, 240 }), series->Times);
    const SeriesMesh mesh = series->readMesh();
    EXPECT_EQ((std::vector<double>{ 0, 0, 1, 0, 1, 1, 0, 1 }), mesh.XY);
    EXPECT_EQ((std::vector<std::int64_t>{ 0, 1, 3, 1, 2, 3 }), mesh.Triangles);
    EXPECT_TRUE(mesh.OriginalCells.empty());
    std::vector<double> values;
    series->read(findSeriesVariable(*series, "level"), 3, values);
    EXPECT_EQ((std::vector<double>{ 30, 31, -99999, 30 }), values);
    series->read(findSeriesVariable(*series, "depth"), 0, values);
    EXPECT_EQ((std::vector<double>{ 0, 0, 1, 1 }), values);
    EXPECT_TRUE(series->LeftOut.empty());
  }
};

TEST_F(TippUgrid, HoldsAMeshAndItsSteps)
{
  this->flatten({ "surge", "--crs", "EPSG:4326" }, "mesh.nc");
  this->expectSurge("mesh.nc");
  EXPECT_NE(std::string::npos, openMeshSeries(this->Folder.path("mesh.nc"))->Crs.find("WGS 84"));
  this->flatten({ "mesh.nc" }, "again.nc");
  this->expectSurge("again.nc");
  EXPECT_EQ(openMeshSeries(this->Folder.path("mesh.nc"))->Crs,
    openMeshSeries(this->Folder.path("again.nc"))->Crs);
}

TEST_F(TippUgrid, HoldsAPartitionedMeshInItsFirstOrder)
{
  const Outcome outcome =
    runTipp(this->Folder, { "partition", "surge", "-o", "surge.tipp", "--tiling", "grid:2x2" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  this->flatten({ "surge.tipp" }, "mesh.nc");
  this->expectSurge("mesh.nc");
  this->flatten({ "surge.tipp" }, "joined");
  const auto valuesIn = [this](const std::string& name)
  {
    const std::string file = contentOf(this->Folder.path(name + ".npy"));
    return file.substr(file.find('\n')); // after the header, which may be padded
  };
  for (const char* name : { "/cells", "/time", "/point_data/level", "/point_data/depth" })
  {
    EXPECT_EQ(valuesIn(std::string("surge") + name), valuesIn(std::string("joined") + name))
      << name;
  }
}

TEST_F(TippUgrid, PiecesHaveTheSameMapsAndSeriesThroughTime)
{
  ASSERT_EQ(0,
    runTipp(this->Folder, { "partition", "surge", "-o", "surge.tipp", "--tiling", "grid:2x2" })
      .ExitCode);
  this->Folder.file("stations.csv", "x,y\n0.25,0.5\n0.5,0.125\n7,7\n");
  std::vector<std::string> maps;
  std::vector<std::string> series;
  for (const char* mesh : { "surge", "surge.tipp" })
  {
    Outcome outcome = runTipp(this->Folder,
      { "resample", mesh, "-o", "level.npy", "--step", "all", "--arrays", "level", "--resolution",
        "0.25" });
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
    maps.push_back(contentOf(this->Folder.path("level.npy")));
    outcome = runTipp(this->Folder,
      { "query", "stations.csv", mesh, "-o", "series.csv", "--step", "all", "--arrays", "level" });
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
    series.push_back(contentOf(this->Folder.path("series.csv")));
  }
  EXPECT_EQ(maps[0], maps[1]);
  EXPECT_EQ(series[0], series[1]);
  EXPECT_NE(std::string::npos, series[0].find("60,1,0.5,0.125,10.5")) << series[0];
}

TEST_F(TippUgrid, FoldersAndPiecesNameWhatTheyDoNotState)
{
  this->flatten({ "surge", "--crs", "EPSG:4326" }, "mesh.nc");
  for (const Words& words : { Words{ "flatten", "mesh.nc", "-o", "folder" },
         Words{ "partition", "mesh.nc", "-o", "mesh.tipp", "--tiling", "grid:1x2" } })
  {
    const Outcome outcome = runTipp(this->Folder, words);
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
    EXPECT_NE(std::string::npos, outcome.Err.find("the output does not state the reference system"))
      << outcome.Err;
  }
  for (const char* mesh : { "folder", "mesh.tipp" })
  {
    const Outcome outcome = runTipp(this->Folder, { "info", mesh });
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
    for (const char* line :
      { "triangles   2\n", "x           0 to 1\n", "steps       4, 0 to 240\n",
        "level       at points, varies\n", "depth       at points\n" })
    {
      EXPECT_NE(std::string::npos, outcome.Out.find(line)) << outcome.Out;
    }
  }
  EXPECT_NE(std::string::npos,
    runTipp(this->Folder, { "info", "mesh.tipp" }).Out.find("mesh.tipp: 2 pieces, 4 points\n"));
}

TEST_F(TippUgrid, FolderOfPiecesWithoutItsIndexIsReported)
{
  std::filesystem::create_directory(this->Folder.path("empty.tipp"));
  const Outcome outcome = runTipp(this->Folder, { "info", "empty.tipp" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("empty.tipp/index.json")) << outcome.Err;
}

TEST_F(TippUgrid, IsPartitionedWithItsSteps)
{
  this->flatten({ "surge" }, "mesh.nc");
  for (const char* input : { "surge", "mesh.nc" })
  {
    const Outcome outcome = runTipp(this->Folder,
      { "partition", input, "-o", std::string(input) + ".tipp", "--tiling", "grid:2x2" });
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  }
  this->Folder.file("stations.csv", "x,y\n0.25,0.5\n0.5,0.125\n");
  std::vector<std::string> series;
  for (const char* mesh : { "surge.tipp", "mesh.nc.tipp" })
  {
    const Outcome outcome = runTipp(this->Folder,
      { "query", "stations.csv", mesh, "-o", "series.csv", "--step", "all", "--arrays", "level" });
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
    series.push_back(contentOf(this->Folder.path("series.csv")));
  }
  EXPECT_EQ(series[0], series[1]);
  const Outcome wrong =
    runTipp(this->Folder, { "partition", "surge", "-o", "no.tipp", "--values", "mesh.nc" });
  EXPECT_EQ(2, wrong.ExitCode);
  EXPECT_NE(std::string::npos, wrong.Err.find("--values and --wrap need the mesh of a model"))
    << wrong.Err;
}

TEST_F(TippUgrid, HoldsATriangulation)
{
  this->Folder.file("points.csv", "x,y,z,rain\n0,0,1,5\n4,0,2,6\n0,3,3,7\n4,3.5,4,8\n");
  const Outcome outcome = runTipp(this->Folder, { "delaunay", "points.csv", "-o", "mesh.nc" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  const auto series = openMeshSeries(this->Folder.path("mesh.nc"));
  EXPECT_EQ((std::vector<double>{ 0, 0, 4, 0, 0, 3, 4, 3.5 }), series->readMesh().XY);
  EXPECT_EQ(6u, series->readMesh().Triangles.size());
  std::vector<double> values;
  series->read(findSeriesVariable(*series, "rain"), 0, values);
  EXPECT_EQ((std::vector<double>{ 5, 6, 7, 8 }), values);
  series->read(findSeriesVariable(*series, "z"), 0, values);
  EXPECT_EQ((std::vector<double>{ 1, 2, 3, 4 }), values);
}

TEST_F(TippUgrid, HasOneStepAsAPlaneOrAsAListOfOne)
{
  this->flatten({ "surge" }, "mesh.nc");
  for (const auto& [step, shape] :
    std::vector<std::pair<std::string, std::string>>{ { "1", "5 x 5" }, { "1:1", "1 x 5 x 5" } })
  {
    for (const char* mesh : { "surge", "mesh.nc" })
    {
      const Outcome outcome = runTipp(this->Folder,
        { "resample", mesh, "-o", "one.npy", "--step", step, "--arrays", "level",
          "--resolution=0.25" });
      ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
      const InputFile file(this->Folder.path("one.npy"));
      EXPECT_EQ(shape, openNpyArray(file).shapeText()) << mesh;
    }
  }
}

TEST_F(TippUgrid, MarksMissingValues)
{
  this->flatten({ "surge" }, "mesh.nc");
  NetcdfFile file(this->Folder.path("mesh.nc"));
  const NetcdfVariable* const level = file.content().find("level");
  ASSERT_NE(nullptr, level);
  EXPECT_TRUE(std::isnan(*level->number("_FillValue")));
  EXPECT_EQ("mesh2d", level->text("mesh"));
  EXPECT_EQ("node", level->text("location"));
  EXPECT_EQ(0, file.content().find("mesh2d_face_nodes")->number("start_index"));
  EXPECT_EQ(2, file.content().find("mesh2d")->number("topology_dimension"));
}

TEST_F(TippUgrid, RefusesTetrahedraAndNamesThatAreTaken)
{
  this->Folder.file("tetrahedron.vtk",
    "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
    "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
  const Outcome solid = runTipp(this->Folder, { "flatten", "tetrahedron.vtk", "-o", "mesh.nc" });
  EXPECT_EQ(1, solid.ExitCode);
  EXPECT_NE(std::string::npos, solid.Err.find("tetrahedron.vtk: has tetrahedra")) << solid.Err;
  this->write<double>("point_data/time", "<f8", "(4,)", { 0, 0, 1, 1 });
  const Outcome taken = runTipp(this->Folder, { "flatten", "surge", "-o", "mesh.nc" });
  EXPECT_EQ(1, taken.ExitCode);
  EXPECT_NE(std::string::npos, taken.Err.find("needs another name for the array 'time'"))
    << taken.Err;
  EXPECT_FALSE(this->exists("mesh.nc"));
}

TEST_F(TippUgrid, TurnsClockwiseTriangles)
{
  this->write<std::int32_t>("cells", "<i4", "(2, 3)", { 0, 3, 1, 1, 2, 3 });
  this->flatten({ "surge" }, "mesh.nc");
  const std::vector<std::int64_t> expected{ 0, 1, 3, 1, 2, 3 };
  EXPECT_EQ(expected, openMeshSeries(this->Folder.path("mesh.nc"))->readMesh().Triangles);
}

TEST_F(TippUgrid, KeepsHeightsBesideAnArrayCalledElevation)
{
  this->write<double>("points", "<f8", "(4, 3)", { 0, 0, 5, 1, 0, 6, 1, 1, 7, 0, 1, 8 });
  this->write<double>("point_data/elevation", "<f8", "(4,)", { 1, 2, 3, 4 });
  this->flatten({ "surge" }, "mesh.nc");
  const auto series = openMeshSeries(this->Folder.path("mesh.nc"));
  std::vector<double> values;
  series->read(findSeriesVariable(*series, "elevation"), 0, values);
  EXPECT_EQ((std::vector<double>{ 1, 2, 3, 4 }), values);
  series->read(findSeriesVariable(*series, "z"), 0, values);
  EXPECT_EQ((std::vector<double>{ 5, 6, 7, 8 }), values);
}

TEST_F(TippUgrid, RefusesWholeNumbersThatStepsWouldRound)
{
  this->write<std::int64_t>("point_data/id", "<i8", "(4,)", { 0, 1, 2, 9007199254740993 });
  const Outcome outcome = runTipp(this->Folder, { "flatten", "surge", "-o", "mesh.nc" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("has whole numbers of 2^53 and more in 'id'"))
    << outcome.Err;
  EXPECT_FALSE(this->exists("mesh.nc"));
}

TEST_F(TippUgrid, RefusesPointsWithoutCoordinatesAndNoTriangles)
{
  this->write<double>("points", "<f8", "(4, 2)", { 0, 0, 1, 0, 1, std::nan(""), 0, 1 });
  const Outcome nowhere = runTipp(this->Folder, { "flatten", "surge", "-o", "mesh.nc" });
  EXPECT_EQ(1, nowhere.ExitCode);
  EXPECT_NE(std::string::npos, nowhere.Err.find("has no finite coordinates at point 2"))
    << nowhere.Err;
  this->Folder.file("line.csv", "x,y\n0,0\n1,1\n2,2\n");
  const Outcome line = runTipp(this->Folder, { "delaunay", "line.csv", "-o", "mesh.nc" });
  EXPECT_EQ(1, line.ExitCode);
  EXPECT_NE(std::string::npos, line.Err.find("would have no triangles")) << line.Err;
  EXPECT_FALSE(this->exists("mesh.nc"));
}

TEST_F(TippUgrid, OfAGeographicMeshIsInDegrees)
{
  this->Folder.file(
    "ring.poly", "4 2 0 0\n1 5 50\n2 6 50\n3 6 51\n4 5 51\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  const Outcome outcome = runTipp(
    this->Folder, { "mesh", "ring.poly", "-o", "mesh.nc", "--size", "20000", "--geographic" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  NetcdfFile file(this->Folder.path("mesh.nc"));
  EXPECT_EQ("degrees_east", file.content().find("mesh2d_node_x")->text("units"));
}

TEST_F(TippUgrid, OfPointsStatesTheirReferenceSystem)
{
  this->Folder.file("points.csv", "x,y\n5,50\n6,50\n5,51\n");
  const Outcome outcome =
    runTipp(this->Folder, { "delaunay", "points.csv", "-o", "points.nc", "--crs", "EPSG:4326" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  NetcdfFile file(this->Folder.path("points.nc"));
  ASSERT_NE(nullptr, file.content().find("crs"));
  EXPECT_EQ(0u, file.content().find("crs")->text("crs_wkt").find("GEOGCS"));
  const Outcome unknown =
    runTipp(this->Folder, { "delaunay", "points.csv", "-o", "unknown.nc", "--crs", "EPSG:99999" });
  EXPECT_EQ(1, unknown.ExitCode);
  EXPECT_FALSE(std::filesystem::exists(this->Folder.path("unknown.nc")));
}

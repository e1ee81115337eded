// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfFile.h"
#include "Series/MeshSeries.h"
#include "TippSeries.h"

#include <gtest/gtest.h>

#include <algorithm>
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

/// The NetCDF file "mesh.nc" of a surge that says what its numbers mean, and what is made of it.
class TippDescribed : public TippUgrid
{
protected:
  TippDescribed()
  {
    this->Folder.file("surge/description.json", R"({
      "time_units": "seconds since 2018-09-01 00:00:00", "calendar": "gregorian",
      "crs": "EPSG:32617", "point_data": {"level": {"units": "m", "missing_value": -99999,
        "long_name": "water level", "standard_name": "sea_surface_height_above_geoid"}}})");
    this->flatten({ "surge" }, "mesh.nc");
  }

  void make(const Words& words) const
  {
    const Outcome outcome = runTipp(this->Folder, words);
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
    EXPECT_EQ("", outcome.Err);
  }

  void makeFolderAndPieces() const
  {
    this->make({ "flatten", "mesh.nc", "-o", "folder" });
    this->make({ "partition", "mesh.nc", "-o", "mesh.tipp", "--tiling", "grid:1x2" });
  }

  /// Expects two NetCDF files to have the same variables, attributes and values, except for the
  /// name of the file that they were made of.
  void expectEqual(const std::string& a, const std::string& b) const
  {
    NetcdfFile first(this->Folder.path(a));
    NetcdfFile second(this->Folder.path(b));
    ASSERT_EQ(first.content().Variables.size(), second.content().Variables.size());
    for (const NetcdfVariable& variable : first.content().Variables)
    {
      const NetcdfVariable* const other = second.content().find(variable.Name);
      ASSERT_NE(nullptr, other) << variable.Name;
      EXPECT_EQ(first.content().shape(variable), second.content().shape(*other));
      EXPECT_EQ(variable.Type, other->Type) << variable.Name;
      EXPECT_EQ(variable.Attributes.size(), other->Attributes.size()) << variable.Name;
      for (const NetcdfAttribute& attribute : variable.Attributes)
      {
        EXPECT_EQ(attribute.Text, other->text(attribute.Name))
          << variable.Name << ":" << attribute.Name;
      }
      const std::vector<double> values = first.read(variable);
      const std::vector<double> others = second.read(*other);
      ASSERT_EQ(values.size(), others.size());
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        EXPECT_TRUE(values[i] == others[i] || (std::isnan(values[i]) && std::isnan(others[i])))
          << variable.Name << " " << i;
      }
    }
  }
};

TEST_F(TippDescribed, IsDescribedByInfoAsTheFile)
{
  this->makeFolderAndPieces();
  for (const char* mesh : { "folder", "mesh.tipp" })
  {
    const Outcome outcome = runTipp(this->Folder, { "info", mesh });
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
    for (const char* line : { "triangles   2\n", "x           0 to 1\n", "y           0 to 1\n",
           "steps       4, 0 to 240 seconds since 2018-09-01 00:00:00, calendar gregorian\n",
           "level       at points, varies, in m: water level\n", "depth       at points\n",
           "CRS         PROJCS[" })
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

TEST_F(TippDescribed, HasTheSameMapsInFoldersAndPieces)
{
  this->makeFolderAndPieces();
  for (const std::string mesh : { "mesh.nc", "folder", "mesh.tipp" })
  {
    this->make({ "resample", mesh, "-o", mesh + ".maps.nc", "--step", "all", "--dims", "9", "7" });
  }
  NetcdfFile file(this->Folder.path("mesh.nc.maps.nc"));
  const NetcdfVariable* const level = file.content().find("level");
  ASSERT_NE(nullptr, level);
  EXPECT_EQ("seconds since 2018-09-01 00:00:00", file.content().find("time")->text("units"));
  EXPECT_EQ("gregorian", file.content().find("time")->text("calendar"));
  EXPECT_EQ(0u, file.content().find("crs")->text("crs_wkt").find("PROJCS"));
  EXPECT_EQ("sea_surface_height_above_geoid", level->text("standard_name"));
  EXPECT_EQ("m", level->text("units"));
  EXPECT_TRUE(std::isnan(file.read(*level).back())); // the dry corner
  this->expectEqual("mesh.nc.maps.nc", "folder.maps.nc");
  this->expectEqual("mesh.nc.maps.nc", "mesh.tipp.maps.nc");
}

TEST_F(TippDescribed, HasTheSameMapsInTheVtkHdfFileOfItsPieces)
{
  this->makeFolderAndPieces();
  this->make({ "resample", "mesh.tipp", "-o", "a.nc", "--step", "all", "--dims", "9", "7" });
  this->make(
    { "resample", "mesh.tipp/mesh.vtkhdf", "-o", "b.nc", "--step", "all", "--dims", "9", "7" });
  this->expectEqual("a.nc", "b.nc");
  this->make({ "flatten", "mesh.tipp/mesh.vtkhdf", "-o", "c.nc" });
  this->expectEqual("mesh.nc", "c.nc");
}

TEST_F(TippDescribed, IsNotStatedByVtkHdfFilesWhichAWarningSays)
{
  this->makeFolderAndPieces();
  const Outcome outcome = runTipp(this->Folder, { "flatten", "mesh.tipp", "-o", "alone.vtkhdf" });
  EXPECT_EQ(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("does not state units")) << outcome.Err;
}

TEST_F(TippDescribed, ACopyOfTheVtkHdfFileWithoutItsPiecesIsRefused)
{
  this->makeFolderAndPieces();
  std::filesystem::copy_file(
    this->Folder.path("mesh.tipp/mesh.vtkhdf"), this->Folder.path("copy.vtkhdf"));
  const Outcome outcome = runTipp(this->Folder, { "flatten", "copy.vtkhdf", "-o", "copy.nc" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("cells without a type")) << outcome.Err;
}

TEST_F(TippDescribed, CopiesOfCellsInAVtkHdfFileAreNoCells)
{
  std::string points = "x,y,z\n";
  for (int i = 0; i < 100; ++i)
  {
    points += std::to_string(i % 10) + "," + std::to_string(i / 10) + ",1\n";
  }
  this->Folder.file("points.csv", points);
  this->make({ "delaunay", "points.csv", "-o", "lattice.vtu" });
  this->make({ "partition", "lattice.vtu", "-o", "twice.tipp", "--tiling", "grid:2x2",
    "--borrowers", "duplicate" });
  this->make({ "flatten", "twice.tipp", "-o", "twice.vtkhdf" });
  for (const char* mesh : { "twice.tipp", "twice.vtkhdf", "twice.tipp/mesh.pvtu" })
  {
    this->make(
      { "query", mesh, "-o", "cells.csv", "--ids", "cells", "--bounds", "0", "9", "0", "9" });
    const std::string cells = contentOf(this->Folder.path("cells.csv"));
    EXPECT_EQ(1 + 162, std::count(cells.begin(), cells.end(), '\n')) << mesh;
    this->make({ "volume", mesh, "lattice.vtu" });
  }
}

TEST_F(TippUgrid, AFlatMeshIsNotFlattenedAgain)
{
  const Outcome outcome = runTipp(this->Folder, { "flatten", "surge", "-o", "again" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(std::string::npos, outcome.Err.find("is a flat mesh already")) << outcome.Err;
}

TEST_F(TippDescribed, IsTheSameUgridFromFoldersAndPieces)
{
  this->makeFolderAndPieces();
  this->flatten({ "folder" }, "folder.nc");
  this->flatten({ "mesh.tipp" }, "pieces.nc");
  this->expectEqual("mesh.nc", "folder.nc");
  this->expectEqual("mesh.nc", "pieces.nc");
}

TEST_F(TippDescribed, KeepsTheDescriptionFromPiecesToAFolder)
{
  this->makeFolderAndPieces();
  this->make({ "flatten", "mesh.tipp", "-o", "joined" });
  EXPECT_EQ(contentOf(this->Folder.path("folder/description.json")),
    contentOf(this->Folder.path("joined/description.json")));
  this->make({ "partition", "joined", "-o", "again.tipp", "--tiling", "grid:1x2" });
  EXPECT_EQ(contentOf(this->Folder.path("mesh.tipp/index.json")),
    contentOf(this->Folder.path("again.tipp/index.json")));
}

TEST_F(TippDescribed, IsWarnedOfWhereMissingValuesAreNumbers)
{
  this->make({ "partition", "surge", "-o", "surge.tipp", "--tiling", "grid:1x2" });
  const Words one = { "resample", "surge.tipp", "-o", "a.npy", "--arrays", "level", "--step", "3",
    "--dims", "5", "5" };
  const Outcome warned = runTipp(this->Folder, one);
  EXPECT_EQ(0, warned.ExitCode);
  EXPECT_NE(std::string::npos,
    warned.Err.find("surge.tipp: 'level' has -99999 where it has no value, which counts as a "
                    "number here; give --no-data=-99999.\n"))
    << warned.Err;
  Words told = one;
  told.emplace_back("--no-data=-99999");
  this->make(told);
  this->Folder.file("points.csv", "x,y\n0.75,0.75\n");
  const Words query = { "query", "points.csv", "surge.tipp", "-o", "points.out.csv", "--step" };
  Words number = query;
  number.emplace_back("3");
  EXPECT_NE(std::string::npos,
    runTipp(this->Folder, number).Err.find("for values at points without it, give --step 3:3.\n"));
  Words list = query;
  list.emplace_back("3:3");
  this->make(list);
}

TEST_F(TippDescribed, NamesTheUnitOfTimesAtStations)
{
  this->makeFolderAndPieces();
  this->Folder.file("stations.csv", "x,y\n0.25,0.5\n");
  std::vector<std::string> series;
  for (const char* mesh : { "mesh.nc", "folder", "mesh.tipp" })
  {
    this->make(
      { "query", "stations.csv", mesh, "-o", "series.csv", "--step", "all", "--arrays", "level" });
    series.push_back(contentOf(this->Folder.path("series.csv")));
  }
  EXPECT_EQ("time (seconds since 2018-09-01 00:00:00),station,x,y,level",
    series[0].substr(0, series[0].find('\n')));
  EXPECT_EQ(series[0], series[1]);
  EXPECT_EQ(series[0], series[2]);
}

TEST_F(TippDescribed, KeepsDryNodesOfAdcirc)
{
  this->Folder.file("fort.14", "title\n1 3\n1 0 0 5\n2 4 0 5\n3 0 4 5\n1 3 1 2 3\n");
  this->Folder.file(
    "fort.63", "title\n2 3 60 1 1\n60 1\n1 0.5\n2 0.5\n3 0.5\n120 2\n1 0.25\n2 -99999\n3 0.5\n");
  this->make({ "flatten", "fort.14", "--values", "fort.63", "-o", "flat" });
  this->make({ "resample", "fort.14", "--values", "fort.63", "--dims", "5", "5", "-o", "a.nc" });
  this->make({ "resample", "flat", "--step", "all", "--dims", "5", "5", "-o", "b.nc" });
  this->expectEqual("a.nc", "b.nc");
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

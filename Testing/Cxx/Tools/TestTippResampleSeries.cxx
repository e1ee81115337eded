// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/ReadRaster.h"
#include "TippSeries.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace tipp;
using namespace tipp::test;

TEST_F(TippResampleSeries, WritesAllStepsAsOneArray)
{
  const Outcome outcome = this->run({ "-o", "level.npy", "--step", "all", "--arrays", "level" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(outcome.Out.find("25 of 25 samples, 1 array, 4 steps"), std::string::npos)
    << outcome.Out;
  const std::vector<float> values = this->readNpy("level.npy", "4 x 5 x 5");
  for (std::size_t i = 0; i < 50; ++i)
  {
    EXPECT_EQ(0.25F * float(i % 5) + 10 * float(i / 25), values[i]);
  }
}

TEST_F(TippResampleSeries, TakesStepsByFirstLastAndStride)
{
  for (const auto& [steps, first, count] :
    std::vector<std::tuple<std::string, float, std::string>>{ { "1:3:2", 10, "2" },
      { ":2", 0, "3" }, { "2:", 20, "2" }, { "::3", 0, "2" }, { "3:3", 30, "1" } })
  {
    ASSERT_EQ(0, this->run({ "-o", "some.npy", "--step", steps, "--arrays", "level" }).ExitCode);
    EXPECT_EQ(first, this->readNpy("some.npy", count + " x 5 x 5")[0]) << steps;
  }
}

TEST_F(TippResampleSeries, RefusesStepsThatThereAreNot)
{
  for (const char* steps : { "0:4", "2:1", "4:", "0:99999999999" })
  {
    const Outcome outcome = this->run({ "-o", "no.npy", "--step", steps, "--arrays", "level" });
    EXPECT_EQ(1, outcome.ExitCode) << steps;
    EXPECT_NE(outcome.Err.find("surge: has no time step"), std::string::npos) << outcome.Err;
    EXPECT_FALSE(this->exists("no.npy"));
  }
  for (const char* steps :
    { "-1", "-1:2", "a:b", "0:1:1:1", "0:99999999999999999999", "every", " 1", "1 ", "" })
  {
    const Outcome outcome = this->run({ "-o", "no.npy", "--step", steps, "--arrays", "level" });
    EXPECT_EQ(2, outcome.ExitCode) << steps;
    EXPECT_NE(outcome.Err.find("is neither a number of a step"), std::string::npos) << outcome.Err;
  }
  const Outcome standing = this->run({ "-o", "no.npy", "--step", "::0", "--arrays", "level" });
  EXPECT_EQ(2, standing.ExitCode);
  EXPECT_NE(standing.Err.find("the stride of '::0' must be at least 1"), std::string::npos)
    << standing.Err;
}

TEST_F(TippResampleSeries, NeedsLittleMemoryForTrianglesBesideSamples)
{
  // The flat mesh "coast": 1.21 million nodes and twice as many triangles, 50 MB.
  constexpr std::int32_t side = 1100;
  std::vector<double> points;
  std::vector<std::int32_t> cells;
  for (std::int32_t i = 0; i < side * side; ++i)
  {
    points.insert(points.end(), { double(i % side), double(i / side) });
    if (i % side + 1 < side && i / side + 1 < side)
    {
      cells.insert(cells.end(), { i, i + 1, i + side, i + 1, i + 1 + side, i + side });
    }
  }
  std::filesystem::create_directories(this->Folder.path("coast/point_data"));
  const auto write = [&](const std::string& name, const std::string& descr,
                       const std::string& shape, const std::string& bytes)
  { this->Folder.file("coast/" + name + ".npy", npyBytes(npyHeader(descr, shape), bytes)); };
  write("cells", "<i4", "(" + std::to_string(cells.size() / 3) + ", 3)", bytesOf(cells));
  write("points", "<f8", "(1210000, 2)", bytesOf(points));
  write("point_data/level", "<f8", "(2, 1210000)", bytesOf(points));
  write("time", "<f8", "(2,)", bytesOf(std::vector<double>{ 0, 60 }));
  const auto peakOf = [this](const std::string& mesh)
  {
    const Outcome outcome = runTipp(this->Folder,
      { "resample", mesh, "-o", "out.npy", "--dims", "20", "20", "--step", "all", "--arrays",
        "level", "--threads", "2" });
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    const std::string before = "peak memory ";
    return std::stod(outcome.Out.substr(outcome.Out.find(before) + before.size()));
  };
  // The nodes take 19 MB, and a block of cells 25 MB; the whole mesh took 125 MB.
  EXPECT_LT(peakOf("coast"), peakOf("surge") + 80);
}

TEST_F(TippResampleSeries, LeavesTrianglesWithADryCornerOut)
{
  ASSERT_EQ(0,
    this->run({ "-o", "level.npy", "--step", "2:2", "--arrays", "level", "--no-data=-99999" })
      .ExitCode);
  const std::vector<float> values = this->readNpy("level.npy", "1 x 5 x 5");
  EXPECT_EQ(20.25F, values[1]);
  EXPECT_TRUE(std::isnan(values[24]));
}

TEST_F(TippResampleSeries, ReducesTheSteps)
{
  const Outcome outcome = this->run(
    { "-o", "longest.npy", "--reduce", "above:15", "--arrays", "level", "--no-data=-99999" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  const std::vector<float> values = this->readNpy("longest.npy", "5 x 5");
  EXPECT_EQ(150, values[0]);
  EXPECT_EQ(0, values[24]);
}

TEST_F(TippResampleSeries, WritesGeoTiffsOfStepsAndOfOtherFields)
{
  const Outcome outcome = this->run({ "-o", "maps.tif", "--step", "1:3:2", "--crs", "EPSG:32633" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  for (const char* name : { "maps_0001.tif", "maps_0003.tif", "maps.tif" })
  {
    const RasterInfo info = *readGeoTiffInfo(this->Folder.path(name));
    EXPECT_EQ(5, info.Grid.Columns);
    EXPECT_EQ(-0.125, info.Grid.West);
  }
  EXPECT_FALSE(this->exists("maps_0000.tif"));
  ASSERT_EQ(0, this->run({ "-o", "one.tif", "--step", "1:1", "--arrays", "level" }).ExitCode);
  EXPECT_TRUE(this->exists("one.tif"));
  EXPECT_FALSE(this->exists("one_0001.tif"));
}

TEST_F(TippResampleSeries, ListsImagesForParaView)
{
  const Outcome outcome = this->run({ "-o", "maps.pvd", "--step", "2:" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  const std::string list = contentOf(this->Folder.path("maps.pvd"));
  EXPECT_NE(list.find("timestep=\"120\" file=\"maps_0002.vti\""), std::string::npos) << list;
  EXPECT_NE(list.find("timestep=\"240\" file=\"maps_0003.vti\""), std::string::npos) << list;
  const std::string image = contentOf(this->Folder.path("maps_0003.vti"));
  EXPECT_NE(image.find("Name=\"level\""), std::string::npos);
  EXPECT_NE(contentOf(this->Folder.path("maps.vti")).find("Name=\"depth\""), std::string::npos);
}

TEST_F(TippResampleSeries, ListsTheImageOfWhatDoesNotVary)
{
  const Outcome outcome = this->run({ "-o", "maps.pvd", "--step", "all", "--arrays", "depth" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  const std::string list = contentOf(this->Folder.path("maps.pvd"));
  EXPECT_NE(list.find("timestep=\"0\" file=\"maps.vti\""), std::string::npos) << list;
  EXPECT_NE(contentOf(this->Folder.path("maps.vti")).find("Name=\"depth\""), std::string::npos);
  EXPECT_FALSE(this->exists("maps_0000.vti"));
}

TEST_F(TippResampleSeries, DrawsTheWaterline)
{
  const Words words = { "-o", "water.npy", "--step", "2:2", "--arrays", "level",
    "--no-data=-99999" };
  Words drawn = words;
  drawn.insert(drawn.end(), { "--waterline", "depth" });
  const Outcome outcome = this->run(drawn);
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_FLOAT_EQ(20.5F, this->readNpy("water.npy", "1 x 5 x 5")[24]);
}

TEST_F(TippResampleSeries, ExplainsWhatDoesNotFit)
{
  const std::vector<std::pair<Words, std::string>> wrong = {
    { { "-o", "a.npy", "--step", "all" }, "holds one array, and there would be 2" },
    { { "-o", "a.nc", "--step", "all", "--arrays", "speed" },
      "has no variable 'speed'; there are 'depth', 'level'" },
    { { "-o", "a.nc", "--reduce", "median" }, "give max, min, mean" },
    { { "-o", "a.nc", "--step", "all", "--method", "conservative" },
      "conservative is for a single step" },
    { { "-o", "a.nc", "--step", "all", "--device", "opencl" }, "must be openmp" },
    { { "-o", "a.nc", "--step", "all", "--null", "0" },
      "samples of time steps that have no value" },
    { { "-o", "a.nc", "--step", "all", "--bounds", "5", "6", "5", "6" },
      "has nothing in --bounds" },
    { { "-o", "a.nc", "--step", "all", "--waterline", "level", "--arrays", "level" },
      "needs depths at nodes" },
    { { "-o", "a.nc", "--step", "all", "--with-steps" }, "needs --reduce" },
    { { "-o", "a.vti", "--step", "all" }, "must end in" },
    { { "-o", "a.nc", "--step", "all", "--crs", "EPSG:nonsense" }, "EPSG:nonsense" },
  };
  for (const auto& [words, text] : wrong)
  {
    const Outcome outcome = this->run(words);
    EXPECT_NE(0, outcome.ExitCode) << text;
    EXPECT_NE(outcome.Err.find(text), std::string::npos) << outcome.Err;
  }
  EXPECT_FALSE(this->exists("a.nc"));
}

TEST_F(TippResampleSeries, DoesNotDependOnThreads)
{
  for (const char* threads : { "1", "3" })
  {
    ASSERT_EQ(0,
      runTipp(this->Folder,
        { "resample", "surge", "-o", std::string(threads) + ".npy", "--step", "all", "--arrays",
          "level", "--dims", "301", "200", "--threads", threads })
        .ExitCode);
  }
  EXPECT_EQ(contentOf(this->Folder.path("1.npy")), contentOf(this->Folder.path("3.npy")));
}

TEST_F(TippResampleSeries, IsAskedForValuesAtStations)
{
  this->Folder.file("gauges.csv", "x,y\n0.5,0.25\n1,1\n5,5\n");
  const Outcome outcome = runTipp(this->Folder,
    { "query", "gauges.csv", "surge", "-o", "series.csv", "--step", "1:2", "--no-data=-99999" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(outcome.Out.find("3 stations, 1 outside of the mesh, 2 steps"), std::string::npos);
  EXPECT_EQ("time,station,x,y,level\n60,0,0.5,0.25,10.5\n60,1,1,1,11\n60,2,5,5,\n"
            "120,0,0.5,0.25,20.5\n120,1,1,1,\n120,2,5,5,\n",
    contentOf(this->Folder.path("series.csv")));
}

TEST_F(TippResampleSeries, RefusesStationsThatAreAllOutside)
{
  this->Folder.file("gauges.csv", "x,y\n500000,4000000\n510000,4010000\n");
  const Outcome outcome =
    runTipp(this->Folder, { "query", "gauges.csv", "surge", "-o", "series.csv" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("gauges.csv: has no point in the mesh: the points have x from 500000 "
                             "to 510000, y from 4e+06 to 4.01e+06, and the triangles of the mesh x "
                             "from 0 to 1, y from 0 to 1"),
    std::string::npos)
    << outcome.Err;
  EXPECT_FALSE(this->exists("series.csv"));
}

TEST_F(TippResampleSeries, WarnsOfOneSample)
{
  for (const char* step : { "all", "1" })
  {
    const Outcome outcome =
      this->run({ "-o", "one.npy", "--step", step, "--arrays", "level" }, "--resolution=5000");
    EXPECT_EQ(0, outcome.ExitCode) << outcome.Err;
    EXPECT_NE(outcome.Err.find("surge: there is one sample, because the distance of samples, 5000, "
                               "is larger than the range"),
      std::string::npos)
      << outcome.Err;
  }
  EXPECT_EQ("",
    this->run({ "-o", "some.npy", "--step", "all", "--arrays", "level" }, "--resolution=0.75").Err);
}

TEST_F(TippResampleSeries, NamesTheStepOfAQueryWithoutOne)
{
  this->Folder.file("gauges.csv", "x,y\n0.5,0.25\n");
  ASSERT_EQ(0, runTipp(this->Folder, { "partition", "surge", "-o", "surge.tipp" }).ExitCode);
  const Words query = { "query", "gauges.csv", "surge.tipp", "-o", "values.csv" };
  const Outcome first = runTipp(this->Folder, query);
  EXPECT_EQ(0, first.ExitCode) << first.Err;
  EXPECT_NE(first.Err.find("surge.tipp: has 4 time steps, and the values are those of the first "
                           "one, at 0; give --step."),
    std::string::npos)
    << first.Err;
  Words second = query;
  second.insert(second.end(), { "--step", "0" });
  EXPECT_EQ("", runTipp(this->Folder, second).Err);
}

TEST_F(TippResampleSeries, IsAskedForStationsAsAnArray)
{
  this->Folder.file("gauges.csv", "x,y\n0.5,0.25\n1,0\n");
  ASSERT_EQ(0,
    runTipp(this->Folder,
      { "query", "gauges.csv", "surge", "-o", "series.npy", "--step", "all", "--arrays",
        "level,depth" })
      .ExitCode);
  const InputFile file(this->Folder.path("series.npy"));
  const NpyArray array = openNpyArray(file);
  EXPECT_EQ("4 x 2 x 2", array.shapeText());
  std::vector<double> values(16);
  file.read(array.Offset, values.data(), values.size() * sizeof(double));
  EXPECT_EQ((std::vector<double>{
              0.5, 0.25, 1, 0, 10.5, 0.25, 11, 0, 20.5, 0.25, 21, 0, 30.5, 0.25, 31, 0 }),
    values);
}

TEST_F(TippResampleSeries, RefusesQueriesThatNeedAPartitionedMesh)
{
  this->Folder.file("gauges.csv", "x,y\n0.5,0.25\n");
  const Outcome outcome = runTipp(
    this->Folder, { "query", "gauges.csv", "surge", "-o", "no.csv", "--step", "all", "--closest" });
  EXPECT_NE(0, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("partition it first"), std::string::npos) << outcome.Err;
}

TEST_F(TippResampleSeries, WritesAllFilesOrNone)
{
  this->write<double>("point_data/level", "<f8", "(4, 4)",
    { 0, 1, 1, 0, 10, 11, 11, 10, 20, 21, 21, 20, 1e40, 31, 31, 30 });
  this->Folder.file("maps_0001.tif", "of the user");
  for (const char* const name : { "maps.tif", "maps.pvd" })
  {
    const Outcome outcome = this->run({ "-o", name, "--step", "all", "--arrays", "level" });
    EXPECT_EQ(1, outcome.ExitCode);
    EXPECT_NE(outcome.Err.find("which 32 bits do not hold"), std::string::npos) << outcome.Err;
  }
  EXPECT_EQ("of the user", contentOf(this->Folder.path("maps_0001.tif")));
  for (const auto& entry : std::filesystem::directory_iterator(this->Folder.path("")))
  {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(
      name == "surge" || name == "maps_0001.tif" || name.find("maps") == std::string::npos)
      << name;
  }
}

TEST_F(TippResampleSeries, NamesAFieldThatWouldBeThereTwice)
{
  const Outcome outcome =
    this->run({ "-o", "twice.nc", "--reduce", "max", "max", "--arrays", "level" });
  EXPECT_EQ(1, outcome.ExitCode);
  EXPECT_NE(outcome.Err.find("the name 'level_max' twice"), std::string::npos) << outcome.Err;
}

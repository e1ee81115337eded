// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfFile.h"
#include "Npy/NpyFile.h"
#include "Raster/ReadRaster.h"
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

using namespace tipp;
using namespace tipp::test;

namespace
{

using Words = std::vector<std::string>;

/// A folder with the flat mesh "surge": a unit square whose level is x + 10 * step at four steps,
/// dry (-99999) at the corner (1, 1) from step 2 on, and whose depth is y.
class TippResampleSeries : public testing::Test
{
protected:
  TippResampleSeries()
  {
    std::filesystem::create_directories(this->Folder.path("surge/point_data"));
    this->write<std::int32_t>("cells", "<i4", "(2, 3)", { 0, 1, 3, 1, 2, 3 });
    this->write<double>("points", "<f8", "(4, 2)", { 0, 0, 1, 0, 1, 1, 0, 1 });
    this->write<double>("time", "<f8", "(4,)", { 0, 60, 120, 240 });
    this->write<double>("point_data/level", "<f8", "(4, 4)",
      { 0, 1, 1, 0, 10, 11, 11, 10, 20, 21, -99999, 20, 30, 31, -99999, 30 });
    this->write<double>("point_data/depth", "<f8", "(4,)", { 0, 0, 1, 1 });
  }

  template <typename Value>
  void write(const std::string& name, const std::string& descr, const std::string& shape,
    const std::vector<Value>& values) const
  {
    this->Folder.file("surge/" + name + ".npy", npyBytes(npyHeader(descr, shape), bytesOf(values)));
  }

  /// Runs `tipp resample surge` with five samples along each axis.
  Outcome run(const Words& more, const std::string& grid = "--resolution=0.25") const
  {
    Words words = { "resample", "surge", grid };
    words.insert(words.end(), more.begin(), more.end());
    return runTipp(this->Folder, words);
  }

  std::vector<float> readNpy(const std::string& name, const std::string& shape) const
  {
    const InputFile file(this->Folder.path(name));
    const NpyArray array = openNpyArray(file);
    EXPECT_EQ(shape, array.shapeText());
    EXPECT_EQ(Scalar::Float32, array.Type);
    std::vector<float> values((file.size() - array.Offset) / sizeof(float));
    file.read(array.Offset, values.data(), values.size() * sizeof(float));
    return values;
  }

  bool exists(const std::string& name) const
  {
    return std::filesystem::exists(this->Folder.path(name));
  }

  TemporaryFolder Folder;
};

} // namespace

TEST_F(TippResampleSeries, WritesAllStepsAsOneArray)
{
  const Outcome outcome = this->run({ "-o", "level.npy", "--step", "all", "--arrays", "level" });
  ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  EXPECT_NE(outcome.Out.find("25 of 25 samples, 1 arrays, 4 steps"), std::string::npos)
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
    const Outcome outcome = this->run(
      { "-o", "some.npy", "--step", steps, "--arrays", "level", "--with-steps", "--reduce" });
    EXPECT_NE(0, outcome.ExitCode);
    ASSERT_EQ(0, this->run({ "-o", "some.npy", "--step", steps, "--arrays", "level" }).ExitCode);
    EXPECT_EQ(first, this->readNpy("some.npy", count + " x 5 x 5")[0]) << steps;
  }
}

TEST_F(TippResampleSeries, RefusesStepsThatThereAreNot)
{
  for (const char* steps :
    { "0:4", "2:1", "::0", "-1:2", "a:b", "0:1:1:1", "0:99999999999999999999" })
  {
    const Outcome outcome = this->run({ "-o", "no.npy", "--step", steps, "--arrays", "level" });
    EXPECT_EQ(1, outcome.ExitCode) << steps;
    EXPECT_NE(outcome.Err.find("surge: has no time step"), std::string::npos) << outcome.Err;
    EXPECT_FALSE(this->exists("no.npy"));
  }
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

TEST_F(TippResampleSeries, WritesNetcdfInTheMannerOfCf)
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
      "has no array 'speed'; it has depth" },
    { { "-o", "a.nc", "--reduce", "median" }, "give max, min, mean" },
    { { "-o", "a.nc", "--step", "all", "--method", "conservative" }, "conservative is for single" },
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatSeries.h"

#include "ExpectIOError.h"
#include "FlatTesting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace tipp;
using namespace tipp::test;

TEST(FlatSeries, HasTheVariablesOfTheFolder)
{
  const FlatFolderMaker folder;
  folder.writeSquare();
  folder.write<double>("time.npy", "<f8", "(2,)", { 0, 60 });
  folder.write<float>("point_data/zeta.npy", "<f4", "(2, 4)", { 1, 2, 3, 4, 5, 6, 7, 8 });
  folder.write<double>("point_data/wind.npy", "<f8", "(2, 4, 2)",
    { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16 });
  folder.write<std::int32_t>("cell_data/zone.npy", "<i4", "(2,)", { 8, 9 });
  const auto series = openFlatSeries(folder.path());
  ASSERT_EQ(4u, series->Variables.size());
  EXPECT_EQ((std::vector<double>{ 0, 60 }), series->Times);
  EXPECT_EQ(4, series->Nodes);
  const SeriesMesh mesh = series->readMesh();
  EXPECT_EQ((std::vector<double>{ 0, 0, 1, 0, 1, 1, 0, 1 }), mesh.XY);
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 1, 2, 0, 2, 3 }), mesh.Triangles);
  std::vector<double> values;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const SeriesVariable& variable = series->Variables[i];
    series->read(i, 1, values);
    if (variable.Name == "zeta")
    {
      EXPECT_EQ((std::vector<double>{ 5, 6, 7, 8 }), values);
      EXPECT_EQ(Scalar::Float32, variable.Type);
    }
    else if (variable.Name == "wind_1")
    {
      EXPECT_EQ((std::vector<double>{ 10, 12, 14, 16 }), values);
    }
    else if (variable.Name == "zone")
    {
      EXPECT_EQ((std::vector<double>{ 8, 9 }), values);
      EXPECT_TRUE(variable.OnCells);
      EXPECT_FALSE(variable.Varies);
    }
    else
    {
      EXPECT_EQ("wind_0", variable.Name);
    }
  }
}

TEST(FlatSeries, TakesAThirdCoordinateForTheElevation)
{
  const FlatFolderMaker folder;
  folder.write<std::int32_t>("cells.npy", "<i4", "(1, 3)", { 0, 1, 2 });
  folder.write<float>("points.npy", "<f4", "(3, 3)", { 0, 0, 5, 1, 0, 6, 0, 1, 7 });
  const auto series = openFlatSeries(folder.path());
  ASSERT_EQ(1u, series->Variables.size());
  EXPECT_EQ("elevation", series->Variables[0].Name);
  std::vector<double> values;
  series->read(0, 0, values);
  EXPECT_EQ((std::vector<double>{ 5, 6, 7 }), values);
  EXPECT_TRUE(series->Times.empty());
}

TEST(FlatSeries, RefusesTetrahedra)
{
  const FlatFolderMaker folder;
  folder.write<std::int32_t>("cells.npy", "<i4", "(1, 4)", { 0, 1, 2, 3 });
  folder.write<float>("points.npy", "<f4", "(4, 3)", { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 });
  expectIOError(folder.path(), "has tetrahedra", [&] { openFlatSeries(folder.path()); });
}

namespace
{

/// Writes a square with two steps of a level, of which one value is missing, and of a wind.
void describeSquare(const FlatFolderMaker& folder)
{
  folder.writeSquare();
  folder.write<double>("time.npy", "<f8", "(2,)", { 0, 60 });
  folder.write<float>("point_data/level.npy", "<f4", "(2, 4)", { 1, 2, 3, 4, 5, -99999, 7, 8 });
  folder.write<double>("point_data/wind.npy", "<f8", "(4, 2)", { 1, 2, 3, 4, 5, 6, 7, 8 });
  std::ofstream(folder.path("description.json")) << R"({
    "time_units": "minutes since 2001-02-03", "calendar": "noleap", "crs": "EPSG:4326",
    "point_data": {
      "level": {"long_name": "water level", "units": "m", "standard_name": "sea_level",
        "missing_value": -99999},
      "wind": {"units": "m s-1", "components": ["u", "v"]}}})";
}

} // namespace

TEST(FlatSeries, SaysWhatItsNumbersMean)
{
  const FlatFolderMaker folder;
  describeSquare(folder);
  const auto series = openFlatSeries(folder.path());
  EXPECT_EQ("minutes since 2001-02-03", series->TimeUnits);
  EXPECT_EQ("noleap", series->Calendar);
  EXPECT_EQ("EPSG:4326", series->Crs);
  const SeriesVariable& level = series->Variables[findSeriesVariable(*series, "level")];
  EXPECT_EQ("water level", level.LongName);
  EXPECT_EQ("sea_level", level.StandardName);
  EXPECT_EQ("m", level.Units);
  EXPECT_EQ("m s-1", series->Variables[findSeriesVariable(*series, "u")].Units);
  std::vector<double> values;
  series->read(findSeriesVariable(*series, "v"), 0, values);
  EXPECT_EQ((std::vector<double>{ 2, 4, 6, 8 }), values);
}

TEST(FlatSeries, TakesTheMissingValueForNaN)
{
  const FlatFolderMaker folder;
  describeSquare(folder);
  const auto series = openFlatSeries(folder.path());
  const std::size_t level = findSeriesVariable(*series, "level");
  std::vector<double> values;
  series->read(level, 1, values);
  EXPECT_EQ(5, values[0]);
  EXPECT_TRUE(std::isnan(values[1]));
  series->readAt(level, 1, { 1, 2 }, values);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(7, values[1]);
}

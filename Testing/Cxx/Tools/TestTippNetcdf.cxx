// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfFile.h"
#include "TippSeries.h"

#include <gtest/gtest.h>

#include <cmath>
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

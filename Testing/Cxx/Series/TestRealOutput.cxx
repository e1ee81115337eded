// SPDX-License-Identifier: BSD-3-Clause
#include "Series/MeshSeries.h"
#include "SharedData.h"

#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using Doubles = std::vector<double>;

/// The sums and values below were computed by netCDF4 and NumPy.
double sumOf(const Doubles& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(RealOutput, OfAdcircAsUgridHasItsValues)
{
  TIPP_REQUIRE_DATA(path, "netcdf/adcirc_1t.nc");
  const auto series = openMeshSeries(path);
  EXPECT_EQ("UGRID", series->Kind);
  EXPECT_EQ("hours since 1970-01-01T00:00:00+00:00", series->TimeUnits);
  EXPECT_EQ((Doubles{ 435576, 435576.5 }), series->Times);
  EXPECT_EQ("EPSG:4326", series->Crs);
  const SeriesMesh mesh = series->readMesh();
  ASSERT_EQ(3U * 23860, mesh.Triangles.size());
  EXPECT_EQ(
    469791678, std::accumulate(mesh.Triangles.begin(), mesh.Triangles.end(), std::int64_t(0)));
  Doubles values;
  series->read(findSeriesVariable(*series, "ssh"), 1, values);
  EXPECT_NEAR(10222.237361878157, sumOf(values), 1e-8);
  EXPECT_EQ(0.7955889701843262, values.at(12345));
  series->read(findSeriesVariable(*series, "u"), 0, values);
  EXPECT_NEAR(-781.3220677529707, sumOf(values), 1e-8);
}

TEST(RealOutput, OfDelft3dIsOnPolygonsThatAreCut)
{
  TIPP_REQUIRE_DATA(path, "netcdf/dflow_simplebox_hex7_map.nc");
  const auto series = openMeshSeries(path);
  EXPECT_EQ(13U, series->Times.size());
  EXPECT_EQ("EPSG:28992", series->Crs);
  const SeriesMesh mesh = series->readMesh();
  Doubles area(810, 0);
  Doubles values;
  series->read(findSeriesVariable(*series, "mesh2d_s1"), 7, values);
  ASSERT_EQ(mesh.OriginalCells.size(), values.size());
  Doubles ofFaces(810, 0);
  for (std::size_t t = 0; t < mesh.OriginalCells.size(); ++t)
  {
    const auto at = [&](std::size_t corner, std::size_t axis)
    { return mesh.XY[2 * std::size_t(mesh.Triangles[3 * t + corner]) + axis]; };
    const auto face = std::size_t(mesh.OriginalCells[t]);
    area[face] += 0.5 *
      ((at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) -
        (at(1, 1) - at(0, 1)) * (at(2, 0) - at(0, 0)));
    ofFaces[face] = values[t];
  }
  EXPECT_NEAR(2798400, sumOf(area), 1e-6);
  EXPECT_NEAR(256.5940499979655, sumOf(ofFaces), 1e-9);
  EXPECT_EQ(9.712526977531969e-18, ofFaces.at(809));
}

TEST(RealOutput, OfFesomHasItsValuesInAnotherFile)
{
  TIPP_REQUIRE_DATA(mesh, "netcdf/fesom.mesh.diag.nc");
  TIPP_REQUIRE_DATA(values, "netcdf/fesom.sst.1948.nc");
  const auto series = openMeshSeries(mesh, { { values }, true });
  const SeriesMesh triangles = series->readMesh();
  // 111 triangles cross the meridian, and one of them is around the pole.
  EXPECT_EQ(5839U + 110 - 1, triangles.OriginalCells.size());
  Doubles sst;
  series->read(findSeriesVariable(*series, "sst"), 0, sst);
  ASSERT_EQ(triangles.XY.size() / 2, sst.size());
  EXPECT_NEAR(26774.12938051013, std::accumulate(sst.begin(), sst.begin() + 3140, 0.0), 1e-8);
  EXPECT_EQ(-1.687706317897745, sst.at(3139));
}

} // namespace

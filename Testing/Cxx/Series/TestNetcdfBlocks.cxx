// SPDX-License-Identifier: BSD-3-Clause
#include "NetcdfWriter.h"
#include "Series/MeshSeries.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Doubles = std::vector<double>;

/// A mesh with more cells than are read at once: a square grid of quadrilaterals, each of which is
/// one of the file's or, at odd indices, two triangles.
class NetcdfBlocks : public testing::Test
{
protected:
  static constexpr std::size_t side = 900;
  static constexpr std::size_t squares = (side - 1) * (side - 1);
  static constexpr std::size_t faces = squares + squares / 2;

  void write(const std::string& path, int firstNode, bool isTransposed) const
  {
    NetcdfWriter w(path);
    const int nodes = w.dimension("nodes", side * side);
    const int face = w.dimension("faces", faces);
    const int four = w.dimension("four", 4);
    const int time = w.dimension("time", 2);
    const int topology = w.variable("mesh", NC_INT, {});
    w.text(topology, "cf_role", "mesh_topology");
    w.number(topology, "topology_dimension", NC_INT, { 2 });
    w.text(topology, "node_coordinates", "x y");
    w.text(topology, "face_node_connectivity", "corners");
    w.text(topology, "face_dimension", "faces");
    const int x = w.variable("x", NC_DOUBLE, { nodes });
    const int y = w.variable("y", NC_DOUBLE, { nodes });
    const int corners = w.variable("corners", NC_INT,
      isTransposed ? std::vector<int>{ four, face } : std::vector<int>{ face, four });
    w.number(corners, "_FillValue", NC_INT, { -1 });
    const int level = w.variable("level", NC_DOUBLE, { time, nodes });
    const int rain = w.variable("rain", NC_DOUBLE, { face, time });
    const int times = w.variable("time", NC_DOUBLE, { time });
    Doubles values[2];
    for (std::size_t i = 0; i < side * side; ++i)
    {
      values[0].push_back(double(i % side));
      values[1].push_back(double(i / side));
    }
    w.put(x, values[0]);
    w.put(y, values[1]);
    w.put(times, { 0, 60 });
    w.put(corners, cornersOf(firstNode, isTransposed));
    w.put(level, ascending(2 * side * side));
    w.put(rain, ascending(2 * faces));
  }

  static Doubles ascending(std::size_t count)
  {
    Doubles values(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = double(i);
    }
    return values;
  }

  static Doubles cornersOf(int firstNode, bool isTransposed)
  {
    std::vector<std::vector<double>> cells;
    for (std::size_t i = 0; i < squares; ++i)
    {
      const double a = double(i / (side - 1) * side + i % (side - 1)) + firstNode;
      if (i % 2 == 0)
      {
        cells.push_back({ a, a + 1, a + side + 1, a + side });
        continue;
      }
      cells.push_back({ a, a + 1, a + side, -1 });
      cells.push_back({ a + 1, a + side + 1, a + side, -1 });
    }
    Doubles corners(4 * faces);
    for (std::size_t cell = 0; cell < faces; ++cell)
    {
      for (std::size_t i = 0; i < 4; ++i)
      {
        corners[isTransposed ? i * faces + cell : 4 * cell + i] = cells.at(cell)[i];
      }
    }
    return corners;
  }

  TemporaryFolder Folder;
};

TEST_F(NetcdfBlocks, TogetherAreTheMesh)
{
  for (const auto& [firstNode, isTransposed] :
    std::vector<std::tuple<int, bool>>{ { 0, false }, { 1, true } })
  {
    this->write(this->Folder.path("m.nc"), firstNode, isTransposed);
    const auto series = openMeshSeries(this->Folder.path("m.nc"));
    SeriesMesh joined;
    std::size_t blocks = 0;
    std::size_t largest = 0;
    const SeriesNodes nodes = series->readTriangles(
      [&](const SeriesNodes& known, const SeriesTriangles& triangles)
      {
        EXPECT_EQ(std::int64_t(side * side), known.size());
        ++blocks;
        largest = std::max(largest, triangles.Nodes.size());
        joined.Triangles.insert(
          joined.Triangles.end(), triangles.Nodes.begin(), triangles.Nodes.end());
        for (std::size_t i = 0; i < triangles.Nodes.size() / 3; ++i)
        {
          joined.OriginalCells.push_back(triangles.cell(i));
        }
      });
    const SeriesMesh mesh = series->readMesh();
    EXPECT_EQ(6 * squares, mesh.Triangles.size());
    EXPECT_EQ(mesh.Triangles, joined.Triangles);
    EXPECT_EQ(mesh.OriginalCells, joined.OriginalCells);
    EXPECT_GE(blocks, 2U);
    EXPECT_LT(largest, mesh.Triangles.size());
    for (std::int64_t i = 0; i < nodes.size(); ++i)
    {
      ASSERT_EQ(mesh.XY[2 * std::size_t(i)], nodes[i].x);
      ASSERT_EQ(mesh.XY[2 * std::size_t(i) + 1], nodes[i].y);
    }
  }
}

TEST_F(NetcdfBlocks, HaveTheValuesOfTheirNodesAndCells)
{
  this->write(this->Folder.path("m.nc"), 0, false);
  const auto series = openMeshSeries(this->Folder.path("m.nc"));
  std::vector<std::int32_t> at{ 0, 1, 1, 77, 70000, 70001 };
  for (std::int32_t i = 200000; i < std::int32_t(side * side); i += 3)
  {
    at.push_back(i);
  }
  const std::size_t level = findSeriesVariable(*series, "level");
  const std::size_t rain = findSeriesVariable(*series, "rain");
  for (const std::size_t step : { 0, 1, 0 }) // what is read ahead is not always what is asked for
  {
    Doubles values;
    series->readAt(level, step, at, values);
    ASSERT_EQ(at.size(), values.size());
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      ASSERT_EQ(double(at[i]) + double(step * side * side), values[i]);
    }
    series->readAt(rain, step, at, values);
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      ASSERT_EQ(double(2 * at[i]) + double(step), values[i]);
    }
  }
}

} // namespace

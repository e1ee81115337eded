// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "GridMesh.h"
#include "Npy/NpyFile.h"
#include "Refinement/NodeDepths.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

namespace
{

using namespace tipp;
using tipp::test::GridMesh;

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// The node whose cell has the point: the triangle that contains it, tested in doubles, and its
/// corner with the largest barycentric coordinate; -1 outside. The points of these tests are not on
/// edges.
std::int64_t cellOf(const GridMesh& mesh, double x, double y)
{
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3)
  {
    double twice[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto a = std::size_t(mesh.Triangles[t + (i + 1) % 3]);
      const auto b = std::size_t(mesh.Triangles[t + (i + 2) % 3]);
      twice[i] = (mesh.XY[2 * b] - mesh.XY[2 * a]) * (y - mesh.XY[2 * a + 1]) -
        (mesh.XY[2 * b + 1] - mesh.XY[2 * a + 1]) * (x - mesh.XY[2 * a]);
    }
    const double* const most = std::max_element(twice, twice + 3);
    if (*std::min_element(twice, twice + 3) > 0)
    {
      return mesh.Triangles[t + std::size_t(most - twice)];
    }
  }
  return -1;
}

/// The means of values at points over the nodes' cells; NaN where there is none.
std::vector<double> bruteMeans(
  const GridMesh& mesh, const std::vector<double>& xy, const std::vector<double>& values)
{
  std::vector<double> sums(mesh.nodes(), 0);
  std::vector<int> counts(mesh.nodes(), 0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::int64_t node = cellOf(mesh, xy[2 * i], xy[2 * i + 1]);
    if (node >= 0 && std::isfinite(values[i]))
    {
      sums[std::size_t(node)] += values[i];
      ++counts[std::size_t(node)];
    }
  }
  for (std::size_t node = 0; node < sums.size(); ++node)
  {
    sums[node] = counts[node] > 0 ? sums[node] / counts[node] : missing;
  }
  return sums;
}

std::vector<double> valuesOf(const NodeDepths& depths)
{
  return { depths.Values.begin(), depths.Values.end() };
}

class NodeDepthsTest : public testing::Test
{
protected:
  /// A raster in a file.
  std::unique_ptr<RasterValues> raster(std::int64_t columns, std::int64_t rows, const Box2& bounds,
    const std::vector<double>& values) const
  {
    const std::string path = this->Folder.path("raster.npy");
    NpyWriter writer(path, "<f8", { rows, columns });
    writer.write(values.data(), values.size() * sizeof(double));
    writer.close();
    return openNpyRaster(path, bounds);
  }

  static NodeDepthOptions depths(int threads = 1) { return { VerticalAxis::Depths, threads }; }

  /// Values of a linear function at the centres of pixels.
  static std::vector<double> plane(int columns, int rows, const Box2& bounds)
  {
    std::vector<double> values;
    for (int row = 0; row < rows; ++row)
    {
      for (int column = 0; column < columns; ++column)
      {
        const double x = bounds.Min.x + (column + 0.5) * bounds.width(0) / columns;
        const double y = bounds.Min.y + (row + 0.5) * bounds.width(1) / rows;
        values.push_back(3 + 2 * x - y);
      }
    }
    return values;
  }

  const tipp::test::TemporaryFolder Folder;
  std::mt19937 Random{ 17 };
};

TEST_F(NodeDepthsTest, MeansOfPixelsAreThoseOfBruteForce)
{
  const GridMesh mesh(4, 3);
  // Larger than the mesh, and with pixels whose centres lie on no edge.
  const Box2 bounds{ { -0.737, -0.511 }, { 4.61, 3.717 } };
  std::vector<double> values(53 * 41);
  std::vector<double> centres;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = i % 7 == 0 ? missing : std::uniform_real_distribution<>(-9, 9)(this->Random);
    centres.push_back(bounds.Min.x + (double(i % 53) + 0.5) * bounds.width(0) / 53);
    centres.push_back(bounds.Min.y + (double(i / 53) + 0.5) * bounds.width(1) / 41);
  }
  const auto raster = this->raster(53, 41, bounds, values);
  const NodeDepths found =
    depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule::CellMean, depths());
  const std::vector<double> expected = bruteMeans(mesh, centres, values);
  EXPECT_EQ(20, found.FromCells);
  for (std::size_t node = 0; node < mesh.nodes(); ++node)
  {
    EXPECT_NEAR(expected[node], found.Values[node], 1e-12) << node;
  }
}

TEST_F(NodeDepthsTest, AtNodesALinearRasterIsInterpolatedExactly)
{
  const GridMesh mesh(4, 3);
  const Box2 bounds{ { -2, -2 }, { 8, 6 } };
  const auto raster = this->raster(30, 20, bounds, plane(30, 20, bounds));
  const NodeDepths found =
    depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule::AtNode, depths());
  EXPECT_EQ(0, found.FromCells);
  EXPECT_EQ(20, found.AtNodes);
  for (std::size_t node = 0; node < mesh.nodes(); ++node)
  {
    EXPECT_NEAR(3 + 2 * mesh.XY[2 * node] - mesh.XY[2 * node + 1], found.Values[node], 1e-12);
  }
}

TEST_F(NodeDepthsTest, ElevationsBecomeDepths)
{
  const GridMesh mesh(1, 1);
  const auto raster = this->raster(2, 2, { { -1, -1 }, { 2, 2 } }, { 5, 5, 5, 5 });
  const NodeDepths found = depthsFromRaster(
    mesh.XY, mesh.view(), *raster, NodeRule::AtNode, { VerticalAxis::Elevations, 1 });
  EXPECT_EQ((std::vector<double>{ -5, -5, -5, -5 }), valuesOf(found));
}

TEST_F(NodeDepthsTest, CellsWithoutAPixelAreInterpolatedAndCounted)
{
  const GridMesh mesh(8, 8);
  const Box2 bounds{ { -4.1, -4.1 }, { 12.1, 12.1 } };
  const auto raster = this->raster(6, 6, bounds, plane(6, 6, bounds));
  const NodeDepths found =
    depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule::CellMean, depths());
  EXPECT_EQ(81, found.FromCells + found.AtNodes);
  EXPECT_GT(found.FromCells, 0);
  EXPECT_LE(found.FromCells, 9);
  EXPECT_NEAR(3 + 2 * 8 - 8, found.Values[80], 1e-12); // the node at (8, 8)
}

TEST_F(NodeDepthsTest, NodesOffTheRasterGetTheMeanOfTheirNeighbours)
{
  const GridMesh mesh(3, 1);
  const auto raster = this->raster(2, 2, { { -1, -1 }, { 1.5, 2 } }, { 4, 4, 4, 4 });
  const NodeDepths found =
    depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule::AtNode, depths());
  EXPECT_EQ(4, found.AtNodes);
  EXPECT_EQ(4, found.FromOthers);
  EXPECT_EQ(0, found.Missing);
  EXPECT_EQ(std::vector<double>(8, 4), valuesOf(found));
}

TEST_F(NodeDepthsTest, NodesThatNoDataReachAreMissing)
{
  const GridMesh mesh(3, 1, [](int column, int) { return column != 1; });
  const auto raster = this->raster(2, 2, { { -1, -1 }, { 1.5, 2 } }, { 4, 4, 4, 4 });
  const NodeDepths found =
    depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule::CellMean, depths());
  EXPECT_EQ(4, found.Missing);
  EXPECT_TRUE(std::isnan(found.Values[2]));
  const auto elsewhere = this->raster(2, 2, { { 50, 50 }, { 60, 60 } }, { 4, 4, 4, 4 });
  EXPECT_EQ(
    8, depthsFromRaster(mesh.XY, mesh.view(), *elsewhere, NodeRule::CellMean, depths()).Missing);
}

TEST_F(NodeDepthsTest, PixelsWithoutAValueAreLeftOutOfAnInterpolation)
{
  const GridMesh mesh(1, 1);
  const auto raster =
    this->raster(2, 2, { { -0.5, -0.5 }, { 1.5, 1.5 } }, { 4, missing, 6, missing });
  const NodeDepths found =
    depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule::AtNode, depths());
  EXPECT_EQ(2, found.AtNodes);
  EXPECT_EQ(4, found.Values[0]);
  EXPECT_EQ(6, found.Values[2]);
  EXPECT_EQ(2, found.FromOthers);
}

TEST_F(NodeDepthsTest, ARasterOfManyStripsGivesTheSameAsBruteForce)
{
  const GridMesh mesh(2, 2);
  const Box2 bounds{ { -0.013, -0.017 }, { 2.011, 2.019 } };
  constexpr int side = 1100; // a strip has 2^18 pixels
  const auto raster = this->raster(side, side, bounds, plane(side, side, bounds));
  const NodeDepths one =
    depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule::CellMean, depths(1));
  const NodeDepths several =
    depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule::CellMean, depths(3));
  EXPECT_EQ(valuesOf(one), valuesOf(several));
  // The middle node's cell is symmetric about it.
  EXPECT_NEAR(3 + 2 * 1 - 1, one.Values[4], 1e-3);
}

TEST_F(NodeDepthsTest, MeansOfPointsAreThoseOfBruteForceForAnyThreads)
{
  const GridMesh mesh(5, 4);
  PointTable points;
  points.Columns = { { "other", {} }, { "z", {} } };
  for (int i = 0; i < 3000; ++i)
  {
    points.XY.push_back(std::uniform_real_distribution<>(-1, 5)(this->Random));
    points.XY.push_back(std::uniform_real_distribution<>(-1, 5)(this->Random));
    points.Columns[0].Values.push_back(1);
    points.Columns[1].Values.push_back(
      i % 11 == 0 ? missing : std::uniform_real_distribution<>(-30, 2)(this->Random));
  }
  const std::vector<double> expected = bruteMeans(mesh, points.XY, points.Columns[1].Values);
  const auto found = [&](int threads)
  { return depthsFromPoints(mesh.XY, mesh.view(), *streamTable(points), "z", depths(threads)); };
  const NodeDepths one = found(1);
  EXPECT_EQ(30, one.FromCells);
  for (std::size_t node = 0; node < mesh.nodes(); ++node)
  {
    EXPECT_NEAR(expected[node], one.Values[node], 1e-12) << node;
  }
  EXPECT_EQ(valuesOf(one), valuesOf(found(2)));
  EXPECT_EQ(valuesOf(one), valuesOf(found(5)));
}

TEST_F(NodeDepthsTest, DepthsDoNotDependOnStrips)
{
  const GridMesh mesh(9, 7);
  const Box2 bounds{ { -0.7, -0.5 }, { 9.6, 5.2 } }; // the upper rows have no pixels
  std::vector<double> values;
  PointTable points;
  points.Columns = { { "z", {} } };
  for (int i = 0; i < 71 * 64; ++i)
  {
    values.push_back(std::uniform_real_distribution<>(-9, 9)(this->Random));
    // Some lie on edges and nodes.
    const double x = std::uniform_real_distribution<>(-1, 10)(this->Random);
    points.XY.push_back(i % 3 == 0 ? std::round(x) : x);
    const double y = std::uniform_real_distribution<>(-1, 6)(this->Random);
    points.XY.push_back(i % 5 == 0 ? std::round(y) : y);
    points.Columns[0].Values.push_back(values.back());
  }
  const auto raster = this->raster(71, 64, bounds, values);
  const auto found = [&](int which, std::size_t strips)
  {
    NodeDepthOptions options = depths();
    options.Strips = strips;
    return which < 2 ? depthsFromRaster(mesh.XY, mesh.view(), *raster, NodeRule(which), options)
                     : depthsFromPoints(mesh.XY, mesh.view(), *streamTable(points), "z", options);
  };
  for (const int which : { 0, 1, 2 })
  {
    const NodeDepths whole = found(which, 1);
    EXPECT_GT(whole.FromOthers, 0);
    for (const std::size_t strips : { 2, 3, 8, 100 })
    {
      const NodeDepths parts = found(which, strips);
      EXPECT_EQ(valuesOf(whole), valuesOf(parts)) << which << " " << strips;
      EXPECT_EQ(whole.FromCells, parts.FromCells);
      EXPECT_EQ(whole.AtNodes, parts.AtNodes);
      EXPECT_EQ(whole.FromOthers, parts.FromOthers);
    }
  }
}

TEST_F(NodeDepthsTest, NodesWithoutPointsAreFilledAndCounted)
{
  const GridMesh mesh(4, 1);
  PointTable points;
  points.XY = { 0.1, 0.2, 0.2, 0.1 };
  points.Columns = { { "z", { -3, -5 } } };
  const NodeDepths found = depthsFromPoints(
    mesh.XY, mesh.view(), *streamTable(points), "z", { VerticalAxis::Elevations, 1 });
  EXPECT_EQ(1, found.FromCells);
  EXPECT_EQ(9, found.FromOthers);
  EXPECT_EQ(std::vector<double>(10, 4), valuesOf(found));
}

TEST_F(NodeDepthsTest, AMissingColumnIsReported)
{
  const GridMesh mesh(1, 1);
  PointTable points;
  points.XY = { 0, 0 };
  points.Columns = { { "heat", { 1 } } };
  tipp::test::expectIOError("The points have no column 'z'", "there are 'heat'",
    [&] { depthsFromPoints(mesh.XY, mesh.view(), *streamTable(points), "z", depths()); });
}

} // namespace

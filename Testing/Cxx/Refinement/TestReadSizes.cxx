// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PendingOutput.h"
#include "Raster/RasterFile.h"
#include "Raster/RasterValues.h"
#include "Refinement/PlaneValues.h"
#include "Refinement/ReadSizes.h"
#include "Refinement/SizeLattice.h"
#include "Refinement/SizeRules.h"

#include "ExpectIOError.h"
#include "NpyText.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Box2 basin{ { 0, 0 }, { 8, 6 } };

double plane(double x, double y)
{
  return 5 + 0.25 * x - 0.5 * y;
}

class ReadSizes : public testing::Test
{
protected:
  /// A text file of points with a size, random ones within the box and its corners.
  std::string points(const Box2& box) const
  {
    std::ostringstream text;
    text.precision(17);
    text << "x,y,size\n";
    const auto add = [&](double x, double y)
    { text << x << ',' << y << ',' << plane(x, y) << '\n'; };
    add(box.Min.x, box.Min.y);
    add(box.Max.x, box.Min.y);
    add(box.Max.x, box.Max.y);
    add(box.Min.x, box.Max.y);
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i)
    {
      const double x = std::uniform_real_distribution<double>(box.Min.x, box.Max.x)(random);
      add(x, std::uniform_real_distribution<double>(box.Min.y, box.Max.y)(random));
    }
    return this->Folder.file("points.csv", text.str());
  }

  /// An .npy raster of rows from the south.
  std::string raster(const std::vector<double>& values, int columns) const
  {
    const std::size_t rows = values.size() / std::size_t(columns);
    return this->Folder.file("a.npy",
      npyBytes(npyHeader("<f8", "(" + std::to_string(rows) + ", " + std::to_string(columns) + ")"),
        bytesOf(values)));
  }

  /// A GeoTIFF of 4 x 3 pixels over the basin; NaN for no data.
  std::string geoTiff(const std::vector<double>& values) const
  {
    RasterDescription description;
    description.Grid.Pixel = { 2, 2 };
    description.Grid.Columns = 4;
    description.Grid.Rows = 3;
    description.Bands = { "size" };
    description.Compression = "none";
    const std::string path = this->Folder.path("a.tif");
    const auto writer = createRaster(path, description, PendingFile(path).before());
    writer->write({ 0, 0, 4, 3 }, { values.data() });
    writer->close();
    return path;
  }

  SizeFunction sizesOf(const SizeArguments& arguments, int threads = 2) const
  {
    return makeSizeFunction(arguments, {}, basin, threads, {});
  }

  static SizeArguments ofFile(const std::string& path)
  {
    SizeArguments arguments;
    arguments.Size = path;
    arguments.Least = 0.5;
    return arguments;
  }

  SizeArguments ofRaster(const std::vector<double>& values, int columns) const
  {
    SizeArguments arguments = ofFile(this->raster(values, columns));
    arguments.RasterBounds = basin;
    return arguments;
  }

  static void expectRefused(const SizeArguments& arguments, const std::string& words,
    const std::vector<std::array<Point2, 2>>& shoreline = {})
  {
    try
    {
      makeSizeFunction(arguments, shoreline, basin, 1, {});
      ADD_FAILURE() << "nothing is wrong: " << words;
    }
    catch (const std::invalid_argument& error)
    {
      const std::string text = error.what();
      EXPECT_NE(std::string::npos, text.find(words)) << text;
      EXPECT_EQ('.', text.back()) << text;
    }
  }

  TemporaryFolder Folder;
};

/// Skips a test in a build without GDAL, or where it is not installed.
#define SKIP_WITHOUT_GDAL(path)                                                                    \
  try                                                                                              \
  {                                                                                                \
    openRasterValues(path);                                                                        \
  }                                                                                                \
  catch (const IOError& error)                                                                     \
  {                                                                                                \
    const std::string text = error.what();                                                         \
    if (text.find("without GDAL") != std::string::npos ||                                          \
      text.find("cannot be opened; install it") != std::string::npos)                              \
    {                                                                                              \
      GTEST_SKIP() << text;                                                                        \
    }                                                                                              \
  }

const std::vector<double> twelve{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 };

TEST_F(ReadSizes, PointsAreInterpolatedLinearly)
{
  const SizeFunction sizes = this->sizesOf(ofFile(this->points(basin)));
  for (const Point2 p : { Point2{ 1, 1 }, Point2{ 4.3, 2.7 }, Point2{ 8, 6 }, Point2{ 0, 6 } })
  {
    EXPECT_NEAR(plane(p.x, p.y), sizes.at(p), 1e-9);
  }
}

TEST_F(ReadSizes, OutsideOfPointsTheNearestPlaceCounts)
{
  const Box2 inner{ { 2, 1 }, { 5, 4 } };
  const SizeFunction sizes = this->sizesOf(ofFile(this->points(inner)));
  EXPECT_NEAR(plane(2, 2.5), sizes.at({ 0, 2.5 }), 1e-9);
  EXPECT_NEAR(plane(5, 4), sizes.at({ 8, 6 }), 1e-9);
}

TEST_F(ReadSizes, FewPointsCountWhereTheyAreNearest)
{
  const SizeFunction sizes =
    this->sizesOf(ofFile(this->Folder.file("a.csv", "x,y,size\n1,3,2\n7,3,4\n")));
  EXPECT_NEAR(2, sizes.at({ 0, 6 }), 1e-12);
  EXPECT_NEAR(4, sizes.at({ 8, 0 }), 1e-12);
}

TEST_F(ReadSizes, NodesOfAGridAreInterpolatedInItsTriangles)
{
  // An L without the upper right quarter; the depth of a node is its size.
  const std::string path = this->Folder.file("fort.14",
    "L\n4 6\n1 0 0 1\n2 8 0 1\n3 8 3 1\n4 4 3 1\n5 4 6 5\n6 0 6 5\n"
    "1 3 1 2 4\n2 3 2 3 4\n3 3 1 4 6\n4 3 4 5 6\n0\n0\n0\n0\n");
  SizeArguments arguments = ofFile(path);
  EXPECT_THROW(this->sizesOf(arguments), IOError) << "depths are no sizes unless it is said";
  arguments.Column = "depth";
  const SizeFunction sizes = this->sizesOf(arguments);
  EXPECT_NEAR(1, sizes.at({ 6, 1.5 }), 1e-9);
  EXPECT_NEAR(3, sizes.at({ 4, 4.5 }), 1e-9);
  EXPECT_NEAR(1, sizes.at({ 7, 3.5 }), 1e-9); // from the L's side, not from its convex hull
}

TEST_F(ReadSizes, RastersAreBilinearBetweenCentres)
{
  const SizeFunction sizes = this->sizesOf(this->ofRaster(twelve, 4));
  EXPECT_NEAR(1, sizes.at({ 1, 1 }), 1e-9);
  EXPECT_NEAR(12, sizes.at({ 7, 5 }), 1e-9);
  EXPECT_NEAR(1.5, sizes.at({ 2, 1 }), 1e-9);
  EXPECT_NEAR(3.5, sizes.at({ 2, 2 }), 1e-9);
}

TEST_F(ReadSizes, BeyondARasterTheNearestPlaceCounts)
{
  SizeArguments arguments = this->ofRaster(twelve, 4);
  arguments.RasterBounds = Box2{ { 2, 2 }, { 6, 5 } };
  const SizeFunction sizes = this->sizesOf(arguments);
  EXPECT_NEAR(1, sizes.at({ 0, 0 }), 1e-9);
  EXPECT_NEAR(12, sizes.at({ 8, 6 }), 1e-9);
  EXPECT_NEAR(1.5, sizes.at({ 3, 0 }), 1e-9);
}

TEST_F(ReadSizes, PixelsWithoutAValueAreLeftOut)
{
  std::vector<double> values = twelve;
  values[5] = nan;
  const SizeFunction sizes = this->sizesOf(this->ofRaster(values, 4));
  EXPECT_NEAR((1 + 2 + 5) / 3.0, sizes.at({ 2, 2 }), 1e-9);
  EXPECT_NEAR(1, sizes.at({ 1, 1 }), 1e-9);
}

TEST_F(ReadSizes, GapsOfARasterTakeTheNearestNode)
{
  std::vector<double> values(12, nan);
  values[0] = 2;
  values[3] = 3;
  const SizeFunction sizes = this->sizesOf(this->ofRaster(values, 4));
  EXPECT_NEAR(2, sizes.at({ 0, 6 }), 1e-9);
  EXPECT_NEAR(3, sizes.at({ 8, 6 }), 1e-9);
}

TEST_F(ReadSizes, GeoTiffsAreReadWithGdal)
{
  std::vector<double> values = twelve;
  values[11] = nan;
  const std::string path = this->geoTiff(values);
  SKIP_WITHOUT_GDAL(path);
  const SizeFunction sizes = this->sizesOf(ofFile(path));
  EXPECT_NEAR(1, sizes.at({ 1, 1 }), 1e-9);
  EXPECT_NEAR(9, sizes.at({ 1, 5 }), 1e-9);
  EXPECT_NEAR(3.5, sizes.at({ 2, 2 }), 1e-9);
  EXPECT_NEAR((7 + 8 + 11) / 3.0, sizes.at({ 6, 4 }), 1e-9);
}

TEST_F(ReadSizes, WindowsOfRastersCountRowsFromTheSouth)
{
  const std::string path = this->geoTiff(twelve);
  SKIP_WITHOUT_GDAL(path);
  const auto tiff = openRasterValues(path);
  const auto npy = openNpyRaster(this->raster(twelve, 4), basin);
  for (RasterValues* const raster : { tiff.get(), npy.get() })
  {
    EXPECT_EQ(4, raster->grid().Columns);
    EXPECT_EQ(6, raster->grid().north());
    std::vector<double> window(4);
    raster->read({ 1, 1, 2, 2 }, window.data());
    EXPECT_EQ((std::vector<double>{ 6, 7, 10, 11 }), window);
  }
}

TEST_F(ReadSizes, WithoutALeastSizeNodesFollowThatOfTheFile)
{
  SizeArguments arguments = this->ofRaster(twelve, 4);
  arguments.Least.reset();
  EXPECT_NEAR(0.5, this->sizesOf(arguments).spacing(), 1e-9);
}

TEST_F(ReadSizes, DepthsMayBeElevations)
{
  std::vector<double> elevations(12, -40);
  SizeArguments arguments;
  arguments.Depth = this->raster(elevations, 4);
  arguments.RasterBounds = basin;
  arguments.WaveLength = 200;
  EXPECT_NEAR(sizeByWavelength(1, 200), this->sizesOf(arguments).at({ 3, 3 }), 1e-9);
  arguments.DepthIsElevation = true;
  EXPECT_NEAR(sizeByWavelength(40, 200), this->sizesOf(arguments).at({ 3, 3 }), 1e-9);
}

TEST_F(ReadSizes, DepthsOfATableArePositiveDown)
{
  SizeArguments arguments;
  arguments.Depth = this->Folder.file("a.csv", "x,y,depth\n0,0,40\n8,0,40\n4,6,40\n");
  arguments.WaveLength = 200;
  EXPECT_NEAR(sizeByWavelength(40, 200), this->sizesOf(arguments).at({ 3, 3 }), 1e-9);
}

TEST_F(ReadSizes, SlopesAreLimitedByTheLeastAndLargestSize)
{
  SizeArguments arguments;
  arguments.Depth = this->Folder.file("a.csv", "x,y,depth\n0,0,10\n8,0,10\n8,6,70\n0,6,70\n");
  arguments.Slope = 20;
  arguments.Least = 0.4;
  arguments.Largest = 1.5;
  const SizeFunction sizes = this->sizesOf(arguments);
  const double pi = 3.14159265358979323846;
  for (const double y : { 0.0, 1.0, 3.0, 6.0 })
  {
    const double exact = 2 * pi * (10 + 10 * y) / (20 * 10);
    EXPECT_NEAR(std::clamp(exact, 0.4, 1.5), sizes.at({ 4, y }), 1e-6);
  }
}

TEST_F(ReadSizes, ColumnsAreChosenByName)
{
  SizeArguments arguments =
    ofFile(this->Folder.file("a.csv", "x,y,a,b\n0,0,1,2\n8,0,1,2\n4,6,1,2\n"));
  arguments.Column = "b";
  EXPECT_NEAR(2, this->sizesOf(arguments).at({ 3, 3 }), 1e-12);
  arguments.Column = "c";
  expectIOError(arguments.Size, "no column 'c'", [&] { this->sizesOf(arguments); });
  arguments.Column.clear();
  expectIOError(arguments.Size, "'a', 'b'", [&] { this->sizesOf(arguments); });
}

TEST_F(ReadSizes, AnOnlyColumnOfAnotherNameMustBeNamed)
{
  SizeArguments arguments = ofFile(this->Folder.file("a.txt", "0 0 2\n8 0 2\n4 6 2\n"));
  expectIOError(
    arguments.Size, "has no column 'size'; name one of 'z'", [&] { this->sizesOf(arguments); });
  arguments.Column = "z";
  EXPECT_NEAR(2, this->sizesOf(arguments).at({ 3, 3 }), 1e-12);
}

TEST_F(ReadSizes, ResultsAreTheSameForAnyThreads)
{
  SizeArguments arguments = ofFile(this->points({ { 1, 1 }, { 5, 4 } }));
  arguments.Least = 0.1;
  arguments.Gradation = 0.1;
  const SizeFunction one = this->sizesOf(arguments, 1);
  const SizeFunction four = this->sizesOf(arguments, 4);
  for (double x = 0; x <= 8; x += 0.07)
  {
    for (double y = 0; y <= 6; y += 0.07)
    {
      ASSERT_EQ(one.at({ x, y }), four.at({ x, y }));
    }
  }
}

TEST_F(ReadSizes, SizesThatAreNotAboveZeroAreRefused)
{
  for (const char* const size : { "-3", "0" })
  {
    const SizeArguments arguments =
      ofFile(this->Folder.file("a.csv", std::string("x,y,size\n0,0,1\n8,0,1\n4,6,") + size + "\n"));
    expectIOError(
      arguments.Size, std::string("has the size ") + size, [&] { this->sizesOf(arguments); });
  }
  std::vector<double> values = twelve;
  values[7] = -2;
  const SizeArguments raster = this->ofRaster(values, 4);
  expectIOError(raster.Size, "has the size -2", [&] { this->sizesOf(raster); });
}

TEST_F(ReadSizes, PointsWithoutAValueAreRefused)
{
  const SizeArguments arguments =
    ofFile(this->Folder.file("a.csv", "x,y,size\n0,0,1\n8,0,nan\n4,6,1\n"));
  expectIOError(arguments.Size, "at point 1", [&] { this->sizesOf(arguments); });
}

TEST_F(ReadSizes, FilesOutsideOfTheDomainAreRefused)
{
  const SizeArguments points = ofFile(this->points({ { 20, 30 }, { 21, 32 } }));
  expectIOError(points.Size,
    "x from 20 to 21 and y from 30 to 32, but the domain at x from 0 to 8 and y from 0 to 6",
    [&] { this->sizesOf(points); });
  SizeArguments raster = this->ofRaster(twelve, 4);
  raster.RasterBounds = Box2{ { 9, 0 }, { 13, 3 } };
  expectIOError(raster.Size, "x from 9 to 13", [&] { this->sizesOf(raster); });
}

TEST_F(ReadSizes, RastersWithoutAnyValueAreRefused)
{
  const SizeArguments arguments = this->ofRaster(std::vector<double>(12, nan), 4);
  expectIOError(arguments.Size, "no value in the domain", [&] { this->sizesOf(arguments); });
}

TEST_F(ReadSizes, RastersOfSeveralBandsAreRefused)
{
  const std::string one = this->geoTiff(twelve);
  SKIP_WITHOUT_GDAL(one);
  RasterDescription description;
  description.Grid.Columns = 4;
  description.Grid.Rows = 3;
  description.Bands = { "a", "b" };
  description.Compression = "none";
  const std::string path = this->Folder.path("b.tif");
  const auto writer = createRaster(path, description, PendingFile(path).before());
  writer->write({ 0, 0, 4, 3 }, { twelve.data(), twelve.data() });
  writer->close();
  expectIOError(path, "has 2 bands", [&] { this->sizesOf(ofFile(path)); });
}

TEST_F(ReadSizes, CutRastersAreRefused)
{
  const std::string path = this->geoTiff(twelve);
  SKIP_WITHOUT_GDAL(path);
  const std::string content = contentOf(path);
  this->Folder.file("a.tif", content.substr(0, content.size() - 1000));
  EXPECT_THROW(this->sizesOf(ofFile(path)), IOError);
}

TEST_F(ReadSizes, RasterBoundsMustBeABox)
{
  SizeArguments arguments = this->ofRaster(twelve, 4);
  for (const Box2& bounds :
    { Box2{ { 3, 0 }, { 2, 1 } }, Box2{ { 0, 0 }, { 0, 1 } }, Box2{ { 0, 0 }, { nan, 1 } } })
  {
    arguments.RasterBounds = bounds;
    expectIOError(arguments.Size, "no box", [&] { this->sizesOf(arguments); });
  }
}

TEST_F(ReadSizes, SomethingMustBeGiven)
{
  expectRefused({}, "No size is given");
  SizeArguments arguments;
  arguments.Least = 1;
  arguments.Largest = 2;
  expectRefused(arguments, "No size is given");
}

TEST_F(ReadSizes, NumbersMustBeAboveZero)
{
  for (const double value : { 0.0, -1.0, nan, std::numeric_limits<double>::infinity() })
  {
    for (const auto member :
      { &SizeArguments::Dis, &SizeArguments::WaveLength, &SizeArguments::Slope,
        &SizeArguments::Least, &SizeArguments::Largest, &SizeArguments::Gradation })
    {
      SizeArguments arguments;
      arguments.Size = "1";
      arguments.*member = value;
      expectRefused(arguments, "give a number above 0");
    }
  }
  for (const char* const size : { "0", "-2", "nan", "inf" })
  {
    SizeArguments arguments;
    arguments.Size = size;
    expectRefused(arguments, "The size is ");
  }
}

TEST_F(ReadSizes, LeastMustNotBeAboveLargest)
{
  SizeArguments arguments;
  arguments.Size = "1";
  arguments.Least = 3;
  arguments.Largest = 2;
  expectRefused(arguments, "The least size, 3, is above the largest, 2");
}

TEST_F(ReadSizes, NodesMustBeASensibleNumber)
{
  for (const std::int64_t most : { std::int64_t(-1), std::int64_t(15), std::int64_t(1) << 31 })
  {
    SizeArguments arguments;
    arguments.Size = "1";
    arguments.MostNodes = most;
    expectRefused(arguments, "from 16 to 2147483647");
  }
}

TEST_F(ReadSizes, RulesNeedWhatTheyMeasure)
{
  SizeArguments arguments;
  arguments.Dis = 0.1;
  expectRefused(arguments, "needs the size there");
  arguments.Least = 1;
  expectRefused(arguments, "needs lines");
  arguments = {};
  arguments.WaveLength = 30;
  expectRefused(arguments, "need depths");
  arguments = {};
  arguments.Slope = 30;
  arguments.Depth = "depth.csv";
  expectRefused(arguments, "least and the largest");
}

TEST_F(ReadSizes, ArgumentsWithoutEffectAreRefused)
{
  SizeArguments arguments;
  arguments.Size = "1";
  arguments.Column = "size";
  expectRefused(arguments, "'size'");
  arguments.Column.clear();
  arguments.Depth = "depth.csv";
  expectRefused(arguments, "no effect");
  arguments.Depth.clear();
  arguments.DepthIsElevation = true;
  expectRefused(arguments, "No file with depths");
}

TEST_F(ReadSizes, DomainsMustFit)
{
  SizeArguments arguments;
  arguments.Size = "1000";
  arguments.Geographic = true;
  EXPECT_THROW(
    makeSizeFunction(arguments, {}, { { 0, 0 }, { 100, 1000 } }, 1, {}), std::invalid_argument);
  EXPECT_THROW(makeSizeFunction(arguments, {}, Box2::empty(), 1, {}), std::invalid_argument);
  arguments = ofFile(this->points(basin));
  EXPECT_THROW(makeSizeFunction(arguments, {}, Box2::empty(), 1, {}), std::invalid_argument);
}

TEST_F(ReadSizes, MissingFilesAreReported)
{
  const std::string path = this->Folder.path("none.csv");
  expectIOError(path, "", [&] { this->sizesOf(ofFile(path)); });
}

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"
#include "ExpectIOError.h"
#include "Files/IOError.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace
{

using tipp::ConstraintTable;
using Edges = std::vector<std::array<std::int64_t, 2>>;
using Numbers = std::vector<double>;

class ConstraintFile : public testing::Test
{
protected:
  ConstraintTable read(const std::string& name, const std::string& content) const
  {
    return tipp::readConstraintFile(this->Folder.file(name, content));
  }

  void expectError(
    const std::string& name, const std::string& content, const std::string& words) const
  {
    const std::string path = this->Folder.file(name, content);
    tipp::test::expectIOError(path, words, [&]() { tipp::readConstraintFile(path); });
  }

  const tipp::test::TemporaryFolder Folder;
};

TEST_F(ConstraintFile, CsvOfCoordinatesAndHeights)
{
  const ConstraintTable table =
    this->read("a.csv", "x1,y1,z1,x2,y2,z2\n0,1,-5,2,3,-6\n4,5,-7,6,7,-8\n");
  EXPECT_EQ((Numbers{ 0, 1, 2, 3, 4, 5, 6, 7 }), table.XY);
  EXPECT_EQ((Numbers{ -5, -6, -7, -8 }), table.Height);
  EXPECT_EQ((Edges{ { 0, 1 }, { 2, 3 } }), table.Edges);
}

TEST_F(ConstraintFile, CsvOfCoordinates)
{
  const ConstraintTable table = this->read("a.csv", "x1,y1,x2,y2\n0,1,2,3\n4,5,6,7\n");
  EXPECT_EQ((Numbers{ 0, 1, 2, 3, 4, 5, 6, 7 }), table.XY);
  EXPECT_EQ((Edges{ { 0, 1 }, { 2, 3 } }), table.Edges);
  EXPECT_EQ(2u, table.PolygonBegin);
}

TEST_F(ConstraintFile, CsvOfIds)
{
  const ConstraintTable table = this->read("a.csv", "0,7\n7,2\n");
  EXPECT_TRUE(table.XY.empty());
  EXPECT_EQ((Edges{ { 0, 7 }, { 7, 2 } }), table.Edges);
}

TEST_F(ConstraintFile, CsvThatIsNeitherIsAnError)
{
  this->expectError("a.csv", "1,2,3\n4,5,6\n", "has 3 columns");
  this->expectError("a.csv", "1,2.5\n", "is no whole number");
  this->expectError("a.csv", "-1,2\n", "is no whole number");
}

TEST_F(ConstraintFile, PolyWithVertices)
{
  const ConstraintTable table = this->read("a.poly",
    "# a triangle with a hole\n3 2 0 1\n1 0 0 9\n2 4 0 9\n\n3 0 4 9 # the last\n2 1\n1 1 2 9\n2 3 "
    "1 9\n"
    "1\n1 0.5 0.25\n");
  EXPECT_EQ((Numbers{ 0, 0, 4, 0, 0, 4 }), table.XY);
  EXPECT_EQ((Edges{ { 0, 1 }, { 2, 0 } }), table.Edges);
  EXPECT_EQ((Numbers{ 0.5, 0.25 }), table.Holes);
}

TEST_F(ConstraintFile, PolyWithVerticesInANodeFile)
{
  this->Folder.file("a.node", "3 2 0 0\n0 0 0\n1 4 0\n2 0 4\n");
  const ConstraintTable table = this->read("a.poly", "0 2 0 0\n1 0\n0 2 1\n0\n");
  EXPECT_EQ((Numbers{ 0, 0, 4, 0, 0, 4 }), table.XY);
  EXPECT_EQ((Edges{ { 2, 1 } }), table.Edges);
}

TEST_F(ConstraintFile, DamagedPolyIsAnError)
{
  const std::string vertices = "2 2 0 0\n1 0 0\n2 4 0\n";
  this->expectError("a.poly", "", "ends before the number of vertices");
  this->expectError("a.poly", "2 2 0 0\n1 0 0\n", "ends before a vertex");
  this->expectError("a.poly", "2 2 0 0\n1 0 0\n3 4 0\n", "numbers a vertex otherwise");
  this->expectError("a.poly", vertices + "1 0\n1 1 3\n0\n", "names a vertex that is not given");
  this->expectError("a.poly", vertices + "1 0\n1 1 x\n0\n", "'x' is not a number");
  this->expectError("a.poly", vertices + "1 0\n1 1.5 2\n0\n", "'1.5' is not an integer");
  this->expectError("a.poly", vertices + "99999999 0\n", "announces 99999999 lines");
  this->expectError("a.poly", vertices + "0 0\n1\n1 5\n", "has too few numbers for a hole");
}

TEST_F(ConstraintFile, BoundariesOfAnAdcircGrid)
{
  const std::string grid = "title\n1 4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n1 3 1 2 3\n";
  const ConstraintTable table = this->read("fort.14",
    grid +
      "1 = open\n2 = nodes\n2 0\n1\n2\n3 = land\n7\n2 0\n2\n3\n3 21\n1\n2\n4\n1 24\n3 4 0.5 1 1\n");
  EXPECT_EQ(8u, table.XY.size());
  EXPECT_EQ((Edges{ { 0, 1 }, { 1, 2 }, { 0, 1 }, { 1, 3 }, { 3, 0 } }), table.Edges);
  this->expectError("fort.14", grid, "ends before the number of boundaries");
  this->expectError("fort.14", grid + "0\n0\n0\n0\n", "has no boundaries");
  this->expectError("fort.14", grid + "1\n2\n2\n1\n9\n", "names node 9, which is not given");
}

TEST_F(ConstraintFile, BoundariesOfEveryKindOfAdcirc)
{
  const std::string grid = "title\n0 6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n";
  const auto edgesOf = [&](int kind, const std::string& rows)
  {
    return this->read(
                 "fort.14", grid + "0\n0\n1\n3\n3 " + std::to_string(kind) + " = kind\n" + rows)
      .Edges;
  };
  const Edges chain{ { 0, 1 }, { 1, 2 } };
  for (const int kind : { 0, 2, 10, 12, 20, 22, 30, 32, 40, 41, 52, 102, 112, 122, 152 })
  {
    EXPECT_EQ(chain, edgesOf(kind, "1\n2 ! second\n3\n")) << kind;
  }
  for (const int kind : { 1, 11, 21 })
  {
    EXPECT_EQ((Edges{ { 0, 1 }, { 1, 2 }, { 2, 0 } }), edgesOf(kind, "1\n2\n3\n")) << kind;
  }
  for (const int kind : { 3, 13, 23 })
  {
    EXPECT_EQ(chain, edgesOf(kind, "1 1.5 1.0\n2 1.5 1.0\n3 1.5 1.0\n")) << kind;
  }
  const Edges sides{ { 0, 1 }, { 1, 2 }, { 3, 4 }, { 4, 5 } };
  Edges closed = sides;
  closed.insert(closed.end(), { { 0, 3 }, { 2, 5 } });
  for (const int kind : { 4, 5, 24, 25, 64 })
  {
    const std::string more = kind % 10 == 5 ? " 1.5 1 1 0.2 0.1 1\n" : " 1.5 1.0 1.0\n";
    EXPECT_EQ(closed, edgesOf(kind, "1 4" + more + "2 5" + more + "3 6" + more)) << kind;
  }
  EXPECT_EQ(sides, edgesOf(94, "1 4\n2 5\n3 6\n")); // the periodic sides of a domain
  this->expectError(
    "fort.14", grid + "0\n0\n1\n3\n3 77\n1\n2\n3\n", "kind 77, which is no IBTYPE of ADCIRC");
  this->expectError("fort.14", grid + "0\n0\n-1\n3\n", "announces -1 boundaries");
}

TEST_F(ConstraintFile, BoundariesOfARealGridAreChains)
{
  TIPP_REQUIRE_DATA(path, "adcirc/internal_overflow/internal_overflow.grd");
  const ConstraintTable table = tipp::readConstraintFile(path);
  EXPECT_GT(table.Edges.size(), 300u);
}

TEST_F(ConstraintFile, LinesAndPolygonsOfAVtkFile)
{
  const ConstraintTable table = this->read("a.vtk",
    "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 5\n1 0 6\n1 1 "
    "7\n0 1 8\n"
    "LINES 1 4\n3 0 1 2\nPOLYGONS 1 4\n3 0 2 3\n");
  EXPECT_EQ((Edges{ { 0, 1 }, { 1, 2 }, { 0, 2 }, { 2, 3 }, { 3, 0 } }), table.Edges);
  EXPECT_EQ(2u, table.PolygonBegin);
  EXPECT_EQ((Numbers{ 5, 6, 7, 8 }), table.Height);
}

TEST_F(ConstraintFile, UnknownExtensionIsAnError)
{
  this->expectError("a.xyz", "", "has no extension that tells a kind of constraints");
}

/// Tests of files that GDAL reads. They are skipped if GDAL is missing.
class ConstraintVectorFile : public ConstraintFile
{
protected:
  void SetUp() override
  {
    try
    {
      this->read("line.geojson",
        R"({"type": "Feature", "properties": {}, "geometry":
        {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}})");
    }
    catch (const tipp::IOError& error)
    {
      const std::string text = error.what();
      // GDAL is missing only if the message says so. All other errors are failures.
      ASSERT_TRUE(text.find("needs GDAL") != std::string::npos ||
        text.find("need the library GDAL") != std::string::npos)
        << text;
      GTEST_SKIP() << text;
    }
  }
};

TEST_F(ConstraintVectorFile, GeoJsonWithoutLinesIsAnError)
{
  this->expectError("points.geojson",
    R"({"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [0, 0]}})",
    "holds no lines or polygons");
  this->expectError(
    "none.geojson", R"({"type": "FeatureCollection", "features": []})", "holds no lines");
}

TEST_F(ConstraintVectorFile, GeoJsonLinesAndHeights)
{
  const ConstraintTable table = this->read("a.geojson",
    R"({"type": "FeatureCollection", "features": [
      {"type": "Feature", "properties": {}, "geometry":
        {"type": "LineString", "coordinates": [[0, 1, 5], [2, 3, 6], [4, 5, 7]]}},
      {"type": "Feature", "properties": {}, "geometry":
        {"type": "MultiLineString", "coordinates": [[[6, 7], [8, 9]]]}},
      {"type": "Feature", "properties": {}, "geometry": null}]})");
  EXPECT_EQ((Numbers{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 }), table.XY);
  EXPECT_EQ((Edges{ { 0, 1 }, { 1, 2 }, { 3, 4 } }), table.Edges);
  EXPECT_EQ(3u, table.PolygonBegin);
  ASSERT_EQ(5u, table.Height.size());
  EXPECT_EQ(6, table.Height[1]);
}

/// Rings are reversed if necessary: here both rings are clockwise. Outer rings become
/// counter-clockwise, holes clockwise.
TEST_F(ConstraintVectorFile, GeoJsonPolygonsWithHoles)
{
  const ConstraintTable table = this->read("a.geojson",
    R"({"type": "Polygon", "coordinates": [
      [[0, 0], [0, 9], [9, 0], [0, 0]], [[1, 1], [1, 2], [2, 1], [1, 1]]]})");
  EXPECT_EQ(0u, table.PolygonBegin);
  EXPECT_EQ((Edges{ { 1, 0 }, { 2, 1 }, { 3, 2 }, { 4, 5 }, { 5, 6 }, { 6, 7 } }), table.Edges);
  EXPECT_TRUE(table.Height.empty());
}

/// Makes the .shp and .shx files of one shape, by ESRI's specification of 1998.
class Shapefile
{
public:
  using Points = std::vector<std::array<double, 2>>;

  Shapefile(std::int32_t kind, const std::vector<Points>& parts)
  {
    std::string shape;
    std::string starts;
    std::string points;
    std::int32_t count = 0;
    for (const Points& part : parts)
    {
      append(count, starts);
      for (const auto& point : part)
      {
        append(point[0], points);
        append(point[1], points);
        ++count;
      }
    }
    append(kind, shape);
    appendBox(shape);
    append(std::int32_t(parts.size()), shape);
    append(count, shape);
    shape += starts + points;
    constexpr std::int32_t first = 50; // length of the header, in 16-bit words like all lengths
    const auto words = std::int32_t(shape.size() / 2);
    this->Shapes = header(kind, first + 4 + words) + bigEndian(1) + bigEndian(words) + shape;
    this->Index = header(kind, first + 4) + bigEndian(first) + bigEndian(words);
  }

  std::string Shapes;
  std::string Index;

private:
  template <typename Value>
  static void append(Value value, std::string& bytes) // for little-endian machines
  {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  static std::string bigEndian(std::int32_t value)
  {
    std::string bytes;
    append(value, bytes);
    std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }

  static void appendBox(std::string& bytes)
  {
    for (const double bound : { 0.0, 0.0, 9.0, 9.0 })
    {
      append(bound, bytes);
    }
  }

  static std::string header(std::int32_t kind, std::int32_t words)
  {
    std::string bytes = bigEndian(9994) + std::string(20, '\0') + bigEndian(words);
    append(std::int32_t(1000), bytes);
    append(kind, bytes);
    appendBox(bytes);
    return bytes + std::string(32, '\0');
  }
};

TEST_F(ConstraintVectorFile, ShapefileLines)
{
  const Shapefile file(3, { { { 0, 1 }, { 2, 3 }, { 4, 5 } }, { { 6, 7 }, { 8, 9 } } });
  this->Folder.file("lines.shx", file.Index);
  const ConstraintTable table = this->read("lines.shp", file.Shapes);
  EXPECT_EQ((Numbers{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 }), table.XY);
  EXPECT_EQ((Edges{ { 0, 1 }, { 1, 2 }, { 3, 4 } }), table.Edges);
  EXPECT_EQ(3u, table.PolygonBegin);
}

/// In a shapefile, outer rings are clockwise and holes are counter-clockwise. They are reversed.
TEST_F(ConstraintVectorFile, ShapefilePolygonsWithHoles)
{
  const Shapefile file(
    5, { { { 0, 0 }, { 0, 9 }, { 9, 0 }, { 0, 0 } }, { { 1, 1 }, { 2, 1 }, { 1, 2 }, { 1, 1 } } });
  this->Folder.file("area.shx", file.Index);
  const ConstraintTable table = this->read("area.shp", file.Shapes);
  EXPECT_EQ(0u, table.PolygonBegin);
  EXPECT_EQ((Edges{ { 1, 0 }, { 2, 1 }, { 3, 2 }, { 5, 4 }, { 6, 5 }, { 7, 6 } }), table.Edges);
}

TEST_F(ConstraintVectorFile, ShapefileThatEndsEarly)
{
  const Shapefile file(3, { { { 0, 1 }, { 2, 3 }, { 4, 5 } } });
  this->Folder.file("lines.shx", file.Index);
  this->expectError("lines.shp", file.Shapes.substr(0, file.Shapes.size() - 20), "is damaged");
}

TEST_F(ConstraintVectorFile, GeoJsonThatIsDamaged)
{
  this->expectError("a.geojson", "{ \"type\": ", "cannot be read as lines or polygons");
}

} // namespace

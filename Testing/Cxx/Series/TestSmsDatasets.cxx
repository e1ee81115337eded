// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Files/InputFile.h"
#include "FlattenedSeries.h"
#include "Series/MeshSeries.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;
using Doubles = std::vector<double>;
using Ids = std::vector<std::int64_t>;

template <typename T>
std::string bytes(T value)
{
  return { reinterpret_cast<const char*>(&value), sizeof value };
}

class SmsDatasets : public testing::Test
{
protected:
  std::unique_ptr<MeshSeries> open(const std::string& dat) const
  {
    return openMeshSeries(this->Mesh, { { dat }, false });
  }
  void expectError(const std::string& text, const std::string& words) const
  {
    const std::string path = this->Folder.file("a.dat", text);
    expectIOError(path, words, [&] { this->open(path); });
  }

  /// A dataset in binary: a vector at two times, of which the second has no active triangle.
  static std::string binary(std::int32_t nodes = 5)
  {
    std::string name("velocity");
    name.resize(40, '\0');
    std::string text = bytes(std::int32_t(3000)) + bytes(std::int32_t(100)) +
      bytes(std::int32_t(3)) + bytes(std::int32_t(110)) + bytes(std::int32_t(4)) +
      bytes(std::int32_t(120)) + bytes(std::int32_t(1)) + bytes(std::int32_t(140)) +
      bytes(std::int32_t(170)) + bytes(nodes) + bytes(std::int32_t(180)) + bytes(std::int32_t(2)) +
      bytes(std::int32_t(190)) + name + bytes(std::int32_t(240)) + bytes(2451545.25) +
      bytes(std::int32_t(250)) + bytes(std::int32_t(2));
    for (const int step : { 0, 1 })
    {
      text += bytes(std::int32_t(200)) + bytes(std::int8_t(step)) + bytes(float(10 * step));
      text += step == 1 ? std::string("\1\0", 2) : "";
      for (int i = 0; i < 2 * nodes; ++i)
      {
        text += bytes(float(i + 100 * step));
      }
    }
    return text + bytes(std::int32_t(210));
  }

  TemporaryFolder Folder;
  /// A quadrilateral and a triangle, with a gap among the numbers of nodes.
  const std::string Mesh = this->Folder.file("a.2dm",
    "MESH2D\nND 1 0 0 5\nND 2 1 0 6\nND 3 2 0 7\nND 4 1 1 8\nND 6 0 1 9\nE4Q 1 1 2 4 6 1\nE3T 2 2 "
    "3 "
    "4 1\n");
  const std::string Head = "DATASET\nOBJTYPE \"mesh2d\"\nRT_JULIAN 2433282.5\nBEGSCL\nND 5\nNC 2\n"
                           "NAME \"water depth\"\nTIMEUNITS hours\n";
};

TEST_F(SmsDatasets, InAsciiAreReadAtEachStep)
{
  const std::string path = this->Folder.file(
    "a.dat", this->Head + "TS 0 0.5\n1\n2\n3\n4\n5\nTS 1 1.5\n1\n0\n6\n7\n8\n9\n10\nENDDS\n");
  const auto series = this->open(path);
  EXPECT_EQ((Doubles{ 0.5, 1.5 }), series->Times);
  EXPECT_EQ("hours since 1950-01-01 00:00:00", series->TimeUnits);
  const std::size_t variable = findSeriesVariable(*series, "water depth");
  Doubles values;
  series->read(variable, 0, values);
  EXPECT_EQ((Doubles{ 1, 2, 3, 4, 5 }), values);
  series->read(variable, 1, values);
  EXPECT_TRUE(std::isnan(values.at(2))); // only the inactive triangle has this node
  EXPECT_EQ(7, values.at(1));
  EXPECT_EQ(10, values.at(4));
  EXPECT_EQ((Ids{ 0, 0, 1 }), series->readMesh().OriginalCells);
}

TEST_F(SmsDatasets, MayHaveValuesForTheGapsOfTheNumbers)
{
  std::string head = this->Head;
  head.replace(head.find("ND 5"), 4, "ND 6");
  const auto series =
    this->open(this->Folder.file("a.dat", head + "TS 0 0\n1\n2\n3\n4\n99\n6\nENDDS\n"));
  Doubles values;
  series->read(findSeriesVariable(*series, "water depth"), 0, values);
  EXPECT_EQ((Doubles{ 1, 2, 3, 4, 6 }), values);
  EXPECT_TRUE(series->Times.empty()); // one step
}

TEST_F(SmsDatasets, InBinaryAreVectorsWithTimesAndStatus)
{
  const auto series = this->open(this->Folder.file("a.dat", binary()));
  EXPECT_EQ((Doubles{ 0, 10 }), series->Times);
  EXPECT_EQ("seconds since 2000-01-01 18:00:00", series->TimeUnits);
  const std::size_t x = findSeriesVariable(*series, "velocity.x");
  const std::size_t y = findSeriesVariable(*series, "velocity.y");
  EXPECT_EQ(x + 1, y);
  EXPECT_EQ("velocity", series->Variables[y].Vector);
  EXPECT_EQ(Scalar::Float32, series->Variables[y].Type);
  Doubles values;
  series->read(y, 0, values);
  EXPECT_EQ((Doubles{ 1, 3, 5, 7, 9 }), values);
  series->read(x, 1, values);
  EXPECT_TRUE(std::isnan(values.at(2)));
  EXPECT_EQ(108, values.at(4));
}

TEST_F(SmsDatasets, InFlatMeshesKeepTheirStepsComponentsAndPrecision)
{
  const FlattenedSeries flattened(this->Mesh, { this->Folder.file("a.dat", binary()) });
  const std::string folder = this->Folder.path("flat");
  ASSERT_TRUE(writeFlatMesh(folder, flattened.Content));
  const FlatMesh mesh = openFlatMesh(folder);
  EXPECT_EQ((Doubles{ 0, 10 }), mesh.Times);
  ASSERT_EQ(1U, mesh.PointSeries.size());
  ASSERT_EQ(2U, mesh.PointSeries[0].size());
  const RawArray& second = mesh.PointSeries[0][1];
  EXPECT_EQ("velocity", second.Name);
  EXPECT_EQ(Scalar::Float32, second.Type);
  EXPECT_EQ(2, second.Components);
  float last = 0;
  InputFile(second.Path).read(second.Offset + second.bytes() - sizeof last, &last, sizeof last);
  EXPECT_EQ(109, last);
  ASSERT_EQ(2U, mesh.CellData.size());
  EXPECT_EQ("OriginalCellId", mesh.CellData[0].Name);
  EXPECT_EQ("Region", mesh.CellData[1].Name);
}

TEST_F(SmsDatasets, ThatAreDamagedOrOfAnotherMeshAreRefused)
{
  this->expectError("", "has no dataset");
  this->expectError("hello\n", "no keyword");
  this->expectError(this->Head, "ends before a dataset does");
  this->expectError(this->Head + "ENDDS\n", "without a time step");
  this->expectError(this->Head + "TS 0 0\n1\n2\n", "follow");
  this->expectError(this->Head + "TS 0 0\n1\n2\nx\n4\n5\nENDDS\n", "'x' is not a number");
  this->expectError(this->Head + "TS 0 1\n1\n2\n3\n4\n5\nTS 0 1\n1\n2\n3\n4\n5\nENDDS\n", "ascend");
  this->expectError("BEGSCL\nND 7\nNC 2\nTS 0 0\n", "at 7 nodes, but the mesh has 5");
  this->expectError("BEGSCL\nND 5\nNC 3\nTS 0 0\n", "of 3 cells, but the mesh has 2");
  this->expectError("TS 0 0\n", "before BEGSCL");
  this->expectError(binary(7), "at 7 nodes");
}

TEST_F(SmsDatasets, InBinaryEndInASentenceWhereverTheyAreCutOff)
{
  const std::string whole = binary();
  for (std::size_t size = 4; size < whole.size(); ++size)
  {
    const std::string path = this->Folder.file("a.dat", whole.substr(0, size));
    EXPECT_THROW(this->open(path), IOError) << size;
  }
}

TEST_F(SmsDatasets, OfARealFileAreRead)
{
  TIPP_REQUIRE_DATA(mesh, "meshes/quad_and_triangle.2dm");
  TIPP_REQUIRE_DATA(values, "meshes/quad_and_triangle_vertex_scalar.dat");
  const auto series = openMeshSeries(mesh, { { values }, false });
  Doubles read;
  series->read(findSeriesVariable(*series, "VertexScalarDataset"), 0, read);
  EXPECT_EQ((Doubles{ 1, 2, 3, 2, 1 }), read);
}

TEST_F(SmsDatasets, ARealGridOfQuadrilateralsIsCutIntoTwiceAsManyTriangles)
{
  TIPP_REQUIRE_DATA(path, "meshes/regular_grid.2dm");
  const SeriesMesh mesh = openMeshSeries(path)->readMesh();
  EXPECT_EQ(3U * 3750, mesh.Triangles.size());
  EXPECT_EQ(1874, mesh.OriginalCells.back());
}

} // namespace

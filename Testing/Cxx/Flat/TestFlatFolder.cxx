// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "FlatTesting.h"

#include <cmath>

namespace
{

using tipp::FlatMesh;
using tipp::openFlatMesh;
using tipp::Scalar;
using tipp::test::valuesOf;

class FlatFolder : public testing::Test
{
protected:
  void expectError(const std::string& file, const std::string& words) const
  {
    const std::string path = file.empty() ? this->Maker.path() : this->Maker.path(file);
    tipp::test::expectIOError(path, words, [this] { openFlatMesh(this->Maker.path()); });
  }

  const tipp::test::FlatFolderMaker Maker;
};

} // namespace

TEST_F(FlatFolder, OfTrianglesOpens)
{
  this->Maker.writeSquare();
  EXPECT_TRUE(tipp::isFlatMesh(this->Maker.path()));
  const FlatMesh mesh = openFlatMesh(this->Maker.path());
  EXPECT_EQ(3, mesh.CellSize);
  EXPECT_EQ(2, mesh.Cells.Tuples);
  EXPECT_EQ((std::vector<std::int32_t>{ 0, 1, 2, 0, 2, 3 }), valuesOf<std::int32_t>(mesh.Cells));
  EXPECT_EQ(2, mesh.Points.Components);
  EXPECT_EQ((std::vector<double>{ 0, 0, 1, 0, 1, 1, 0, 1 }), valuesOf<double>(mesh.Points));
  EXPECT_TRUE(mesh.Times.empty());
}

TEST_F(FlatFolder, OfTetrahedraOpens)
{
  this->Maker.write<std::int64_t>("cells.npy", "<i8", "(1, 4)", { 0, 1, 2, 3 });
  this->Maker.write<float>("points.npy", "<f4", "(4, 3)", std::vector<float>(12, 0.5F));
  const FlatMesh mesh = openFlatMesh(this->Maker.path());
  EXPECT_EQ(4, mesh.CellSize);
  EXPECT_EQ(Scalar::Float32, mesh.Points.Type);
  EXPECT_EQ(12U, mesh.Points.tupleBytes());
}

TEST_F(FlatFolder, HoldsDataOfEveryType)
{
  this->Maker.writeSquare();
  this->Maker.write<double>("point_data/heat.npy", "<f8", "(4,)", { 1, 2, 3, 4 });
  this->Maker.write<std::int16_t>(
    "point_data/a%2Fb.npy", "<i2", "(4, 2)", std::vector<std::int16_t>{ 1, 2, 3, 4, 5, 6, 7, 8 });
  this->Maker.write<std::uint8_t>("cell_data/dry.npy", "|b1", "(2, 1)", { 0, 1 });
  const FlatMesh mesh = openFlatMesh(this->Maker.path());
  ASSERT_EQ(2U, mesh.PointData.size());
  EXPECT_EQ("a/b", mesh.PointData[0].Name);
  EXPECT_EQ(2, mesh.PointData[0].Components);
  EXPECT_EQ(Scalar::Int16, mesh.PointData[0].Type);
  EXPECT_EQ("heat", mesh.PointData[1].Name);
  EXPECT_EQ((std::vector<double>{ 1, 2, 3, 4 }), valuesOf<double>(mesh.PointData[1]));
  ASSERT_EQ(1U, mesh.CellData.size());
  EXPECT_EQ(Scalar::UInt8, mesh.CellData[0].Type);
}

TEST_F(FlatFolder, IgnoresOtherFiles)
{
  this->Maker.writeSquare();
  this->Maker.write<double>("point_data/notes.txt", "<f8", "(4,)", { 1, 2, 3, 4 });
  this->Maker.write<double>("point_data/.swap.npy", "<f8", "(9,)", { 1 });
  EXPECT_TRUE(openFlatMesh(this->Maker.path()).PointData.empty());
}

TEST_F(FlatFolder, WithTimesHasArraysThatVary)
{
  this->Maker.writeSquare();
  this->Maker.write<double>("time.npy", "<f8", "(2,)", { 0.5, 1.5 });
  this->Maker.write<float>("point_data/level.npy", "<f4", "(2, 4)", { 0, 1, 2, 3, 4, 5, 6, 7 });
  this->Maker.write<float>("point_data/wind.npy", "<f4", "(2, 4, 2)", std::vector<float>(16, 2.5F));
  this->Maker.write<float>("point_data/depth.npy", "<f4", "(4,)", { 9, 9, 9, 9 });
  const FlatMesh mesh = openFlatMesh(this->Maker.path());
  EXPECT_EQ((std::vector<double>{ 0.5, 1.5 }), mesh.Times);
  ASSERT_EQ(1U, mesh.PointData.size());
  EXPECT_EQ("depth", mesh.PointData[0].Name);
  ASSERT_EQ(2U, mesh.PointSeries.size());
  ASSERT_EQ(2U, mesh.PointSeries[0].size());
  EXPECT_EQ("level", mesh.PointSeries[0][1].Name);
  EXPECT_EQ((std::vector<float>{ 4, 5, 6, 7 }), valuesOf<float>(mesh.PointSeries[0][1]));
  EXPECT_EQ(2, mesh.PointSeries[1][0].Components);
}

// There are two time steps and two cells: an array of shape (2, 2) is a series in time, not a
// vector per cell.
TEST_F(FlatFolder, InterpretsTheFirstAxisAsTime)
{
  this->Maker.writeSquare();
  this->Maker.write<double>("time.npy", "<f8", "(2,)", { 0, 1 });
  this->Maker.write<double>("cell_data/q.npy", "<f8", "(2, 2)", { 1, 2, 3, 4 });
  const FlatMesh mesh = openFlatMesh(this->Maker.path());
  ASSERT_EQ(1U, mesh.CellSeries.size());
  EXPECT_EQ((std::vector<double>{ 3, 4 }), valuesOf<double>(mesh.CellSeries[0][1]));
}

TEST_F(FlatFolder, WithoutItsTwoFilesIsRefused)
{
  EXPECT_FALSE(tipp::isFlatMesh(this->Maker.path()));
  this->expectError("", "without cells.npy and points.npy");
}

TEST_F(FlatFolder, OfOtherCellsIsRefused)
{
  this->Maker.writeSquare();
  this->Maker.write<std::int32_t>("cells.npy", "<i4", "(1, 8)", std::vector<std::int32_t>(8));
  this->expectError("cells.npy", "is 1 x 8 Int32");
  this->Maker.write<double>("cells.npy", "<f8", "(1, 3)", { 0, 1, 2 });
  this->expectError("cells.npy", "is 1 x 3 Float64");
  this->Maker.write<std::int32_t>("cells.npy", "<i4", "(3,)", { 0, 1, 2 });
  this->expectError("cells.npy", "is 3 Int32");
}

TEST_F(FlatFolder, OfOtherPointsIsRefused)
{
  this->Maker.writeSquare();
  this->Maker.write<std::int32_t>("points.npy", "<i4", "(2, 2)", { 0, 1, 2, 3 });
  this->expectError("points.npy", "is 2 x 2 Int32");
  this->Maker.write<double>("points.npy", "<f8", "(4, 1)", { 0, 1, 2, 3 });
  this->expectError("points.npy", "is 4 x 1 Float64");
}

TEST_F(FlatFolder, OfFlatTetrahedraIsRefused)
{
  this->Maker.writeSquare();
  this->Maker.write<std::int32_t>("cells.npy", "<i4", "(1, 4)", { 0, 1, 2, 3 });
  this->expectError("", "tetrahedra with points of 2 coordinates");
}

TEST_F(FlatFolder, WhoseFilesAreCutOffOrTooLongIsRefused)
{
  this->Maker.writeSquare();
  for (const int change : { -1, 1, -40 })
  {
    const std::string path = this->Maker.path("points.npy");
    this->Maker.writeSquare();
    std::filesystem::resize_file(
      path, std::uintmax_t(std::intmax_t(std::filesystem::file_size(path)) + change));
    this->expectError("points.npy", "bytes of data where");
  }
}

TEST_F(FlatFolder, WhoseHeaderOverflowsIsRefused)
{
  this->Maker.writeSquare();
  this->Maker.write<double>("points.npy", "<f8", "(4611686018427387904, 2)", { 0, 1 });
  this->expectError("points.npy", "more than 2^63");
}

TEST_F(FlatFolder, OfBigEndianOrFortranArraysIsRefused)
{
  this->Maker.writeSquare();
  this->Maker.write<double>("points.npy", ">f8", "(1, 2)", { 0, 1 });
  this->expectError("points.npy", "type '>f8'");
  this->Maker.writeSquare();
  const std::string header = "{'descr': '<f8', 'fortran_order': True, 'shape': (1, 2), }";
  std::ofstream(this->Maker.path("points.npy"), std::ios::binary)
    << tipp::test::npyBytes(header, std::string(16, '\0'));
  this->expectError("points.npy", "Fortran order");
}

TEST_F(FlatFolder, WithDataOfAnotherLengthIsRefused)
{
  this->Maker.writeSquare();
  this->Maker.write<double>("point_data/heat.npy", "<f8", "(3,)", { 1, 2, 3 });
  this->expectError("point_data/heat.npy", "is 3 where the mesh has 4 points");
  this->Maker.write<double>("point_data/heat.npy", "<f8", "(4, 0)", {});
  this->expectError("point_data/heat.npy", "is 4 x 0 where");
}

TEST_F(FlatFolder, WithTimesThatDoNotAscendIsRefused)
{
  this->Maker.writeSquare();
  for (const std::vector<double>& times :
    { std::vector<double>{ 1, 1 }, { 2, 1 }, { 0, NAN }, { 0, INFINITY } })
  {
    this->Maker.write<double>("time.npy", "<f8", "(2,)", times);
    this->expectError("time.npy", "not finite and ascending");
  }
}

TEST_F(FlatFolder, OfAnotherKindIsRefused)
{
  const tipp::test::TemporaryFolder folder;
  const std::string path = folder.file("mesh.txt", "0 1 2");
  EXPECT_FALSE(tipp::isFlatMesh(path));
  tipp::test::expectIOError(path, "tipp flatten", [&] { openFlatMesh(path); });
  tipp::test::expectIOError(
    folder.path("none"), "tipp flatten", [&] { openFlatMesh(folder.path("none")); });
}

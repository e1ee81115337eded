// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Meshes/MeshFiles.h"
#include "NpyText.h"
#include "Points/ReadPoints.h"
#include "TemporaryFolder.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

#include <limits>

namespace
{

using Ids = std::vector<std::int64_t>;
using tipp::readMesh;
using tipp::test::bytesOf;
using tipp::test::npyBytes;
using tipp::test::npyHeader;

class MeshFiles : public testing::TestWithParam<const char*>
{
protected:
  MeshFiles()
  {
    this->Points.XY = { 0, 0, 1, 0, 1, 1, 0, 1.1 };
    this->Points.Columns = { { "z", { 5, 6, 7, 8 } }, { "heat", { 0.1, 0.2, 0.3, 0.4 } } };
  }

  tipp::TrianglesView view32() const { return { this->Triangles32.data(), 2 }; }
  tipp::TrianglesView view64() const { return { this->Triangles.data(), 2 }; }

  const tipp::test::TemporaryFolder Folder;
  const Ids Triangles{ 0, 1, 3, 1, 2, 3 };
  const std::vector<std::int32_t> Triangles32{ 0, 1, 3, 1, 2, 3 };
  tipp::PointTable Points;
};

using EveryMeshFormat = MeshFiles;

} // namespace

TEST_F(MeshFiles, NamesThatXmlDoesNotHoldAreReadAsWritten)
{
  const std::vector<std::string> names{ "z", "a&b", "c<d>", "\"quoted\"", "b\xe9ton", "t\x01" };
  this->Points.Columns.resize(1);
  for (std::size_t i = 1; i < names.size(); ++i)
  {
    this->Points.Columns.push_back({ names[i], { 1, 2, 3, 4 } });
  }
  for (const char* const file : { "mesh.vtp", "mesh.vtu" })
  {
    const std::string path = this->Folder.path(file);
    ASSERT_TRUE(tipp::writeMesh(path, this->Points, this->view32()));
    const std::vector<std::string> expected{ "z", "a&b", "c<d>", "\"quoted\"", "b\xc3\xa9ton",
      "t?" };
    EXPECT_EQ(expected, tipp::readPoints(path).names()) << file;
    EXPECT_EQ("a&b", this->Points.Columns[1].Name);
  }
}

TEST_P(EveryMeshFormat, TrianglesOf32BitIdsAreReadAsWritten)
{
  const std::string path = this->Folder.path(GetParam());
  ASSERT_TRUE(tipp::writeMesh(path, this->Points, this->view32()));
  EXPECT_EQ(this->Triangles, readMesh(path).Triangles);
}

TEST_P(EveryMeshFormat, TrianglesOf64BitIdsAreReadAsWritten)
{
  const std::string path = this->Folder.path(GetParam());
  ASSERT_TRUE(tipp::writeMesh(path, this->Points, this->view64()));
  EXPECT_EQ(this->Triangles, readMesh(path).Triangles);
}

TEST_P(EveryMeshFormat, AMeshWithoutTrianglesIsReadAsWritten)
{
  const std::string path = this->Folder.path(GetParam());
  ASSERT_TRUE(tipp::writeMesh(path, this->Points, {}));
  EXPECT_TRUE(readMesh(path).Triangles.empty());
}

TEST_P(EveryMeshFormat, AbortedWriteLeavesTheFolderAsItWas)
{
  tipp::MeshOptions options;
  options.Aborted = []() { return true; };
  EXPECT_FALSE(
    tipp::writeMesh(this->Folder.path(GetParam()), this->Points, this->view32(), options));
  EXPECT_EQ(0U, this->Folder.fileCount());
}

TEST_P(EveryMeshFormat, MissingFolderIsReported)
{
  const std::string path = this->Folder.path("absent/") + GetParam();
  tipp::test::expectIOError(
    path, "folder does not exist", [&]() { tipp::writeMesh(path, this->Points, this->view32()); });
}

TEST_P(EveryMeshFormat, LinkToADeviceIsReported)
{
  const std::string path = this->Folder.path(GetParam());
  std::filesystem::create_symlink("/dev/full", path);
  tipp::test::expectIOError(
    path, "not an ordinary file", [&]() { tipp::writeMesh(path, this->Points, this->view32()); });
}

INSTANTIATE_TEST_SUITE_P(MeshFiles, EveryMeshFormat,
  testing::Values("mesh.npy", "mesh.vtp", "mesh.vtu"),
  [](const auto& info) { return std::string(info.param).substr(5); });

TEST_F(MeshFiles, VtkFilesKeepPointsZAndPointData)
{
  for (const char* name : { "mesh.vtp", "mesh.vtu" })
  {
    const std::string path = this->Folder.path(name);
    tipp::writeMesh(path, this->Points, this->view32());
    EXPECT_EQ(this->Points.XY, readMesh(path).XY);
    const tipp::PointTable points = tipp::readPoints(path);
    ASSERT_EQ(2U, points.Columns.size());
    EXPECT_EQ(this->Points.Columns[0].Values, points.Columns[0].Values);
    EXPECT_EQ("heat", points.Columns[1].Name);
    EXPECT_EQ(this->Points.Columns[1].Values, points.Columns[1].Values);
  }
}

TEST_F(MeshFiles, WithoutAColumnNamedZTheMeshIsFlat)
{
  this->Points.Columns.erase(this->Points.Columns.begin());
  const std::string path = this->Folder.path("mesh.vtp");
  tipp::writeMesh(path, this->Points, this->view32());
  EXPECT_EQ((std::vector<double>(4, 0.0)), tipp::readPoints(path).Columns.at(0).Values);
}

TEST_F(MeshFiles, RepresentativesAreAPointArray)
{
  tipp::MeshOptions options;
  options.Representatives = { 0, 1, 2, 0 };
  const std::string path = this->Folder.path("mesh.vtu");
  tipp::writeMesh(path, this->Points, this->view64(), options);
  const tipp::PointTable points = tipp::readPoints(path);
  ASSERT_EQ(3U, points.Columns.size());
  EXPECT_EQ("RepresentativePointId", points.Columns[2].Name);
  EXPECT_EQ((std::vector<double>{ 0, 1, 2, 0 }), points.Columns[2].Values);
}

TEST_F(MeshFiles, NeighborsAreACellArray)
{
  // Two triangles with a common edge, and a third that touches them only at a vertex.
  const Ids strip = { 0, 1, 2, 2, 1, 3, 3, 4, 5 };
  const std::vector<std::int32_t> strip32(strip.begin(), strip.end());
  this->Points.XY.resize(12);
  this->Points.Columns.clear();
  tipp::MeshOptions options;
  options.Neighbors = true;
  for (const char* const name : { "mesh.vtp", "mesh.vtu" })
  {
    const std::string path = this->Folder.path(name);
    tipp::writeMesh(path, this->Points, { strip.data(), 3 }, options);
    EXPECT_EQ((Ids{ 1, -1, -1, -1, -1, 0, -1, -1, -1 }), readMesh(path).Neighbors);
    tipp::writeMesh(path, this->Points, { strip32.data(), 3 }, options);
    EXPECT_EQ((Ids{ 1, -1, -1, -1, -1, 0, -1, -1, -1 }), readMesh(path).Neighbors);
    tipp::writeMesh(path, this->Points, { strip.data(), 3 });
    EXPECT_TRUE(readMesh(path).Neighbors.empty());
  }
}

TEST_F(MeshFiles, IdsOfAllIntegerTypesAreRead)
{
  const auto read = [this](const char* descr, const std::string& data)
  {
    return readMesh(this->Folder.file("mesh.npy", npyBytes(npyHeader(descr, "(1, 3)"), data)))
      .Triangles;
  };
  EXPECT_EQ((Ids{ 0, 1, -2 }), read("<i4", bytesOf<std::int32_t>({ 0, 1, -2 })));
  EXPECT_EQ((Ids{ 0, 1, 4294967295 }), read("<u4", bytesOf<std::uint32_t>({ 0, 1, 4294967295U })));
  EXPECT_EQ((Ids{ 0, 1, -2 }), read("<i8", bytesOf<std::int64_t>({ 0, 1, -2 })));
  EXPECT_EQ((Ids{ 0, 1, 2 }), read("<u8", bytesOf<std::uint64_t>({ 0, 1, 2 })));
}

TEST_F(MeshFiles, ManyTrianglesAreReadInChunks)
{
  std::vector<std::int32_t> ids;
  for (std::int32_t i = 0; i < 300000; ++i)
  {
    ids.push_back(i);
  }
  const std::string path = this->Folder.path("mesh.npy");
  tipp::writeMesh(path, {}, { ids.data(), 100000 });
  EXPECT_EQ(Ids(ids.begin(), ids.end()), readMesh(path).Triangles);
}

TEST_F(MeshFiles, ArraysOfOtherShapesAreReported)
{
  const std::string floats =
    this->Folder.file("floats.npy", npyBytes(npyHeader("<f8", "(1, 3)"), std::string(24, '\0')));
  tipp::test::expectIOError(floats, "does not hold triangles", [&]() { readMesh(floats); });
  const std::string quads =
    this->Folder.file("quads.npy", npyBytes(npyHeader("<i8", "(1, 4)"), std::string(32, '\0')));
  tipp::test::expectIOError(quads, "does not hold triangles", [&]() { readMesh(quads); });
}

TEST_F(MeshFiles, OtherCellsAreReported)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 4; ++i)
  {
    points->InsertNextPoint(i % 2, i / 2, 0);
  }
  data->SetPoints(points);
  data->AllocateEstimate(1, 4);
  const vtkIdType quad[4] = { 0, 1, 3, 2 };
  data->InsertNextCell(VTK_QUAD, 4, quad);
  const std::string path = this->Folder.path("quad.vtp");
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  writer->Write();
  tipp::test::expectIOError(path, "not a triangle (cell 0)", [&]() { readMesh(path); });
}

TEST_F(MeshFiles, UnknownExtensionIsReported)
{
  const std::string path = this->Folder.path("mesh.stl2");
  tipp::test::expectIOError(path, "use .npy, .vtp, .vtu, .14, .gr3, .2dm, .nc, .msh or .node",
    [&]() { tipp::writeMesh(path, this->Points, this->view32()); });
  tipp::test::expectIOError(path, "no extension", [&]() { readMesh(path); });
}

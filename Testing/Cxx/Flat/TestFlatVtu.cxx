// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "FlatTesting.h"
#include "Meshes/MeshFiles.h"
#include "SharedData.h"
#include "Vtk/DataSets.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridWriter.h"

namespace
{

using tipp::FlatMesh;
using tipp::openFlatMesh;
using tipp::Scalar;
using tipp::test::contentOf;
using tipp::test::valuesOf;

class FlatVtu : public testing::Test
{
protected:
  FlatVtu()
  {
    this->Points->SetDataTypeToDouble();
    this->Grid->SetPoints(this->Points);
    this->Writer->SetInputData(this->Grid);
    this->Writer->SetFileName(this->Path.c_str());
    this->Writer->SetDataModeToAppended();
    this->Writer->EncodeAppendedDataOff();
    this->Writer->SetCompressorTypeToNone();
  }

  void makeTriangles()
  {
    for (const auto& p :
      { std::array<double, 3>{ 0, 0, 7 }, { 1, 0, 8 }, { 1, 1, 9 }, { 0, 1, 6 } })
    {
      this->Points->InsertNextPoint(p.data());
    }
    this->insert(VTK_TRIANGLE, { 0, 1, 2 });
    this->insert(VTK_TRIANGLE, { 0, 2, 3 });
    vtkNew<vtkDoubleArray> heat;
    heat->SetName("he<at & co");
    for (int i = 0; i < 4; ++i)
    {
      heat->InsertNextValue(i + 0.25);
    }
    this->Grid->GetPointData()->SetScalars(heat);
    vtkNew<vtkIntArray> region;
    region->SetName("region");
    region->InsertNextValue(-3);
    region->InsertNextValue(4);
    this->Grid->GetCellData()->AddArray(region);
  }

  void insert(int type, const std::vector<vtkIdType>& ids)
  {
    this->Grid->InsertNextCell(type, vtkIdType(ids.size()), ids.data());
  }

  void expectError(const std::string& words) const
  {
    tipp::test::expectIOError(this->Path, words, [this] { openFlatMesh(this->Path); });
  }

  /// Replaces the first occurrence of `old` in the file by `now`.
  void replace(const std::string& old, const std::string& now) const
  {
    std::string content = contentOf(this->Path);
    const std::size_t at = content.find(old);
    ASSERT_NE(std::string::npos, at) << old;
    content.replace(at, old.size(), now);
    std::ofstream(this->Path, std::ios::binary) << content;
  }

  const tipp::test::TemporaryFolder Folder;
  const std::string Path = Folder.path("mesh.vtu");
  const vtkNew<vtkPoints> Points;
  const vtkNew<vtkUnstructuredGrid> Grid;
  const vtkNew<vtkXMLUnstructuredGridWriter> Writer;
};

} // namespace

TEST_F(FlatVtu, OfVtksWriterOpensInPlaceWithEveryWidth)
{
  this->makeTriangles();
  for (const int header : { 32, 64 })
  {
    for (const int ids : { 32, 64 })
    {
      this->Writer->SetHeaderType(header);
      this->Writer->SetIdType(ids);
      this->Writer->Write();
      EXPECT_TRUE(tipp::isFlatMesh(this->Path));
      const FlatMesh mesh = openFlatMesh(this->Path);
      EXPECT_EQ(3, mesh.CellSize);
      ASSERT_EQ(2, mesh.Cells.Tuples);
      if (mesh.Cells.Type == Scalar::Int32)
      {
        EXPECT_EQ(
          (std::vector<std::int32_t>{ 0, 1, 2, 0, 2, 3 }), valuesOf<std::int32_t>(mesh.Cells));
      }
      else
      {
        EXPECT_EQ(
          (std::vector<std::int64_t>{ 0, 1, 2, 0, 2, 3 }), valuesOf<std::int64_t>(mesh.Cells));
      }
      EXPECT_EQ(
        (std::vector<double>{ 0, 0, 7, 1, 0, 8, 1, 1, 9, 0, 1, 6 }), valuesOf<double>(mesh.Points));
      ASSERT_EQ(1U, mesh.PointData.size());
      EXPECT_EQ("he<at & co", mesh.PointData[0].Name);
      EXPECT_EQ(
        (std::vector<double>{ 0.25, 1.25, 2.25, 3.25 }), valuesOf<double>(mesh.PointData[0]));
      ASSERT_EQ(1U, mesh.CellData.size());
      EXPECT_EQ((std::vector<std::int32_t>{ -3, 4 }), valuesOf<std::int32_t>(mesh.CellData[0]));
    }
  }
}

TEST_F(FlatVtu, OfOurOwnWriterOpensInPlace)
{
  tipp::PointTable points;
  points.XY = { 0, 0, 1, 0, 1, 1, 0, 1.5 };
  points.Columns = { { "z", { 5, 6, 7, 8 } }, { "heat", { 1, 2, 3, 4 } } };
  const std::vector<std::int32_t> ids{ 0, 1, 3, 1, 2, 3 };
  tipp::writeMesh(this->Path, points, { ids.data(), 2 });
  const FlatMesh mesh = openFlatMesh(this->Path);
  EXPECT_EQ(2, mesh.Cells.Tuples);
  EXPECT_EQ(
    (std::vector<double>{ 0, 0, 5, 1, 0, 6, 1, 1, 7, 0, 1.5, 8 }), valuesOf<double>(mesh.Points));
  EXPECT_EQ((std::vector<double>{ 1, 2, 3, 4 }), valuesOf<double>(mesh.PointData.at(0)));
}

TEST_F(FlatVtu, OfTetrahedraOpensInPlace)
{
  for (int i = 0; i < 5; ++i)
  {
    this->Points->InsertNextPoint(i == 1, i == 2, i == 3);
  }
  this->insert(VTK_TETRA, { 0, 1, 2, 3 });
  this->insert(VTK_TETRA, { 1, 2, 3, 4 });
  this->Writer->Write();
  const FlatMesh mesh = openFlatMesh(this->Path);
  EXPECT_EQ(4, mesh.CellSize);
  EXPECT_EQ(2, mesh.Cells.Tuples);
}

TEST_F(FlatVtu, WithoutCellsOpens)
{
  this->Writer->Write();
  EXPECT_EQ(0, openFlatMesh(this->Path).Cells.Tuples);
}

TEST_F(FlatVtu, IgnoresStringArrays)
{
  this->makeTriangles();
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  names->InsertNextValue("a");
  names->InsertNextValue("b");
  this->Grid->GetCellData()->AddArray(names);
  this->Writer->Write();
  EXPECT_EQ(1U, openFlatMesh(this->Path).CellData.size());
}

TEST_F(FlatVtu, OfOtherCellsNamesTheFirstAndTheRemedy)
{
  this->makeTriangles();
  this->insert(VTK_QUAD, { 0, 1, 2, 3 });
  this->Grid->GetCellData()->Initialize();
  this->Writer->Write();
  this->expectError("cell 2, vtkQuad");
  this->expectError("tipp flatten");
}

TEST_F(FlatVtu, OfTrianglesAndTetrahedraIsRefused)
{
  this->makeTriangles();
  this->insert(VTK_TETRA, { 0, 1, 2, 3 });
  this->Grid->GetCellData()->Initialize();
  this->Writer->Write();
  this->expectError("cell 2, vtkTetra");
}

TEST_F(FlatVtu, OpensWithALongHeader)
{
  this->makeTriangles();
  this->Writer->Write();
  const std::string content = contentOf(this->Path);
  const std::size_t tag = content.find("<AppendedData");
  const std::size_t mark = content.find('_', tag);
  // The header is read in blocks of 64 KiB. The tag, and the mark where the data begin, may be in
  // different blocks.
  const std::string wide = content.substr(0, mark) + std::string(500, ' ') + content.substr(mark);
  for (const int before : { -3, 3, 70, 300, 505 })
  {
    const std::size_t padding = (1 << 16) - tag - std::size_t(before);
    std::ofstream(this->Path, std::ios::binary)
      << wide.substr(0, tag) + std::string(padding, ' ') + wide.substr(tag);
    EXPECT_EQ(2, openFlatMesh(this->Path).Cells.Tuples) << before;
  }
}

TEST_F(FlatVtu, ThatIsNotRawAppendedNamesTheRemedy)
{
  this->makeTriangles();
  this->Writer->SetDataModeToAscii();
  this->Writer->Write();
  EXPECT_FALSE(tipp::isFlatMesh(this->Path));
  this->expectError("tipp flatten");
  this->Writer->SetDataModeToBinary();
  this->Writer->Write();
  this->expectError("tipp flatten");
  this->Writer->SetDataModeToAppended();
  this->Writer->EncodeAppendedDataOn();
  this->Writer->Write();
  this->expectError("encoded");
  this->Writer->EncodeAppendedDataOff();
  this->Writer->SetCompressorTypeToZLib();
  this->Writer->Write();
  this->expectError("compressed");
  this->Writer->SetCompressorTypeToNone();
  this->Writer->SetByteOrderToBigEndian();
  this->Writer->Write();
  this->expectError("little-endian");
}

TEST_F(FlatVtu, ThatIsTruncatedAnywhereIsRefused)
{
  this->makeTriangles();
  this->Writer->Write();
  const std::string whole = contentOf(this->Path);
  // The lines after the data are not needed.
  const std::size_t needed = whole.rfind("\n  </AppendedData>");
  ASSERT_NE(std::string::npos, needed);
  for (std::size_t size = 0; size < needed; size += 1 + size / 50)
  {
    std::ofstream(this->Path, std::ios::binary) << whole.substr(0, size);
    EXPECT_THROW(openFlatMesh(this->Path), tipp::IOError) << size;
  }
}

TEST_F(FlatVtu, WithHostileCountsIsRefused)
{
  this->makeTriangles();
  this->Writer->Write();
  const std::string whole = contentOf(this->Path);
  const char* const changes[][2] = {
    { "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\"" },
    { "NumberOfPoints=\"4\"", "NumberOfPoints=\"-4\"" },
    { "NumberOfPoints=\"4\"", "NumberOfPoints=\"9223372036854775807\"" },
    { "NumberOfPoints=\"4\"", "NumberOfPoints=\"99999999999999999999\"" },
    { "NumberOfCells=\"2\"", "NumberOfCells=\"1\"" },
    { "NumberOfCells=\"2\"", "NumberOfCells=\"two\"" },
    { "NumberOfComponents=\"3\"", "NumberOfComponents=\"0\"" },
    { "NumberOfComponents=\"3\"", "NumberOfComponents=\"2147483647\"" },
    { "NumberOfComponents=\"3\"", "NumberOfComponents=\"4\"" },
    { "header_type=\"UInt32\"", "header_type=\"UInt16\"" },
    { "header_type=\"UInt32\"", "header_type=\"UInt64\"" },
    { "offset=\"0\"", "offset=\"18446744073709551615\"" },
    { "offset=\"0\"", "offset=\"-1\"" },
    { "offset=\"0\"", "offset=\"7\"" },
    { "Name=\"connectivity\"", "Name=\"disconnected\"" },
    { "Name=\"types\"", "Name=\"offsets\"" },
    { "type=\"UnstructuredGrid\"", "type=\"PolyData\"" },
    { "<Piece", "<Peace" },
    { "</Piece>", "</Piece><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"></Piece>" },
  };
  for (const auto& change : changes)
  {
    std::ofstream(this->Path, std::ios::binary) << whole;
    this->replace(change[0], change[1]);
    tipp::test::expectIOError(this->Path, "", [this] { openFlatMesh(this->Path); });
  }
}

TEST_F(FlatVtu, WithOffsetsOfOtherCellsIsRefused)
{
  this->makeTriangles();
  this->Grid->GetCells()->ConvertTo64BitStorage(); // not the default in VTK 9.7
  this->Writer->SetHeaderTypeToUInt64();
  this->Writer->Write();
  const std::vector<std::int64_t> good{ 3, 6 };
  const std::vector<std::int64_t> bad{ 2, 6 };
  this->replace(tipp::test::bytesOf(good), tipp::test::bytesOf(bad));
  this->expectError("gives cell 0 other than 3 vertices");
}

TEST_F(FlatVtu, OfACompressedRealMeshNamesTheRemedy)
{
  TIPP_REQUIRE_DATA(path, "tets/bracket_appended_compressed.vtu");
  tipp::test::expectIOError(path, "tipp flatten", [&] { openFlatMesh(path); });
}

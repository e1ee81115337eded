// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "TemporaryFolder.h"
#include "Vtk/DataSets.h"

#include "vtkNew.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace
{

const std::string wholeXml = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Float64" Name="heat" NumberOfComponents="1" format="ascii">
1 2 3</DataArray></PointData>
<Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)";

const std::string wholeLegacy = R"(# vtk DataFile Version 4.2
mesh
ASCII
DATASET POLYDATA
POINTS 3 double
0 0 0 1 0 0 0 1 0
POLYGONS 1 4
3 0 1 2
POINT_DATA 3
SCALARS heat double 1
LOOKUP_TABLE default
1 2 3
FIELD FieldData 1
wind 2 3 double
1 2 3 4 5 6
)";

std::string changed(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

class CheckVtkFile : public testing::Test
{
protected:
  void expectRefusal(const std::string& name, const std::string& content, const std::string& words)
  {
    const std::string path = this->Folder.file(name, content);
    tipp::test::expectIOError(path, words, [&] { tipp::readDataSet(path); });
  }

  const tipp::test::TemporaryFolder Folder;
};

} // namespace

TEST_F(CheckVtkFile, ValidFilesPass)
{
  EXPECT_TRUE(tipp::readDataSet(this->Folder.file("whole.vtu", wholeXml)));
  EXPECT_TRUE(tipp::readDataSet(this->Folder.file("whole.vtk", wholeLegacy)));
}

TEST_F(CheckVtkFile, CountsThatTheFileCannotHoldAreRefused)
{
  for (const std::string& key :
    { std::string("NumberOfPoints=\"3\""), std::string("NumberOfCells=\"1\""),
      std::string("NumberOfComponents=\"1\""), std::string("NumberOfComponents=\"3\"") })
  {
    for (const char* const count : { "4294967296", "-1", "9000000000000000000", "nan", "" })
    {
      std::string bad = key.substr(0, key.find('"') + 1) + count + "\"";
      this->expectRefusal("bad.vtu", changed(wholeXml, key, bad), bad);
    }
  }
}

TEST_F(CheckVtkFile, AnArrayLargerThanTheFileIsRefused)
{
  this->expectRefusal("bad.vtu",
    changed(wholeXml, "NumberOfComponents=\"1\"", "NumberOfComponents=\"100000\""), "'heat'");
}

TEST_F(CheckVtkFile, PiecesOfAParallelFileAreChecked)
{
  this->Folder.file(
    "piece.vtu", changed(wholeXml, "NumberOfCells=\"1\"", "NumberOfCells=\"4294967296\""));
  const std::string path = this->Folder.file("mesh.pvtu",
    "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">"
    "<PUnstructuredGrid GhostLevel=\"0\"><PPoints><PDataArray type=\"Float64\" Name=\"Points\" "
    "NumberOfComponents=\"3\"/></PPoints><Piece Source=\"piece.vtu\"/></PUnstructuredGrid>"
    "</VTKFile>");
  tipp::test::expectIOError(
    this->Folder.path("piece.vtu"), "4294967296", [&] { tipp::readDataSet(path); });
}

TEST_F(CheckVtkFile, ImagesLargerThanTheirFileAreRefused)
{
  const std::string image = R"(<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian">
<ImageData WholeExtent="0 99999 0 99999 0 99999" Origin="0 0 0" Spacing="1 1 1">
<Piece Extent="0 99999 0 99999 0 99999"><PointData>
<DataArray type="Float64" Name="heat" format="ascii">1 2 3</DataArray>
</PointData></Piece></ImageData></VTKFile>)";
  this->expectRefusal("image.vti", image, "'heat'");
  this->expectRefusal(
    "range.vti", changed(image, "99999\"", "99999999999\""), "no range of points");
}

/// Files that VTK's writer makes.
class CheckVtkFileData : public CheckVtkFile
{
protected:
  enum class Kind
  {
    Inline,
    Encoded,
    Raw
  };

  std::string written(Kind kind, bool isCompressed)
  {
    const std::string path = this->Folder.path("written.vtu");
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetInputData(tipp::readDataSet(this->Folder.file("whole.vtu", wholeXml)));
    kind == Kind::Inline ? writer->SetDataModeToBinary() : writer->SetDataModeToAppended();
    writer->SetEncodeAppendedData(kind == Kind::Encoded);
    writer->SetCompressorType(
      isCompressed ? vtkXMLWriter::ZLIB : static_cast<int>(vtkXMLWriter::NONE));
    writer->Write();
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
  }

  /// The index of a character in the middle of the file's last array.
  static std::size_t middle(const std::string& text, Kind kind)
  {
    return kind == Kind::Inline ? text.rfind("</DataArray>") - 20
                                : text.rfind("</AppendedData>") - 20;
  }
};

TEST_F(CheckVtkFileData, FilesOfVtksWriterPass)
{
  for (const Kind kind : { Kind::Inline, Kind::Encoded, Kind::Raw })
  {
    for (const bool isCompressed : { false, true })
    {
      const std::string path = this->Folder.file("mesh.vtu", this->written(kind, isCompressed));
      EXPECT_EQ(tipp::readDataSet(path)->GetNumberOfPoints(), 3);
    }
  }
}

TEST_F(CheckVtkFileData, TextThatIsNotBase64IsRefused)
{
  for (const Kind kind : { Kind::Inline, Kind::Encoded })
  {
    for (const char bad : { '\xff', '-', '=' })
    {
      std::string text = this->written(kind, false);
      text[middle(text, kind)] = bad;
      this->expectRefusal("bad.vtu", text, "damaged or not all there");
    }
  }
}

TEST_F(CheckVtkFileData, AnArrayThatEndsTooSoonIsRefused)
{
  for (const Kind kind : { Kind::Inline, Kind::Encoded, Kind::Raw })
  {
    std::string text = this->written(kind, false);
    text.erase(middle(text, kind), 8);
    this->expectRefusal("bad.vtu", text, "damaged or not all there");
  }
}

TEST_F(CheckVtkFile, LegacyCountsThatTheFileCannotHoldAreRefused)
{
  for (const auto& [from, to] :
    { std::pair<std::string, std::string>{ "POINTS 3", "POINTS 999999999" },
      { "POINTS 3", "POINTS -3" }, { "POLYGONS 1 4", "POLYGONS 1 4294967296" },
      { "POINT_DATA 3", "POINT_DATA 99999999" }, { "heat double 1", "heat double 999999" },
      { "FieldData 1", "FieldData 999999999" }, { "wind 2 3", "wind 999999 3" } })
  {
    this->expectRefusal("bad.vtk", changed(wholeLegacy, from, to), "bytes cannot hold");
  }
}

TEST_F(CheckVtkFile, LegacyCellsThatDoNotFitTheirCountAreRefused)
{
  this->expectRefusal("bad.vtk", changed(wholeLegacy, "3 0 1 2", "9 0 1 2"), "does not fit");
  this->expectRefusal("bad.vtk", changed(wholeLegacy, "3 0 1 2", "-3 0 1 2"), "does not fit");
  this->expectRefusal(
    "bad.vtk", changed(wholeLegacy, "POLYGONS 1 4", "POLYGONS 2 4"), "does not fit");
}

TEST_F(CheckVtkFile, ErrorsOfVtksReaderAreErrors)
{
  this->expectRefusal(
    "bad.vtk", changed(wholeLegacy, "FIELD", "FEILD"), "(Unsupported point attribute");
}

TEST(ErrorKeeper, KeepsMessagesWithoutSourcePositionAndAddress)
{
  const auto kept = [](std::string text)
  {
    vtkNew<tipp::ErrorKeeper> keeper;
    keeper->Execute(nullptr, vtkCommand::WarningEvent, text.data());
    return keeper->message();
  };
  EXPECT_EQ(kept("ERROR: In /build/x (1)/vtkThing.cxx, line 98\n"
                 "vtkThing (0x55d0c2): File a): b.vtu is cut.\n\n"),
    "File a): b.vtu is cut.");
  EXPECT_EQ(kept("Warning: In a.cxx, line 1\nvtkThing (0x5): Bad.\nMore."), "Bad.");
  EXPECT_EQ(kept("Algorithm vtkThing(0x55d0c2d3) failed"), "Algorithm vtkThing failed");
  EXPECT_EQ(kept("no \f type\r"), "no ? type?");
  EXPECT_EQ(kept("plain"), "plain");
}

TEST(ErrorKeeper, KeepsAllMessagesExceptThoseOfThePipeline)
{
  vtkNew<tipp::ErrorKeeper> keeper;
  const auto say = [&](unsigned long event, std::string text)
  { keeper->Execute(nullptr, event, text.data()); };
  say(vtkCommand::WarningEvent, "first");
  EXPECT_FALSE(keeper->HasError);
  say(vtkCommand::ErrorEvent, "Algorithm vtkThing(0x55d0c2d3) returned failure for request: x");
  say(vtkCommand::WarningEvent, "second");
  EXPECT_TRUE(keeper->HasError);
  EXPECT_EQ(keeper->message(), "first");
  EXPECT_EQ(keeper->Messages, (std::vector<std::string>{ "first", "second" }));
}

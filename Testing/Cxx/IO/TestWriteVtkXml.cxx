// SPDX-License-Identifier: BSD-3-Clause
// VTK reads what the writer without VTK writes.
#include "Files/WriteVtkXml.h"

#include "TemporaryFolder.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataReader.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

/// Points along the x axis, with an array.
XmlPiece piece(const std::vector<double>& coordinates, const XmlArray& array)
{
  const std::uint64_t count = coordinates.size() / 3;
  return { "PolyData",
    { { "NumberOfPoints", count }, { "NumberOfVerts", 0 }, { "NumberOfLines", 0 },
      { "NumberOfStrips", 0 }, { "NumberOfPolys", 0 } },
    { { "PointData", { array }, array.Name },
      { "Points", { xmlArray("Points", coordinates.data(), coordinates.size(), 3) }, "" } } };
}

std::vector<double> pointsOf(std::size_t count)
{
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < count; ++i)
  {
    coordinates.insert(coordinates.end(), { double(i), 0, 0 });
  }
  return coordinates;
}

class WriteVtkXml : public testing::Test
{
protected:
  vtkPolyData* read(const std::string& path)
  {
    this->Reader->SetFileName(path.c_str());
    this->Reader->Update();
    return this->Reader->GetOutput();
  }

  const TemporaryFolder Folder;
  vtkNew<vtkXMLPolyDataReader> Reader;
};

TEST_F(WriteVtkXml, ArraysAreReadWithTheirNamesAndTypes)
{
  const std::vector<double> points = pointsOf(3);
  const std::vector<std::int64_t> values{ -1, std::int64_t(1) << 40, 7 };
  const std::string name = "a<b> & \"c\"";
  const std::string path = this->Folder.path("a.vtp");
  ASSERT_TRUE(
    writeXmlPiece(path, std::nullopt, piece(points, xmlArray(name, values.data(), values.size()))));
  vtkPolyData* const data = this->read(path);
  ASSERT_EQ(3, data->GetNumberOfPoints());
  EXPECT_EQ(2, data->GetPoint(2)[0]);
  vtkDataArray* const array = data->GetPointData()->GetScalars();
  ASSERT_TRUE(array);
  EXPECT_EQ(name, array->GetName());
  EXPECT_EQ(8, array->GetDataTypeSize());
  for (vtkIdType i = 0; i < 3; ++i)
  {
    EXPECT_EQ(double(values[std::size_t(i)]), array->GetTuple1(i));
  }
}

TEST_F(WriteVtkXml, ComputedValuesAreWrittenInParts)
{
  constexpr std::size_t count = 40000; // more than one part
  const std::vector<double> points = pointsOf(count);
  const std::string path = this->Folder.path("a.vtp");
  ASSERT_TRUE(writeXmlPiece(path, std::nullopt,
    piece(points,
      computedXmlArray<float>("half", count, [](std::size_t i) { return double(i) / 2; }))));
  vtkDataArray* const array = this->read(path)->GetPointData()->GetArray("half");
  ASSERT_TRUE(array);
  ASSERT_EQ(vtkIdType(count), array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < vtkIdType(count); ++i)
  {
    ASSERT_EQ(double(i) / 2, array->GetTuple1(i));
  }
}

TEST_F(WriteVtkXml, AStoppedWriterLeavesNoFile)
{
  const std::vector<double> points = pointsOf(3);
  const XmlPiece written = piece(points, xmlArray("x", points.data(), 3));
  EXPECT_FALSE(
    writeXmlPiece(this->Folder.path("a.vtp"), std::nullopt, written, [] { return true; }));
  EXPECT_EQ(0U, this->Folder.fileCount());
}

} // namespace

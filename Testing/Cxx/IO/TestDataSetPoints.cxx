// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Points/ReadPoints.h"
#include "SharedData.h"
#include "TemporaryFolder.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSTLWriter.h"
#include "vtkStringArray.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataWriter.h"

namespace
{

using tipp::PointTable;
using tipp::readPoints;
using Values = std::vector<double>;

// A triangle with three point arrays: a scalar, a vector and text.
vtkSmartPointer<vtkPolyData> triangle()
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 7);
  points->InsertNextPoint(1, 0, 8);
  points->InsertNextPoint(0, 1, 9);
  data->SetPoints(points);
  data->AllocateEstimate(1, 3);
  const vtkIdType ids[3] = { 0, 1, 2 };
  data->InsertNextCell(VTK_TRIANGLE, 3, ids);
  vtkNew<vtkFloatArray> heat;
  vtkNew<vtkFloatArray> wind;
  vtkNew<vtkStringArray> names;
  heat->SetName("heat");
  wind->SetName("wind");
  names->SetName("names");
  wind->SetNumberOfComponents(2);
  for (int i = 0; i < 3; ++i)
  {
    heat->InsertNextValue(float(i) + 0.5F);
    wind->InsertNextTuple2(10 + i, 20 + i);
    names->InsertNextValue("name");
  }
  data->GetPointData()->AddArray(heat);
  data->GetPointData()->AddArray(wind);
  data->GetPointData()->AddArray(names);
  return data;
}

template <typename Writer>
void write(const std::string& path, vtkDataObject* data)
{
  vtkNew<Writer> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputDataObject(data);
  ASSERT_EQ(1, writer->Write());
}

class DataSetPoints : public testing::Test
{
protected:
  void expectTriangle(const PointTable& points) const
  {
    EXPECT_EQ((Values{ 0, 0, 1, 0, 0, 1 }), points.XY);
    ASSERT_FALSE(points.Columns.empty());
    EXPECT_EQ("z", points.Columns[0].Name);
    EXPECT_EQ((Values{ 7, 8, 9 }), points.Columns[0].Values);
  }

  const tipp::test::TemporaryFolder Folder;
};

} // namespace

TEST_F(DataSetPoints, PolyDataGivesPointsAndNumericPointData)
{
  const std::string path = this->Folder.path("points.vtp");
  write<vtkXMLPolyDataWriter>(path, triangle());
  const PointTable points = readPoints(path);
  this->expectTriangle(points);
  ASSERT_EQ(4U, points.Columns.size());
  EXPECT_EQ("heat", points.Columns[1].Name);
  EXPECT_EQ((Values{ 0.5, 1.5, 2.5 }), points.Columns[1].Values);
  EXPECT_EQ("wind_0", points.Columns[2].Name);
  EXPECT_EQ("wind_1", points.Columns[3].Name);
  EXPECT_EQ((Values{ 20, 21, 22 }), points.Columns[3].Values);
}

TEST_F(DataSetPoints, AnArrayNamedLikeACoordinateIsRenamed)
{
  const vtkSmartPointer<vtkPolyData> data = triangle();
  data->GetPointData()->GetArray("heat")->SetName("z");
  const std::string path = this->Folder.path("points.vtp");
  write<vtkXMLPolyDataWriter>(path, data);
  const PointTable points = readPoints(path);
  this->expectTriangle(points);
  EXPECT_EQ("z", points.Columns[0].Name);
  EXPECT_EQ("z_2", points.Columns[1].Name);
}

TEST_F(DataSetPoints, LegacyPlyAndStlFilesAreRead)
{
  const std::string legacy = this->Folder.path("points.vtk");
  const std::string ply = this->Folder.path("points.ply");
  const std::string stl = this->Folder.path("points.stl");
  write<vtkPolyDataWriter>(legacy, triangle());
  write<vtkPLYWriter>(ply, triangle());
  write<vtkSTLWriter>(stl, triangle());
  this->expectTriangle(readPoints(legacy));
  this->expectTriangle(readPoints(ply));
  this->expectTriangle(readPoints(stl));
}

TEST_F(DataSetPoints, ImagePointsAreItsGrid)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  image->SetSpacing(0.5, 2, 1);
  const std::string path = this->Folder.path("points.vti");
  write<vtkXMLImageDataWriter>(path, image);
  EXPECT_EQ((Values{ 0, 0, 0.5, 0, 1, 0, 0, 2, 0.5, 2, 1, 2 }), readPoints(path).XY);
}

TEST_F(DataSetPoints, CompressedRealFileIsRead)
{
  TIPP_REQUIRE_DATA(path, "tets/bracket_appended_compressed.vtu");
  EXPECT_EQ(50000U, readPoints(path).size());
}

TEST_F(DataSetPoints, BrokenFilesAreReportedOnce)
{
  const std::string whole = this->Folder.path("whole.vtp");
  write<vtkXMLPolyDataWriter>(whole, triangle());
  const std::string content = tipp::test::contentOf(whole);
  for (const std::string& broken : { std::string(), std::string("garbage"),
         content.substr(0, content.size() / 3), content.substr(0, 20) })
  {
    const std::string path = this->Folder.file("broken.vtp", broken);
    tipp::test::expectIOError(path, "VTK", [&]() { readPoints(path); });
  }
}

TEST_F(DataSetPoints, FileOfAnotherKindIsReported)
{
  const std::string path = this->Folder.path("points.vtu");
  write<vtkXMLPolyDataWriter>(path, triangle());
  tipp::test::expectIOError(path, "VTK", [&]() { readPoints(path); });
}

TEST_F(DataSetPoints, MissingFileIsReported)
{
  const std::string path = this->Folder.path("absent.vtp");
  tipp::test::expectIOError(path, "check the name", [&]() { readPoints(path); });
}

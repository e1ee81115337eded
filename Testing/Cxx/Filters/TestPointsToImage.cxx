// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPPointsToImage.h"

#include "vtkRangeResampleFilter.h"
#include "vtkTIPPDelaunay2D.h"

#include "Arrays/Random.h"
#include "Delaunay2DTesting.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace
{

/// Random points in a square of side 100, with an array 'a' of the values 3 x.
vtkSmartPointer<vtkPolyData> makePoints(int count)
{
  tipp::Random random(3);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> values;
  values->SetName("a");
  for (int i = 0; i < count; ++i)
  {
    const double x = 100 * random.uniform();
    const double y = 100 * random.uniform();
    points->InsertNextPoint(x, y, std::sin(x / 7) + y / 9);
    values->InsertNextValue(3 * x);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->GetPointData()->AddArray(values);
  return data;
}

vtkSmartPointer<vtkPolyData> makeLine(
  std::initializer_list<std::array<double, 3>> corners, bool isPolygon)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(int(corners.size()));
  for (const auto& corner : corners)
  {
    cells->InsertCellPoint(points->InsertNextPoint(corner.data()));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  isPolygon ? data->SetPolys(cells) : data->SetLines(cells);
  return data;
}

std::vector<double> valuesOf(vtkImageData* image, const char* name)
{
  vtkDataArray* const array = image->GetPointData()->GetArray(name);
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    const double value = array->GetComponent(i, 0);
    values.push_back(std::isnan(value) ? -1e300 : value); // NaN would not compare equal
  }
  return values;
}

TEST(PointsToImage, IsTheSurfaceOfTheTriangulation)
{
  const auto points = makePoints(3000);
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->SetInputData(points);
  maker->SetResolution(0.5);
  maker->AddBand("a");
  maker->Update();
  vtkImageData* const image = maker->GetOutput();
  int size[3];
  image->GetDimensions(size);
  EXPECT_EQ(200, size[0]);
  EXPECT_EQ(200, size[1]);
  EXPECT_EQ(1, size[2]);
  EXPECT_EQ(0.25, image->GetOrigin()[0]);
  EXPECT_EQ(0.5, image->GetSpacing()[1]);
  vtkDataArray* const transform = image->GetFieldData()->GetArray("GeoTransform");
  ASSERT_NE(nullptr, transform);
  EXPECT_EQ(100, transform->GetComponent(3, 0));
  EXPECT_EQ(-0.5, transform->GetComponent(5, 0));

  vtkNew<vtkTIPPDelaunay2D> delaunay;
  delaunay->SetInputData(points);
  vtkNew<vtkRangeResampleFilter> sampler;
  sampler->SetInputConnection(delaunay->GetOutputPort());
  sampler->UseInputBoundsOff();
  sampler->SetSamplingBounds(0.25, 99.9, 0.25, 99.9, 0, 0);
  sampler->SetDelta(0.5, 0.5, 0);
  sampler->SetSamplingDimensions(1, 1, 1);
  sampler->SetNullValue(std::numeric_limits<double>::quiet_NaN());
  sampler->Update();
  EXPECT_EQ(valuesOf(sampler->GetOutput(), "elevation"), valuesOf(image, "elevation"));
  EXPECT_EQ(valuesOf(sampler->GetOutput(), "a"), valuesOf(image, "a"));
  EXPECT_EQ(40000U, valuesOf(image, "a").size());
}

TEST(PointsToImage, CentresOnTheBorderHaveValuesAtDecimalResolutions)
{
  vtkNew<vtkPoints> corners;
  corners->SetDataTypeToDouble();
  for (const double x : { 0.05, 1.15 }) // no double is exactly 0.1
  {
    corners->InsertNextPoint(x, 0.05, 1);
    corners->InsertNextPoint(x, 1.15, 1);
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(corners);
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->SetInputData(points);
  maker->SetResolution(0.1);
  maker->Update();
  EXPECT_EQ(std::vector<double>(144, 1), valuesOf(maker->GetOutput(), "elevation"));
  EXPECT_EQ(0.05, maker->GetOutput()->GetOrigin()[0]);
  EXPECT_EQ(1.2, maker->GetOutput()->GetFieldData()->GetArray("GeoTransform")->GetComponent(3, 0));
}

TEST(PointsToImage, SetBandReplacesAllBands)
{
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->AddBand("slope");
  maker->SetBand(maker->GetBand(1));
  ASSERT_EQ(1, maker->GetNumberOfBands());
  EXPECT_STREQ("slope", maker->GetBand(0));
  maker->SetBand(nullptr);
  EXPECT_EQ(0, maker->GetNumberOfBands());
}

TEST(PointsToImage, ThereIsNoBandOutsideOfTheList)
{
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->AddBand("");
  EXPECT_EQ(nullptr, maker->GetBand(-1));
  EXPECT_STREQ("elevation", maker->GetBand(0));
  EXPECT_EQ(nullptr, maker->GetBand(1));
}

TEST(PointsToImage, EqualPropertiesDoNotModifyIt)
{
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->SetBoundaryFileName("coast.gpkg");
  const vtkMTimeType before = maker->GetMTime();
  maker->SetBoundaryFileName("coast.gpkg");
  maker->SetBand("elevation");
  EXPECT_EQ(before, maker->GetMTime());
  maker->SetBoundaryFileName("");
  EXPECT_LT(before, maker->GetMTime());
  EXPECT_EQ(nullptr, maker->GetBoundaryFileName());
}

TEST(PointsToImage, IsTheSameWithinAMemoryLimit)
{
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->SetInputData(makePoints(30000));
  maker->SetResolution(0.3);
  maker->SetMaximumEdgeLength(2);
  maker->AddBand("slope");
  maker->Update();
  const std::vector<double> slopes = valuesOf(maker->GetOutput(), "slope");
  const std::vector<double> heights = valuesOf(maker->GetOutput(), "elevation");
  maker->SetMemoryLimit(2 << 20);
  maker->SetNumberOfThreads(2);
  maker->Update();
  EXPECT_EQ(slopes, valuesOf(maker->GetOutput(), "slope"));
  EXPECT_EQ(heights, valuesOf(maker->GetOutput(), "elevation"));
  EXPECT_FALSE(slopes.empty());
}

TEST(PointsToImage, HasAboutOnePixelPerPointByDefault)
{
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->SetInputData(makePoints(2500));
  maker->Update();
  int size[3];
  maker->GetOutput()->GetDimensions(size);
  EXPECT_NEAR(50, size[0], 2);
  EXPECT_NEAR(50, size[1], 2);
}

TEST(PointsToImage, BreaklinesShapeTheSurfaceAndABoundaryLimitsIt)
{
  vtkNew<vtkPoints> corners;
  for (const double x : { 0.0, 10.0 })
  {
    corners->InsertNextPoint(x, 0, 10);
    corners->InsertNextPoint(x, 10, 10);
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(corners);
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->SetInputData(points);
  maker->SetResolution(1);
  maker->SetBreaklinesData(makeLine({ { 5, 0, 2 }, { 5, 10, 2 } }, false));
  maker->Update();
  const std::vector<double> valley = valuesOf(maker->GetOutput(), "elevation");
  ASSERT_EQ(100U, valley.size());
  EXPECT_NEAR(2.8, valley[4], 1e-12); // the pixel at x = 4.5
  EXPECT_NEAR(2.8, valley[55], 1e-12);
  EXPECT_NEAR(9.2, valley[0], 1e-12);
  maker->SetBoundaryData(makeLine({ { 2, 2, 0 }, { 8, 2, 0 }, { 8, 8, 0 }, { 2, 8, 0 } }, true));
  maker->Update();
  const std::vector<double> cut = valuesOf(maker->GetOutput(), "elevation");
  EXPECT_EQ(-1e300, cut[11]);
  // Corners of a boundary get their elevation from the points alone: 10 at x = 8. The line has 2.
  EXPECT_NEAR(2 + 8 * 0.5 / 3, cut[55], 1e-12);
}

TEST(PointsToImage, ThinsAndMergesPoints)
{
  vtkNew<vtkPoints> positions;
  for (const std::array<double, 3>& p : { std::array<double, 3>{ 0, 0, 1 }, { 4, 0, 1 },
         { 0, 4, 1 }, { 4, 4, 1 }, { 2, 2, 5 }, { 2, 2, 9 }, { 2.25, 2.25, 3 } })
  {
    positions->InsertNextPoint(p.data());
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(positions);
  vtkNew<vtkTIPPPointsToImage> maker;
  maker->SetInputData(points);
  maker->SetResolution(0.1);
  maker->UseInputBoundsOff();
  maker->AlignToResolutionOff();
  maker->SetSamplingBounds(1.95, 2.05, 1.95, 2.05);
  maker->SetDuplicates(vtkTIPPPointsToImage::DUPLICATES_HIGHEST);
  maker->Update();
  EXPECT_NEAR(9, valuesOf(maker->GetOutput(), "elevation").at(0), 1e-9);
  maker->SetDuplicates(vtkTIPPPointsToImage::DUPLICATES_MEAN);
  maker->Update();
  EXPECT_NEAR(7, valuesOf(maker->GetOutput(), "elevation").at(0), 1e-9);
  maker->SetThinningSize(1);
  maker->SetThinningRule(vtkTIPPPointsToImage::THIN_LOWEST);
  maker->Update();
  EXPECT_LT(valuesOf(maker->GetOutput(), "elevation").at(0), 3);
}

TEST(PointsToImage, ReportsErrors)
{
  vtkNew<vtkTIPPPointsToImage> maker;
  const testing_delaunay::Messages messages(maker);
  maker->SetInputData(makePoints(10));
  maker->AddBand("b");
  maker->Update();
  ASSERT_EQ(1U, messages.Errors.size());
  EXPECT_NE(std::string::npos, messages.Errors[0].find("no column 'b'")) << messages.Errors[0];
  EXPECT_EQ(0, maker->GetOutput()->GetNumberOfPoints());
}

} // namespace

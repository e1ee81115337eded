// SPDX-License-Identifier: BSD-3-Clause
#include "MessageCounter.h"
#include "RangeResampleTesting.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkPartitionedDataSet.h"
#include "vtkProbeFilter.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace
{

/// The warnings of an update.
std::string warningsOf(vtkRangeResampleFilter* filter)
{
  vtkNew<tipp::test::MessageCounter> warnings;
  const unsigned long tag = filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->Update();
  filter->RemoveObserver(tag);
  return warnings->Text;
}

template <typename Array>
void addArray(vtkFieldData* data, const char* name, vtkIdType tuples, int components = 1)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples; ++i)
  {
    for (int component = 0; component < components; ++component)
    {
      array->SetComponent(i, component, double(i % 50 + component));
    }
  }
  data->AddArray(array);
}

} // namespace

TEST(RangeResampleArrays, KeepTheirTypesComponentsAndNames)
{
  const auto grid = gridOf(jitteredScene(2, 6, 1));
  const vtkIdType points = grid->GetNumberOfPoints();
  addArray<vtkFloatArray>(grid->GetPointData(), "vector", points, 3);
  addArray<vtkIntArray>(grid->GetPointData(), "count", points);
  addArray<vtkUnsignedCharArray>(grid->GetCellData(), "colour", grid->GetNumberOfCells(), 4);
  addArray<vtkSOADataArrayTemplate<double>>(grid->GetPointData(), "parted", points, 2);
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(grid);
  filter->Update();
  vtkPointData* const data = filter->GetOutput()->GetPointData();
  EXPECT_EQ(data->GetNumberOfArrays(), 7);
  EXPECT_EQ(data->GetArray("vector")->GetDataType(), VTK_FLOAT);
  EXPECT_EQ(data->GetArray("vector")->GetNumberOfComponents(), 3);
  EXPECT_EQ(data->GetArray("count")->GetDataType(), VTK_INT);
  EXPECT_EQ(data->GetArray("colour")->GetNumberOfComponents(), 4);
  vtkDataArray* const parted = data->GetArray("parted");
  for (vtkIdType i = 0; i < parted->GetNumberOfTuples(); ++i)
  {
    EXPECT_NEAR(parted->GetComponent(i, 1), parted->GetComponent(i, 0) + 1, 1e-12);
  }
}

TEST(RangeResampleArrays, EqualVtkProbeFilter)
{
  const auto grid = gridOf(jitteredScene(3, 6, 1));
  const auto filter = unitFilter(3, 10);
  filter->SetSamplingBounds(0.013, 0.971, 0.017, 0.983, 0.011, 0.993);
  filter->SetInputData(grid);
  filter->Update();
  vtkNew<vtkImageData> image;
  image->SetDimensions(10, 10, 10);
  image->SetOrigin(filter->GetOutput()->GetOrigin());
  image->SetSpacing(filter->GetOutput()->GetSpacing());
  vtkNew<vtkProbeFilter> probe;
  probe->SetInputData(image);
  probe->SetSourceData(grid);
  probe->ComputeToleranceOff();
  probe->SetTolerance(1e-13);
  probe->Update();
  for (const char* name : { "linear", "vtkValidPointMask" })
  {
    vtkDataArray* const ours = filter->GetOutput()->GetPointData()->GetArray(name);
    vtkDataArray* const theirs = probe->GetOutput()->GetPointData()->GetArray(name);
    ASSERT_EQ(ours->GetNumberOfTuples(), theirs->GetNumberOfTuples());
    for (vtkIdType i = 0; i < ours->GetNumberOfTuples(); ++i)
    {
      ASSERT_NEAR(ours->GetTuple(i)[0], theirs->GetTuple(i)[0], 1e-4) << name << " " << i;
    }
  }
}

TEST(RangeResampleArrays, AreSelectedByName)
{
  const auto grid = gridOf(jitteredScene(2, 6, 1));
  addArray<vtkFloatArray>(grid->GetPointData(), "other", grid->GetNumberOfPoints());
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(grid);
  filter->GetPointDataArraySelection()->DisableArray("linear");
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("linear"), nullptr);
  EXPECT_NE(filter->GetOutput()->GetPointData()->GetArray("other"), nullptr);
}

TEST(RangeResampleArrays, ThatAreAbsentMakeAWarning)
{
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(gridOf(jitteredScene(2, 6, 1)));
  filter->GetPointDataArraySelection()->EnableArray("depth");
  vtkNew<tipp::test::MessageCounter> warnings;
  filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->Update();
  EXPECT_EQ(warnings->Count, 1);
  EXPECT_NE(warnings->Text.find("no point array 'depth'"), std::string::npos);
}

TEST(RangeResampleArrays, ThatAreNotNumbersMakeAWarning)
{
  const auto grid = gridOf(jitteredScene(2, 6, 1));
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  names->SetNumberOfValues(grid->GetNumberOfPoints());
  grid->GetPointData()->AddArray(names);
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(grid);
  vtkNew<tipp::test::MessageCounter> warnings;
  filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->Update();
  EXPECT_EQ(warnings->Count, 1);
  EXPECT_NE(warnings->Text.find("'names'"), std::string::npos);
}

TEST(RangeResampleArrays, AreNullAndBlankOutsideAllCells)
{
  const auto grid = gridOf(regularScene(2, 1));
  addArray<vtkUnsignedCharArray>(grid->GetCellData(), "byte", grid->GetNumberOfCells());
  const auto filter = unitFilter(2, 3);
  filter->SetSamplingBounds(0.5, 1.5, 0, 1, 0, 0);
  filter->SetInputData(grid);
  filter->SetNullValue(1e6);
  filter->Update();
  vtkImageData* const image = filter->GetOutput();
  EXPECT_EQ(image->GetPointData()->GetArray("linear")->GetTuple1(2), 1e6);
  EXPECT_EQ(image->GetPointData()->GetArray("byte")->GetTuple1(2), 255);
  EXPECT_TRUE(image->IsPointVisible(1));
  EXPECT_FALSE(image->IsPointVisible(2));
  EXPECT_TRUE(image->IsCellVisible(0));
  EXPECT_FALSE(image->IsCellVisible(1));
}

TEST(RangeResampleArrays, HideCellsWithNoDataOnRequest)
{
  const auto grid = gridOf(regularScene(2, 2));
  grid->GetPointData()->GetArray("linear")->SetTuple1(0, -99999);
  const auto filter = unitFilter(2, 5);
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 25);
  filter->UseNoDataValueOn();
  filter->Update();
  vtkDataArray* const samples = filter->GetOutput()->GetPointData()->GetArray("linear");
  EXPECT_FALSE(isValid(filter->GetOutput(), 0));
  EXPECT_EQ(samples->GetTuple1(6), 0); // inside the cells at the dry corner
  EXPECT_TRUE(isValid(filter->GetOutput(), 12));
  EXPECT_LT(linearError(filter->GetOutput(), 2), 1e-13);
}

TEST(RangeResampleArrays, OfIntegersCompareNoDataByValue)
{
  const auto grid = gridOf(regularScene(2, 2));
  addArray<vtkUnsignedCharArray>(grid->GetPointData(), "depth", grid->GetNumberOfPoints());
  vtkDataArray* const depth = grid->GetPointData()->GetArray("depth");
  depth->SetTuple1(0, 97); // -99999 modulo 256
  depth->SetTuple1(1, 255);
  const auto filter = unitFilter(2, 5);
  filter->SetInputData(grid);
  filter->UseNoDataValueOn();
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 25);
  filter->SetNoDataValue(255);
  filter->Update();
  EXPECT_LT(countValid(filter->GetOutput()), 25);
}

TEST(RangeResampleArrays, WithoutStandardLayoutSupportNoData)
{
  const auto grid = gridOf(regularScene(2, 2));
  addArray<vtkSOADataArrayTemplate<double>>(
    grid->GetPointData(), "parted", grid->GetNumberOfPoints(), 2);
  grid->GetPointData()->GetArray("parted")->SetComponent(0, 1, -99999);
  const auto filter = unitFilter(2, 5);
  filter->SetInputData(grid);
  filter->UseNoDataValueOn();
  filter->Update();
  EXPECT_FALSE(isValid(filter->GetOutput(), 0));
}

TEST(RangeResampleArrays, OfTooFewValuesAreRefusedByName)
{
  const auto refused = [](const std::function<void(vtkPointSet*)>& addTo)
  {
    const auto grid = gridOf(jitteredScene(2, 6, 1));
    addTo(grid);
    const auto filter = unitFilter(2, 9);
    filter->SetInputData(grid);
    vtkNew<tipp::test::MessageCounter> errors;
    filter->AddObserver(vtkCommand::ErrorEvent, errors);
    filter->Update();
    return errors->Text;
  };
  const std::string ofPoints =
    refused([](vtkPointSet* grid) { addArray<vtkDoubleArray>(grid->GetPointData(), "short", 3); });
  EXPECT_NE(ofPoints.find("'short' has 3 values for 49 points"), std::string::npos) << ofPoints;
  const std::string ofCells = refused(
    [](vtkPointSet* grid) { addArray<vtkUnsignedCharArray>(grid->GetCellData(), "few", 3); });
  EXPECT_NE(ofCells.find("'few' has 3 values for 72 cells"), std::string::npos) << ofCells;
}

TEST(RangeResampleArrays, OfEqualTypesWithDifferentNamesAreCombined)
{
  const auto first = gridOf(jitteredScene(2, 6, 1), 0, 2);
  const auto second = gridOf(jitteredScene(2, 6, 1), 1, 2);
  addArray<vtkIdTypeArray>(first->GetPointData(), "number", first->GetNumberOfPoints());
  addArray<vtkLongLongArray>(second->GetPointData(), "number", second->GetNumberOfPoints());
  vtkNew<vtkPartitionedDataSet> parts;
  parts->SetPartition(0, first);
  parts->SetPartition(1, second);
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(parts);
  filter->SetNullValue(-1);
  EXPECT_EQ(warningsOf(filter), "");
  EXPECT_GE(filter->GetOutput()->GetPointData()->GetArray("number")->GetRange()[0], 0);
}

TEST(RangeResampleArrays, FieldDataIsPassedUnlessTurnedOff)
{
  const auto grid = gridOf(jitteredScene(2, 4, 1));
  addArray<vtkDoubleArray>(grid->GetFieldData(), "TimeValue", 1);
  const auto filter = unitFilter(2, 3);
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_NE(filter->GetOutput()->GetFieldData()->GetArray("TimeValue"), nullptr);
  filter->PassFieldArraysOff();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetArray("TimeValue"), nullptr);
}

TEST(RangeResampleElevation, OfASurfaceIsSampled)
{
  Scene scene = jitteredScene(2, 6, 1);
  for (std::size_t i = 0; i < scene.Points.size(); i += 3)
  {
    scene.Points[i + 2] = 5 + scene.Points[i] - 3 * scene.Points[i + 1];
  }
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(gridOf(scene));
  filter->Update();
  vtkImageData* const image = filter->GetOutput();
  vtkDataArray* const samples = image->GetPointData()->GetArray("elevation");
  ASSERT_TRUE(samples);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double p[3];
    image->GetPoint(i, p);
    EXPECT_NEAR(5 + p[0] - 3 * p[1], samples->GetTuple1(i), 1e-12);
  }
  filter->SampleElevationOff();
  filter->Update();
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("elevation"));
}

TEST(RangeResampleElevation, IsLeftOutIfAnArrayHasItsName)
{
  Scene scene = jitteredScene(2, 6, 1);
  scene.Points[2] = 1;
  const auto grid = gridOf(scene);
  addArray<vtkIntArray>(grid->GetPointData(), "elevation", grid->GetNumberOfPoints());
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_TRUE(
    vtkIntArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetArray("elevation")));
}

TEST(RangeResampleElevation, OfAFlatSurfaceOrASolidIsLeftOut)
{
  for (const int dimension : { 2, 3 })
  {
    const auto filter = unitFilter(dimension, 9);
    filter->SetInputData(gridOf(jitteredScene(dimension, 4, 1)));
    filter->Update();
    EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("elevation")) << dimension;
  }
}

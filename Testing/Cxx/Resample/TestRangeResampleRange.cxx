// SPDX-License-Identifier: BSD-3-Clause
#include "MessageCounter.h"
#include "RangeResampleTesting.h"

#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <array>

namespace
{

std::string errorOf(vtkRangeResampleFilter* filter)
{
  vtkNew<tipp::test::MessageCounter> listener;
  filter->AddObserver(vtkCommand::ErrorEvent, listener);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  filter->Update();
  return listener->Text;
}

vtkSmartPointer<vtkUnstructuredGrid> square()
{
  return gridOf(jitteredScene(2, 8, 1));
}

} // namespace

TEST(RangeResampleRange, DimensionsReachFromBoundToBound)
{
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(square());
  filter->SetSamplingBounds(0.1, 0.9, 0.2, 0.6, 0, 0);
  filter->Update();
  double bounds[6];
  filter->GetOutput()->GetBounds(bounds);
  EXPECT_NEAR(bounds[0], 0.1, 1e-15);
  EXPECT_NEAR(bounds[1], 0.9, 1e-15);
  EXPECT_NEAR(bounds[3], 0.6, 1e-15);
  EXPECT_LE(bounds[1], 0.9);
}

TEST(RangeResampleRange, NoRoundingPutsTheLastSampleOutside)
{
  for (int n = 2; n < 400; ++n)
  {
    const auto filter = unitFilter(2, 2);
    filter->SetInputData(square());
    filter->SetSamplingDimensions(n, 2, 1);
    filter->Update();
    ASSERT_EQ(countValid(filter->GetOutput()), 2 * n);
  }
}

TEST(RangeResampleRange, StepsAreThoseOfTheWrittenNumbers)
{
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(square());
  filter->SetSamplingBounds(0.1, 0.7, 0.3, 0.6, 0, 0); // 0.6 / 0.1 is less than 6 in doubles
  filter->SetDelta(0.1, 0.1, 0);
  filter->Update();
  int dimensions[3];
  filter->GetOutput()->GetDimensions(dimensions);
  EXPECT_EQ(7, dimensions[0]);
  EXPECT_EQ(4, dimensions[1]);
}

TEST(RangeResampleRange, DeltaStepsFromTheMinimum)
{
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(square());
  filter->SetDelta(0.25, 0.3, 0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetDimensions()[0], 5);
  EXPECT_EQ(filter->GetOutput()->GetDimensions()[1], 4);
  EXPECT_EQ(filter->GetOutput()->GetSpacing()[1], 0.3);
  EXPECT_LT(linearError(filter->GetOutput(), 2), 1e-13);
}

TEST(RangeResampleRange, ZeroDimensionsKeepTheDistanceOfTheFirstAxis)
{
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputData(gridOf(jitteredScene(3, 4, 1)));
  filter->SetUseInputBounds(false);
  filter->SetSamplingBounds(0, 1, 0, 0.5, 0, 0.25);
  filter->SetSamplingDimensions(0, 11, 0);
  filter->Update();
  const int* const dimensions = filter->GetOutput()->GetDimensions();
  EXPECT_EQ(dimensions[0], 21);
  EXPECT_EQ(dimensions[1], 11);
  EXPECT_EQ(dimensions[2], 6);
}

TEST(RangeResampleRange, ZeroDimensionsGiveASurfaceOneSampleAlongZ)
{
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputData(square());
  filter->SetUseInputBounds(false);
  filter->SetSamplingBounds(0, 1, 0, 1, -3, 3);
  filter->SetSamplingDimensions(9, 0, 0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetDimensions()[2], 1);
  EXPECT_EQ(countValid(filter->GetOutput()), 81);
}

TEST(RangeResampleRange, AllDimensionsZeroAreAnError)
{
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputData(square());
  filter->SetSamplingDimensions(0, 0, 0);
  EXPECT_NE(errorOf(filter).find("SamplingDimensions have no number"), std::string::npos);
}

TEST(RangeResampleRange, ZeroDimensionsNeedTheWholeInput)
{
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputData(square());
  filter->SetNumberOfInputPieces(2);
  filter->SetUseInputBounds(false);
  filter->SetSamplingDimensions(9, 0, 0);
  EXPECT_NE(errorOf(filter).find("a number along every axis"), std::string::npos);
}

TEST(RangeResampleRange, InputBoundsAreTheDefault)
{
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputData(square());
  filter->SetSamplingDimensions(11, 11, 1);
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 121);
  filter->SetDelta(0.5, 0.5, 0);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 9);
}

TEST(RangeResampleRange, OutsideTheMeshAllSamplesAreMasked)
{
  const auto filter = unitFilter(2, 9);
  filter->SetInputData(square());
  filter->SetSamplingBounds(2, 3, 2, 3, 0, 0);
  filter->SetNullValue(-5);
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 0);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("linear")->GetTuple1(3), -5);
}

TEST(RangeResampleRange, ASampleALineAndAPlaneAreValidRanges)
{
  const auto filter = unitFilter(2, 1);
  filter->SetInputData(square());
  filter->SetSamplingBounds(0.5, 0.5, 0.5, 0.5, 0, 0);
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 1);
  filter->SetSamplingDimensions(50, 1, 1);
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 50);
  filter->SetSamplingBounds(0.5, 0.5, 0, 1, 0, 0);
  filter->SetSamplingDimensions(1, 50, 1);
  filter->Update();
  EXPECT_EQ(countValid(filter->GetOutput()), 50);
  EXPECT_LT(linearError(filter->GetOutput(), 2), 1e-13);
  const auto space = unitFilter(3, 7);
  space->SetInputData(gridOf(jitteredScene(3, 4, 1)));
  space->SetSamplingBounds(0, 1, 0.5, 0.5, 0, 1);
  space->SetSamplingDimensions(7, 1, 7);
  space->Update();
  EXPECT_EQ(countValid(space->GetOutput()), 49);
}

TEST(RangeResampleRange, AnEmptyMeshMakesAMaskedImage)
{
  const auto filter = unitFilter(2, 3);
  vtkNew<vtkUnstructuredGrid> empty;
  filter->SetInputData(empty);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 9);
  EXPECT_EQ(countValid(filter->GetOutput()), 0);
}

TEST(RangeResampleRange, InvalidRangesAreErrors)
{
  const auto filter = unitFilter(2, 3);
  filter->SetInputData(square());
  filter->SetSamplingBounds(1, 0, 0, 1, 0, 0);
  EXPECT_NE(errorOf(filter).find("lower one first"), std::string::npos);
  filter->SetSamplingBounds(-1e308, 1e308, 0, 1, 0, 0); // their difference overflows
  EXPECT_NE(errorOf(filter).find("give finite bounds"), std::string::npos);
  filter->SetSamplingBounds(0, 1, 0, 1, 0, 0);
  filter->SetSamplingDimensions(-1, 3, 1);
  EXPECT_NE(errorOf(filter).find("give 1 or more"), std::string::npos);
}

TEST(RangeResampleRange, TooManySamplesAreRefusedWithTheMemoryTheyNeed)
{
  const auto filter = unitFilter(2, 3);
  filter->SetInputData(square());
  filter->SetSamplingDimensions(1000000, 1000000, 1);
  const std::string text = errorOf(filter);
  EXPECT_NE(text.find("1000000000000 samples need at least 15000.0 GB"), std::string::npos) << text;
}

TEST(RangeResampleRange, SubExtentsArePartsOfTheWhole)
{
  const auto filter = unitFilter(2, 20);
  filter->SetInputData(square());
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  const int extent[6] = { 3, 12, 5, 19, 0, 0 };
  filter->Modified();
  filter->UpdateExtent(extent);
  vtkImageData* const part = filter->GetOutput();
  EXPECT_EQ(part->GetNumberOfPoints(), 150);
  for (int y = 5; y < 20; ++y)
  {
    for (int x = 3; x < 13; ++x)
    {
      EXPECT_EQ(part->GetPointData()->GetArray("linear")->GetTuple1((y - 5) * 10 + x - 3),
        whole->GetPointData()->GetArray("linear")->GetTuple1(y * 20 + x));
    }
  }
}

TEST(RangeResampleRange, PiecesTileTheWhole)
{
  const auto filter = unitFilter(2, 20);
  filter->SetInputData(square());
  vtkIdType samples = 0;
  for (int piece = 0; piece < 4; ++piece)
  {
    filter->Modified();
    filter->UpdatePiece(piece, 4, 0);
    samples += filter->GetOutput()->GetNumberOfCells();
  }
  EXPECT_EQ(samples, 19 * 19);
}

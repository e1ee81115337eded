// SPDX-License-Identifier: BSD-3-Clause
#include "MessageCounter.h"
#include "PieceSource.h"
#include "Pipeline/FilterPipeline.h"
#include "RangeResampleTesting.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkPartitionedDataSet.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

TEST(RangeResampleRun, ReadsPieceByPieceTheSameImage)
{
  for (const bool hasHeights : { false, true })
  {
    Scene scene = jitteredScene(2, 12, 3);
    scene.Points.back() = hasHeights ? 1 : 0;
    const auto filter = unitFilter(2, 33);
    filter->SetInputData(gridOf(scene));
    filter->Update();
    vtkNew<vtkImageData> whole;
    whole->DeepCopy(filter->GetOutput());
    EXPECT_EQ(hasHeights, whole->GetPointData()->HasArray("elevation"));
    for (const int pieces : { 1, 2, 7, 64 })
    {
      vtkNew<PieceSource> source;
      source->Cells = scene;
      filter->SetInputConnection(source->GetOutputPort());
      filter->SetNumberOfInputPieces(pieces);
      filter->Update();
      EXPECT_EQ(source->Requests, pieces);
      EXPECT_TRUE(sameArrays(whole, filter->GetOutput())) << pieces;
      EXPECT_EQ(statistic(filter, "Cells"), scene.cells());
    }
  }
}

TEST(RangeResampleRun, FailsIfAPieceFailsAndThenWorksAgain)
{
  const Scene scene = jitteredScene(2, 12, 3);
  vtkNew<PieceSource> source;
  source->Cells = scene;
  const auto filter = unitFilter(2, 33);
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetNumberOfInputPieces(4);
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  source->FailingPiece = 2;
  source->Modified();
  vtkNew<tipp::test::MessageCounter> errors;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  source->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->Update();
  EXPECT_NE(errors->Text.find("has not made its piece 2"), std::string::npos) << errors->Text;
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  source->FailingPiece = -1;
  source->Requests = 0;
  source->Modified();
  filter->Update();
  EXPECT_EQ(source->Requests, 4);
  EXPECT_TRUE(sameArrays(whole, filter->GetOutput()));
}

TEST(RangeResampleRun, ProgressCoversAllMeshesAndPieces)
{
  vtkNew<vtkPartitionedDataSet> parts;
  for (unsigned i = 0; i < 4; ++i)
  {
    parts->SetPartition(i, gridOf(jitteredScene(2, 12, 3), int(i), 4));
  }
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(parts);
  filter->SetNumberOfInputPieces(2);
  std::vector<double> steps;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&steps);
  note->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      static_cast<std::vector<double>*>(data)->push_back(
        static_cast<vtkAlgorithm*>(caller)->GetProgress());
    });
  filter->AddObserver(vtkCommand::ProgressEvent, note);
  filter->Update();
  for (const double of : { 1 / 8.0, 3 / 8.0, 7 / 8.0 })
  {
    const double expected = of * 0.95; // the last 5 % are for the output
    EXPECT_TRUE(std::any_of(
      steps.begin(), steps.end(), [&](double step) { return std::fabs(step - expected) < 1e-12; }))
      << of;
  }
}

TEST(RangeResampleRun, UpdatesItsInputAtTheRequestedTime)
{
  vtkNew<PieceSource> source;
  source->Cells = jitteredScene(2, 4, 3);
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkInformation> asked;
  asked->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 3.0);
  EXPECT_EQ(tipp::updatedInput(filter, 0, 1, asked), source->GetOutputDataObject(0));
  EXPECT_EQ(source->Requests, 1);
  EXPECT_EQ(source->Time, 3.0);
}

TEST(RangeResampleRun, MakesTheSameBitsOnAnyNumberOfThreads)
{
  for (const Scene& scene : { jitteredScene(2, 40, 3), jitteredScene(3, 8, 3) })
  {
    const auto filter = unitFilter(scene.Dimension, 40);
    filter->SetInputData(gridOf(scene));
    filter->SetNumberOfThreads(1);
    filter->Update();
    vtkNew<vtkImageData> one;
    one->DeepCopy(filter->GetOutput());
    for (int threads = 2; threads <= 4; ++threads)
    {
      filter->SetNumberOfThreads(threads);
      filter->SetInputData(gridOf(scene.shuffled(unsigned(threads))));
      filter->Update();
      EXPECT_TRUE(sameArrays(one, filter->GetOutput()));
    }
  }
}

TEST(RangeResampleRun, HasStatistics)
{
  const auto filter = unitFilter(2, 17);
  filter->SetInputData(gridOf(regularScene(2, 8)));
  filter->SetDevice(vtkRangeResampleFilter::DEVICE_OPENMP);
  filter->SetNumberOfThreads(2);
  filter->Update();
  EXPECT_EQ(statistic(filter, "Cells"), 128);
  EXPECT_EQ(statistic(filter, "Samples"), 289);
  EXPECT_EQ(statistic(filter, "SamplesHit"), 289);
  EXPECT_EQ(statistic(filter, "OverlappingClaims"), 0);
  EXPECT_EQ(statistic(filter, "Threads"), 2);
  EXPECT_GT(statistic(filter, "ExactTests"), 0);
  EXPECT_EQ(statistic(filter, "VisitedCells"), 128);
  EXPECT_EQ(statistic(filter, "Tests"), 128 * 9); // each box has 3 x 3 samples
  vtkFieldData* const figures = filter->GetStatistics()->GetFieldData();
  ASSERT_EQ(figures->GetAbstractArray("PhaseName")->GetNumberOfValues(), 6);
  for (const int phase : { 0, 1, 2, 5 }) // no exchange, and no device
  {
    EXPECT_GT(figures->GetArray("PhaseSeconds")->GetTuple1(phase), 0)
      << figures->GetAbstractArray("PhaseName")->GetVariantValue(phase).ToString();
  }
}

TEST(RangeResampleRun, ReportsProgressAndStops)
{
  const auto filter = unitFilter(2, 200);
  filter->SetInputData(gridOf(jitteredScene(2, 100, 1)));
  int calls = 0;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetClientData(&calls);
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      ++*static_cast<int*>(data);
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    });
  filter->AddObserver(vtkCommand::ProgressEvent, stop);
  filter->Update();
  EXPECT_GT(calls, 0);
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("linear"), nullptr);
}

TEST(RangeResampleRun, PrintsItsProperties)
{
  std::ostringstream text;
  unitFilter(2, 5)->Print(text);
  EXPECT_NE(text.str().find("SamplingDimensions: 5 5 1"), std::string::npos);
}

TEST(RangeResampleRun, ADeviceChoiceSetsTheThreeProperties)
{
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetDeviceChoice("opencl:Fast GPU");
  EXPECT_EQ(filter->GetDevice(), vtkRangeResampleFilter::DEVICE_OPENCL);
  EXPECT_STREQ(filter->GetDeviceName(), "Fast GPU");
  filter->SetDeviceChoice("opencl:3");
  EXPECT_EQ(filter->GetDeviceIndex(), 3);
  EXPECT_EQ(filter->GetDeviceName(), nullptr);
  filter->SetDeviceChoice("openmp");
  EXPECT_EQ(filter->GetDevice(), vtkRangeResampleFilter::DEVICE_OPENMP);
}

TEST(RangeResampleRun, ADeviceThatNoNameMatchesIsAnError)
{
  const auto filter = unitFilter(2, 5);
  filter->SetInputData(gridOf(regularScene(2, 2)));
  filter->SetDeviceChoice("opencl:no such device");
  vtkNew<tipp::test::MessageCounter> errors;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->Update();
  EXPECT_NE(
    errors->Text.find("There is no OpenCL device named 'no such device'"), std::string::npos)
    << errors->Text;
}

TEST(RangeResampleRun, TheFirstDeviceChoicesNeedNoDevice)
{
  vtkNew<vtkRangeResampleFilter> filter;
  EXPECT_EQ(filter->GetDeviceChoices()->GetValue(0), "auto");
  EXPECT_EQ(filter->GetDeviceChoices()->GetValue(1), "openmp");
}

// SPDX-License-Identifier: BSD-3-Clause
#include "RangeResampleTesting.h"
#include "Resample/UpdatedInput.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGridAlgorithm.h"

#include <gtest/gtest.h>

#include <sstream>

namespace
{

/// Gives the cells of a scene by piece: each nth cell.
class PieceSource : public vtkUnstructuredGridAlgorithm
{
public:
  static PieceSource* New() { VTK_STANDARD_NEW_BODY(PieceSource); }
  Scene Cells;
  int Requests = 0;
  double Time = 0; ///< of the last request

protected:
  PieceSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* const info = outputs->GetInformationObject(0);
    info->Set(CAN_HANDLE_PIECE_REQUEST(), 1);
    const double times[] = { 0, 3 };
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* const info = outputs->GetInformationObject(0);
    this->Time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    const int piece = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
    const int pieces = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES());
    ++this->Requests;
    vtkUnstructuredGrid::GetData(outputs)->ShallowCopy(gridOf(this->Cells, piece, pieces));
    return 1;
  }
};

} // namespace

TEST(RangeResampleRun, ReadsPieceByPieceTheSameImage)
{
  const Scene scene = jitteredScene(2, 12, 3);
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(gridOf(scene));
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
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

TEST(RangeResampleRun, UpdatesItsInputAtTheTimeThatIsAskedFor)
{
  vtkNew<PieceSource> source;
  source->Cells = jitteredScene(2, 4, 3);
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkInformation> asked;
  asked->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 3.0);
  EXPECT_EQ(tipp::updatedInput(filter, nullptr, asked), source->GetOutputDataObject(0));
  EXPECT_EQ(source->Requests, 1);
  EXPECT_EQ(source->Time, 3.0);
}

TEST(RangeResampleRun, GivesTheSameBitsOnAnyThreads)
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

TEST(RangeResampleRun, TellsWhatItDid)
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

TEST(RangeResampleRun, TheFirstDeviceChoicesNeedNoDevice)
{
  vtkNew<vtkRangeResampleFilter> filter;
  EXPECT_EQ(filter->GetDeviceChoices()->GetValue(0), "auto");
  EXPECT_EQ(filter->GetDeviceChoices()->GetValue(1), "openmp");
}

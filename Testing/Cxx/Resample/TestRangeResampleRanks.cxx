// SPDX-License-Identifier: BSD-3-Clause
#include "MessageCounter.h"
#include "PieceSource.h"
#include "RangeResampleTesting.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkMultiProcessController.h"
#include "vtkPartitionedDataSet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}

/// This rank's cells of a scene: each n-th cell for n ranks, or none.
vtkSmartPointer<vtkUnstructuredGrid> share(const Scene& scene, bool empty = false)
{
  const int rank = controller()->GetLocalProcessId();
  return gridOf(scene, empty ? scene.cells() : rank, controller()->GetNumberOfProcesses());
}

/// The image of the whole scene, made by this rank alone.
vtkSmartPointer<vtkImageData> alone(const Scene& scene, int n)
{
  const auto filter = unitFilter(scene.Dimension, n);
  filter->SetController(nullptr);
  filter->SetInputData(gridOf(scene));
  filter->Update();
  return filter->GetOutput();
}

/// Updates the filter, and returns the errors of the filter and its pipeline.
std::string errorsOf(vtkRangeResampleFilter* filter)
{
  vtkNew<tipp::test::MessageCounter> errors;
  vtkNew<tipp::test::MessageCounter> others;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, others);
  filter->GetInputAlgorithm()->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, others);
  filter->Update();
  return errors->Text;
}

} // namespace

TEST(RangeResampleRanks, EachGetsTheWholeImageIfItAsksForIt)
{
  for (const Scene& scene :
    { jitteredScene(2, 12, 3), jitteredScene(3, 5, 3), overlappingScene(40, 1) })
  {
    const auto filter = unitFilter(scene.Dimension, 33);
    filter->SetInputData(share(scene));
    filter->Update();
    EXPECT_TRUE(sameArrays(alone(scene, 33), filter->GetOutput())) << scene.Name;
  }
}

TEST(RangeResampleRanks, EachGetsItsExtentOfTheImage)
{
  const Scene scene = jitteredScene(2, 12, 3);
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(share(scene));
  filter->UpdatePiece(controller()->GetLocalProcessId(), controller()->GetNumberOfProcesses(), 0);
  const auto whole = alone(scene, 33);
  vtkImageData* const part = filter->GetOutput();
  int extent[6];
  part->GetExtent(extent);
  vtkIdType i = 0;
  for (int y = extent[2]; y <= extent[3]; ++y)
  {
    for (int x = extent[0]; x <= extent[1]; ++x, ++i)
    {
      EXPECT_EQ(part->GetPointData()->GetArray("linear")->GetTuple1(i),
        whole->GetPointData()->GetArray("linear")->GetTuple1(33 * y + x));
    }
  }
  EXPECT_EQ(i, part->GetNumberOfPoints());
}

TEST(RangeResampleRanks, TheFirstGetsAllOnRequest)
{
  const Scene scene = jitteredScene(2, 12, 3);
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(share(scene));
  filter->GatherOnRootOn();
  filter->Update();
  if (controller()->GetLocalProcessId() == 0)
  {
    EXPECT_TRUE(sameArrays(alone(scene, 33), filter->GetOutput()));
  }
  else
  {
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  }
}

TEST(RangeResampleRanks, InputBoundsAreThoseOfAllRanks)
{
  const Scene scene = jitteredScene(2, 12, 3);
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetSamplingDimensions(33, 33, 1);
  filter->SetInputData(share(scene));
  filter->Update();
  EXPECT_TRUE(sameArrays(alone(scene, 33), filter->GetOutput()));
}

TEST(RangeResampleRanks, WithInputBoundsAndDeltaEachRankReadsItsShareOnce)
{
  vtkNew<PieceSource> source;
  source->Cells = jitteredScene(2, 12, 3);
  vtkNew<vtkRangeResampleFilter> filter;
  filter->SetDelta(1 / 32.0, 1 / 32.0, 1);
  filter->SetInputConnection(source->GetOutputPort());
  filter->Update();
  EXPECT_EQ(source->Requests, 1);
  EXPECT_TRUE(sameArrays(alone(source->Cells, 33), filter->GetOutput()));
}

TEST(RangeResampleRanks, RanksWithoutCellsOrArraysTakePart)
{
  Scene scene = jitteredScene(2, 12, 3);
  scene.Points.back() = 1; // z is not 0, which only the last rank knows
  const int last = controller()->GetNumberOfProcesses() - 1;
  const auto filter = unitFilter(2, 33);
  vtkNew<vtkUnstructuredGrid> empty;
  const bool all = controller()->GetLocalProcessId() == last;
  filter->SetInputData(all ? gridOf(scene).Get() : empty.Get());
  filter->Update();
  EXPECT_TRUE(sameArrays(alone(scene, 33), filter->GetOutput()));
}

TEST(RangeResampleRanks, ARankOutsideTheRangeContributesItsArrays)
{
  const auto grid = gridOf(jitteredScene(2, 4, 3));
  const int rank = controller()->GetLocalProcessId();
  const int last = controller()->GetNumberOfProcesses() - 1;
  if (rank == last && last > 0)
  {
    grid->GetPointData()->GetArray("linear")->SetName("far");
    vtkPoints* const points = grid->GetPoints();
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      const double* const p = points->GetPoint(i);
      points->SetPoint(i, p[0] + 100, p[1], p[2]);
    }
  }
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(grid);
  filter->SetNullValue(7);
  filter->Update();
  vtkDataArray* const far = filter->GetOutput()->GetPointData()->GetArray("far");
  ASSERT_EQ(far != nullptr, last > 0);
  EXPECT_TRUE(!far || far->GetTuple1(16) == 7);
}

TEST(RangeResampleRanks, ArraysThatDifferInTypeAreNullWithAWarning)
{
  const auto grid = share(jitteredScene(2, 12, 3));
  const int rank = controller()->GetLocalProcessId();
  vtkNew<vtkFloatArray> single;
  vtkNew<vtkDoubleArray> wide;
  vtkDataArray* const mixed = rank == 0 ? static_cast<vtkDataArray*>(single) : wide;
  mixed->SetName("mixed");
  mixed->SetNumberOfTuples(grid->GetNumberOfPoints());
  mixed->Fill(1);
  mixed->SetComponentName(0, "depth");
  grid->GetPointData()->AddArray(mixed);
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(grid);
  vtkNew<tipp::test::MessageCounter> warnings;
  filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->Update();
  const bool several = controller()->GetNumberOfProcesses() > 1;
  EXPECT_EQ(warnings->Text.find("'mixed' differs in type") != std::string::npos, several);
  vtkDataArray* const made = filter->GetOutput()->GetPointData()->GetArray("mixed");
  EXPECT_EQ(made->GetDataType(), VTK_FLOAT);
  EXPECT_STREQ(made->GetComponentName(0), "depth");
  EXPECT_EQ(made->GetRange()[0], several ? 0 : 1);
}

TEST(RangeResampleRanks, ANameForPointAndCellArraysMakesAWarning)
{
  const auto grid = share(jitteredScene(2, 12, 3));
  const bool ofPoints = controller()->GetLocalProcessId() == 0;
  vtkNew<vtkDoubleArray> array;
  array->SetName("both");
  array->SetNumberOfTuples(ofPoints ? grid->GetNumberOfPoints() : grid->GetNumberOfCells());
  array->Fill(1);
  if (ofPoints)
  {
    grid->GetPointData()->AddArray(array);
  }
  else
  {
    grid->GetCellData()->AddArray(array);
  }
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(grid);
  vtkNew<tipp::test::MessageCounter> warnings;
  filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->Update();
  const bool several = controller()->GetNumberOfProcesses() > 1;
  EXPECT_EQ(warnings->Text.find("a cell array 'both'") != std::string::npos, several);
}

TEST(RangeResampleRanks, ALeafThatIsNoMeshOnOneEndsAll)
{
  const bool fails = controller()->GetLocalProcessId() == 0;
  vtkNew<vtkPartitionedDataSet> parts;
  parts->SetPartition(0, share(jitteredScene(2, 4, 3)));
  if (fails)
  {
    vtkNew<vtkImageData> image;
    parts->SetPartition(1, image);
  }
  for (const double delta : { 0.0, 0.1 })
  {
    vtkNew<vtkRangeResampleFilter> filter; // samples the bounds of all ranks' inputs
    filter->SetDelta(delta, delta, delta);
    filter->SetInputData(parts);
    const std::string text = errorsOf(filter);
    EXPECT_NE(text.find("a vtkImageData is no mesh"), std::string::npos) << text;
    EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  }
}

TEST(RangeResampleRanks, APieceThatFailsOnOneEndsAll)
{
  vtkNew<PieceSource> source;
  source->Cells = jitteredScene(2, 12, 3);
  source->FailingPiece = 1; // the first rank has three pieces
  const auto filter = unitFilter(2, 33);
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetNumberOfInputPieces(3);
  const std::string text = errorsOf(filter);
  EXPECT_NE(text.find("has not made its piece 1"), std::string::npos) << text;
}

TEST(RangeResampleRanks, StoppingOneStopsAll)
{
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(share(jitteredScene(2, 12, 3)));
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  if (controller()->GetLocalProcessId() == 0)
  {
    filter->AddObserver(vtkCommand::ProgressEvent, stop);
  }
  EXPECT_EQ(errorsOf(filter), "");
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
}

TEST(RangeResampleRanks, AFailureOnOneEndsAll)
{
  const auto filter = unitFilter(2, 33);
  const bool fails = controller()->GetLocalProcessId() == 0;
  filter->SetInputData(share(jitteredScene(2, 4, 3)));
  filter->SetSamplingDimensions(fails ? 1 << 20 : 33, fails ? 1 << 20 : 33, 1);
  EXPECT_NE(errorsOf(filter).find("GB of memory"), std::string::npos); // on all ranks
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("linear"), nullptr);
}

TEST(RangeResampleRanks, TheFirstCountsCellsThatAreNotFiniteOnAllRanks)
{
  const auto grid = share(jitteredScene(2, 4, 1));
  grid->GetPoints()->SetPoint(12, std::nan(""), 0.5, 0);
  vtkNew<vtkIdList> ids;
  std::int64_t mine = 0;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    grid->GetCellPoints(cell, ids);
    mine += ids->IsId(12) >= 0 ? 1 : 0;
  }
  std::int64_t all = 0;
  controller()->AllReduce(&mine, &all, 1, vtkCommunicator::SUM_OP);
  const auto filter = unitFilter(2, 33);
  filter->SetInputData(grid);
  vtkNew<tipp::test::MessageCounter> warnings;
  filter->AddObserver(vtkCommand::WarningEvent, warnings);
  filter->Update();
  const std::string expected = controller()->GetLocalProcessId() == 0
    ? std::to_string(all) + " cells have a corner with a NaN or infinite coordinate"
    : "";
  EXPECT_NE(warnings->Text.find(expected), std::string::npos) << warnings->Text;
  EXPECT_EQ(warnings->Count, controller()->GetLocalProcessId() == 0 ? 1 : 0);
}

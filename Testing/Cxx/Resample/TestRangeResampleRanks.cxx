// SPDX-License-Identifier: BSD-3-Clause
#include "RangeResampleTesting.h"

#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

namespace
{

vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}

/// This rank's cells of a scene: every nth, or none.
vtkSmartPointer<vtkUnstructuredGrid> share(const Scene& scene, bool empty = false)
{
  const int rank = controller()->GetLocalProcessId();
  return gridOf(scene, empty ? scene.cells() : rank, controller()->GetNumberOfProcesses());
}

/// What one process makes of the whole scene.
vtkSmartPointer<vtkImageData> alone(const Scene& scene, int n)
{
  const auto filter = unitFilter(scene.Dimension, n);
  filter->SetController(nullptr);
  filter->SetInputData(gridOf(scene));
  filter->Update();
  return filter->GetOutput();
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

TEST(RangeResampleRanks, RanksWithoutCellsOrArraysTakePart)
{
  const Scene scene = jitteredScene(2, 12, 3);
  const int last = controller()->GetNumberOfProcesses() - 1;
  const auto filter = unitFilter(2, 33);
  vtkNew<vtkUnstructuredGrid> empty;
  const bool all = controller()->GetLocalProcessId() == last;
  filter->SetInputData(all ? gridOf(scene).Get() : empty.Get());
  filter->Update();
  EXPECT_TRUE(sameArrays(alone(scene, 33), filter->GetOutput()));
}

TEST(RangeResampleRanks, AFailureOnOneEndsAll)
{
  const auto filter = unitFilter(2, 33);
  const bool fails = controller()->GetLocalProcessId() == 0;
  filter->SetInputData(share(jitteredScene(2, 4, 3)));
  filter->SetSamplingDimensions(fails ? 1 << 20 : 33, fails ? 1 << 20 : 33, 1);
  vtkObject::GlobalWarningDisplayOff();
  filter->Update();
  vtkObject::GlobalWarningDisplayOn();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("linear"), nullptr);
}

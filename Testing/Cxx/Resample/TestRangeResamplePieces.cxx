// SPDX-License-Identifier: BSD-3-Clause
#include "RangeResampleTesting.h"

#include "vtkPartitionedDataSet.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace
{

vtkSmartPointer<vtkPartitionedDataSet> partsOf(const std::vector<Scene>& tiles)
{
  auto parts = vtkSmartPointer<vtkPartitionedDataSet>::New();
  for (std::size_t i = 0; i < tiles.size(); ++i)
  {
    parts->SetPartition(unsigned(i), gridOf(tiles[i]));
  }
  return parts;
}

/// Expects the same image from the scene's tiles as from the whole scene.
void expectTheSame(const Scene& scene, int side, vtkRangeResampleFilter* filter)
{
  filter->SetInputData(gridOf(scene));
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  EXPECT_GT(countValid(whole), 0);
  for (const bool ownPoints : { false, true })
  {
    filter->SetInputData(partsOf(tilesOf(scene, side, ownPoints)));
    for (const int threads : { 1, 3 })
    {
      filter->SetNumberOfThreads(threads);
      filter->Update();
      EXPECT_TRUE(sameArrays(whole, filter->GetOutput())) << ownPoints << threads;
      EXPECT_EQ(statistic(filter, "Cells"), scene.cells());
    }
  }
}

} // namespace

TEST(RangeResamplePieces, GridOf16x16MakesTheImageOfOneMesh)
{
  // In the regular scene, samples fall on corners and edges that pieces share.
  for (const Scene& scene : { jitteredScene(2, 48, 3), regularScene(2, 48), fanScene(97) })
  {
    const auto filter = unitFilter(2, 97);
    filter->SetDevice(vtkRangeResampleFilter::DEVICE_OPENMP);
    expectTheSame(scene, 16, filter);
  }
}

TEST(RangeResamplePieces, ThatReachBeyondTheRangeMakeTheImageOfOneMesh)
{
  const auto filter = unitFilter(2, 61);
  filter->SetSamplingBounds(0.3, 0.55, 0.4, 1.2, 0, 0);
  expectTheSame(jitteredScene(2, 48, 3), 16, filter);
}

TEST(RangeResamplePieces, InSpaceMakeTheImageOfOneMesh)
{
  for (const Scene& scene : { jitteredScene(3, 8, 3), regularScene(3, 8) })
  {
    expectTheSame(scene, 4, unitFilter(3, 17));
  }
}

TEST(RangeResamplePieces, OfASurfaceAlongOtherAxesMakeTheImageOfOneMesh)
{
  const Scene flat = jitteredScene(2, 24, 3);
  const std::vector<Scene> tiles = tilesOf(flat, 8, true);
  const auto upright = [](Scene scene)
  {
    for (std::size_t i = 0; i < scene.Points.size(); i += 3)
    {
      std::swap(scene.Points[i + 1], scene.Points[i + 2]);
    }
    return scene;
  };
  const auto filter = unitFilter(2, 49);
  filter->SetSamplingBounds(0, 1, 0, 0, 0, 1);
  filter->SetSamplingDimensions(49, 1, 49);
  filter->SetInputData(gridOf(upright(flat)));
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  EXPECT_EQ(countValid(whole), 49 * 49);
  std::vector<Scene> parts;
  for (const Scene& tile : tiles)
  {
    parts.push_back(upright(tile));
  }
  filter->SetInputData(partsOf(parts));
  filter->Update();
  EXPECT_TRUE(sameArrays(whole, filter->GetOutput()));
}

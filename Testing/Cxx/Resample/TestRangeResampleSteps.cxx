// SPDX-License-Identifier: BSD-3-Clause
#include "PieceSource.h"
#include "RangeResampleTesting.h"

#include <gtest/gtest.h>

namespace
{

/// Resamples a scene without time steps.
vtkSmartPointer<vtkImageData> resampledAlone(const Scene& scene, int dimension)
{
  const auto filter = unitFilter(dimension, 33);
  filter->SetInputData(gridOf(scene));
  filter->Update();
  return filter->GetOutput();
}

} // namespace

TEST(RangeResampleSteps, GiveWhatEachMeshGivesAlone)
{
  for (const int dimension : { 2, 3 })
  {
    vtkNew<PieceSource> source;
    const auto filter = unitFilter(dimension, 33);
    filter->SetInputConnection(source->GetOutputPort());
    // The same mesh twice, then one with other points, and one with other cells.
    std::vector<Scene> scenes = { jitteredScene(dimension, 12, 3), jitteredScene(dimension, 12, 3),
      jitteredScene(dimension, 12, 4), jitteredScene(dimension, 12, 4) };
    scenes[3].Ids.resize(scenes[3].Ids.size() / 2 / 12 * 12);
    for (std::size_t step = 0; step < scenes.size(); ++step)
    {
      source->Cells = scenes[step];
      source->Modified();
      filter->UpdateTimeStep(step % 2 == 0 ? 0.0 : 3.0);
      EXPECT_TRUE(sameArrays(resampledAlone(scenes[step], dimension), filter->GetOutput()))
        << dimension << " " << step;
    }
    filter->SetSamplingDimensions(20, 20, dimension == 3 ? 20 : 1);
    filter->Update();
    const auto alone = unitFilter(dimension, 20);
    alone->SetInputData(gridOf(scenes[3]));
    alone->Update();
    EXPECT_TRUE(sameArrays(alone->GetOutput(), filter->GetOutput()));
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/SampleWindow.h"

#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace
{

/// The samples inside the bounding box of the scene's cells.
std::set<std::int64_t> inBox(const Scene& scene, const tipp::Lattice& lattice)
{
  double low[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  double high[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  for (const std::int64_t id : scene.Ids)
  {
    for (int axis = 0; axis < scene.Dimension; ++axis)
    {
      low[axis] = std::fmin(low[axis], scene.point(id)[axis]);
      high[axis] = std::fmax(high[axis], scene.point(id)[axis]);
    }
  }
  std::set<std::int64_t> samples;
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    double at[3];
    sampleOf(lattice, i, at);
    bool inside = true;
    for (int axis = 0; axis < scene.Dimension; ++axis)
    {
      inside = inside && at[axis] >= low[axis] && at[axis] <= high[axis];
    }
    if (inside)
    {
      samples.insert(i);
    }
  }
  return samples;
}

std::set<std::int64_t> inWindow(const tipp::SampleWindow& window)
{
  std::set<std::int64_t> samples;
  for (std::int64_t begin = 0; begin < window.samples(); begin += 5)
  {
    window.forRuns(begin, std::min(begin + 5, window.samples()),
      [&](std::int64_t first, std::int64_t last, std::int64_t shift)
      {
        for (std::int64_t i = first; i < last; ++i)
        {
          samples.insert(i + shift);
        }
      });
  }
  return samples;
}

} // namespace

TEST(SampleWindow, ContainsTheSamplesInTheBoxOfTheCells)
{
  for (const Scene& scene :
    { regularScene(2, 12), jitteredScene(2, 12, 3), jitteredScene(3, 6, 3) })
  {
    const tipp::Lattice lattice = latticeOf(scene.Dimension, 25, -0.25, 0.75);
    for (const bool ownPoints : { false, true })
    {
      for (const Scene& tile : tilesOf(scene, 3, ownPoints))
      {
        const auto window = tipp::SampleWindow::around(tile.mesh(), lattice, 2);
        EXPECT_EQ(inWindow(window), inBox(tile, lattice));
      }
    }
  }
}

TEST(SampleWindow, HasTheSamplesOfTheWholeLattice)
{
  const Scene scene = tilesOf(jitteredScene(3, 6, 3), 2, true)[5];
  const tipp::Lattice lattice = latticeOf(3, 19, 0, 1);
  const auto window = tipp::SampleWindow::around(scene.mesh(), lattice, 1);
  EXPECT_LT(window.samples(), lattice.samples());
  window.forRuns(0, window.samples(),
    [&](std::int64_t first, std::int64_t last, std::int64_t shift)
    {
      for (std::int64_t i = first; i < last; ++i)
      {
        double here[3];
        double there[3];
        sampleOf(window.lattice(), i, here);
        sampleOf(lattice, i + shift, there);
        EXPECT_TRUE(std::equal(here, here + 3, there)) << i;
      }
    });
}

TEST(SampleWindow, IsTheWholeLatticeIfCellsReachBeyondAllSamples)
{
  const Scene scene = jitteredScene(2, 5, 3);
  const tipp::Lattice lattice = latticeOf(2, 9, 0.1, 0.9);
  EXPECT_EQ(tipp::SampleWindow::around(scene.mesh(), lattice, 1).lattice().Extent, lattice.Extent);
}

TEST(SampleWindow, IsEmptyBesideTheLattice)
{
  const Scene scene = jitteredScene(2, 5, 3);
  const auto window = tipp::SampleWindow::around(scene.mesh(), latticeOf(2, 9, 2, 3), 1);
  EXPECT_EQ(window.samples(), 0);
}

TEST(SampleWindow, IgnoresCoordinatesThatAreNotFinite)
{
  Scene scene = jitteredScene(2, 4, 3);
  const tipp::Lattice lattice = latticeOf(2, 9, -1, 2);
  const std::set<std::int64_t> before = inBox(scene, lattice);
  scene.Points[3 * 12] = std::nan("");
  EXPECT_EQ(inWindow(tipp::SampleWindow::around(scene.mesh(), lattice, 1)), before);
}

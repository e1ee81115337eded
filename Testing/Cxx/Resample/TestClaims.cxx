// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/ClaimSamples.h"

#include "ExactLocation.h"
#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

/// Compares each sample's cell with rational arithmetic: the cell after the first move that leads
/// into a cell, otherwise a closed cell that contains the sample, otherwise none.
void expectExact(const Scene& scene, const tipp::Lattice& lattice)
{
  const tipp::Claims claims = tipp::claimSamples(scene.mesh(), lattice, 2);
  const int moves = scene.Dimension == 2 ? 4 : 8;
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    double sample[3];
    sampleOf(lattice, i, sample);
    std::vector<int> expected;
    for (int move = 0; move < moves && expected.empty(); ++move)
    {
      expected = oracle::cellsAfterMove(scene, sample, move);
    }
    expected = expected.empty() ? oracle::closedCells(scene, sample) : expected;
    const int cell = claims.Cells[std::size_t(i)];
    if (expected.empty())
    {
      ASSERT_EQ(cell, -1) << scene.Name << " sample " << i;
    }
    else
    {
      ASSERT_TRUE(std::find(expected.begin(), expected.end(), cell) != expected.end())
        << scene.Name << " sample " << i << " has cell " << cell << ", not " << expected.front();
    }
  }
}

} // namespace

TEST(Claims, AreExactWhereSamplesFallOnEdgesAndCorners)
{
  for (const Scene& scene : planeScenes())
  {
    expectExact(scene, latticeOf(2, 33, -0.5, 1.5));
  }
}

TEST(Claims, AreExactForSamplesInsideCells)
{
  for (const Scene& scene : planeScenes())
  {
    expectExact(scene, latticeOf(2, 37, 0.013, 1.0171));
  }
}

TEST(Claims, AreExactIfSamplesAreDenserThanDoubles)
{
  tipp::Lattice lattice = latticeOf(2, 60, 0.5, 0.5);
  lattice.Delta = { 0x1p-55, 0x1p-54, 1 };
  for (const Scene& scene : planeScenes())
  {
    expectExact(scene, lattice);
  }
}

TEST(Claims, AreExactForCellsFarFromTheLattice)
{
  Scene scene = jitteredScene(2, 4, 3);
  for (double& coordinate : scene.Points)
  {
    coordinate = (coordinate - 0.4) * 1e12;
  }
  expectExact(scene, latticeOf(2, 30, -1, 1));
}

TEST(Claims, AreExactIfAllSamplesAreEqual)
{
  tipp::Lattice lattice = latticeOf(2, 5, 0.5, 0.5);
  for (const Scene& scene : planeScenes())
  {
    expectExact(scene, lattice);
  }
}

TEST(Claims, AreTheSameInPartsOfALattice)
{
  const Scene scene = jitteredScene(2, 8, 1);
  const tipp::Lattice whole = latticeOf(2, 33, -0.5, 1.5);
  const tipp::Claims all = tipp::claimSamples(scene.mesh(), whole, 1);
  tipp::Lattice part = whole;
  part.Extent = { 7, 20, 11, 12, 0, 0 };
  const tipp::Claims some = tipp::claimSamples(scene.mesh(), part, 1);
  for (int y = 11; y <= 12; ++y)
  {
    for (int x = 7; x <= 20; ++x)
    {
      EXPECT_EQ(some.Cells[std::size_t((y - 11) * 14 + x - 7)], all.Cells[std::size_t(y * 33 + x)]);
    }
  }
}

TEST(Claims, DoNotDependOnTheNumberOfThreads)
{
  for (const Scene& scene : { regularScene(2, 40), overlappingScene(300, 1) })
  {
    const tipp::Lattice lattice = latticeOf(2, 161, 0, 1);
    const tipp::Claims one = tipp::claimSamples(scene.mesh(), lattice, 1);
    for (int threads = 2; threads <= 4; ++threads)
    {
      const tipp::Claims more = tipp::claimSamples(scene.mesh(), lattice, threads);
      EXPECT_TRUE(
        std::equal(one.Cells.get(), one.Cells.get() + lattice.samples(), more.Cells.get()))
        << scene.Name << " with " << threads << " threads";
    }
  }
}

TEST(Claims, OfOverlappingCellsDoNotDependOnTheirOrder)
{
  const Scene scene = overlappingScene(60, 2);
  const Scene other = scene.shuffled(3);
  const tipp::Lattice lattice = latticeOf(2, 33, 0, 1);
  const tipp::Claims one = tipp::claimSamples(scene.mesh(), lattice, 2);
  const tipp::Claims two = tipp::claimSamples(other.mesh(), lattice, 2);
  EXPECT_GT(one.Statistics.OverlappingClaims, 0);
  const auto corners = [](const Scene& of, int cell)
  {
    std::vector<std::int64_t> ids;
    if (cell >= 0)
    {
      ids.assign(of.Ids.begin() + 3 * cell, of.Ids.begin() + 3 * cell + 3);
      std::sort(ids.begin(), ids.end());
    }
    return ids;
  };
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    ASSERT_EQ(corners(scene, one.Cells[std::size_t(i)]), corners(other, two.Cells[std::size_t(i)]));
  }
}

TEST(Claims, OfEqualCellsAreOfTheFirst)
{
  Scene scene = jitteredScene(2, 4, 1);
  const int cells = scene.cells();
  const std::vector<std::int64_t> ids = scene.Ids;
  scene.Ids.insert(scene.Ids.end(), ids.begin(), ids.end());
  const tipp::Lattice lattice = latticeOf(2, 33, 0, 1);
  const tipp::Claims claims = tipp::claimSamples(scene.mesh(), lattice, 2);
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    EXPECT_GE(claims.Cells[std::size_t(i)], 0);
    EXPECT_LT(claims.Cells[std::size_t(i)], cells);
  }
}

TEST(Claims, ThreadsShareACellOfManySamples)
{
  Scene scene;
  scene.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
  scene.Ids = { 0, 1, 2 };
  const tipp::Lattice lattice = latticeOf(2, 1025, 0, 1);
  const tipp::Claims claims = tipp::claimSamples(scene.mesh(), lattice, 3);
  std::int64_t claimed = 0;
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    claimed += claims.Cells[std::size_t(i)] == 0;
  }
  EXPECT_EQ(claimed, 1025 * 1026 / 2);
}

TEST(Claims, LeaveOutCellsWithoutAreaAndCoordinatesThatAreNotFinite)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Scene scene;
  scene.Points = { 0, 0, 0, 1, 1, 0, 0.5, 0.5, 0, nan, 0, 0, 1, nan, 0, infinity, 0, 0, 0, 1, 0 };
  scene.Ids = { 0, 1, 2, 0, 1, 3, 4, 0, 1, 0, 5, 6, 3, 4, 5 };
  const tipp::Lattice lattice = latticeOf(2, 9, 0, 1);
  const tipp::Claims claims = tipp::claimSamples(scene.mesh(), lattice, 1);
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    EXPECT_EQ(claims.Cells[std::size_t(i)], -1);
  }
}

TEST(Claims, LeaveOutHiddenCells)
{
  const Scene scene = regularScene(2, 1);
  const unsigned char hidden[2] = { 0, 1 };
  tipp::SimplexMesh mesh = scene.mesh();
  mesh.Hidden = hidden;
  const tipp::Claims claims = tipp::claimSamples(mesh, latticeOf(2, 9, 0, 1), 1);
  EXPECT_EQ(std::count(claims.Cells.get(), claims.Cells.get() + 81, 0), 45);
  EXPECT_EQ(std::count(claims.Cells.get(), claims.Cells.get() + 81, -1), 36);
}

TEST(Claims, AreTheSameForEveryTypeOfPointsAndIds)
{
  for (const Scene& scene :
    { jitteredScene(2, 9, 3).rounded(), jitteredScene(3, 5, 3).rounded(), overlappingScene(60, 2) })
  {
    const tipp::Lattice lattice = latticeOf(scene.Dimension, 23, -0.03, 1);
    const tipp::Claims expected = tipp::claimSamples(scene.mesh(), lattice, 2);
    for (const bool single : { false, true })
    {
      for (const bool narrow : { false, true })
      {
        const StoredMesh stored(scene, single, narrow);
        const tipp::Claims claims = tipp::claimSamples(stored.Mesh, lattice, 2);
        EXPECT_TRUE(std::equal(
          expected.Cells.get(), expected.Cells.get() + lattice.samples(), claims.Cells.get()))
          << scene.Name << " single " << single << " narrow " << narrow;
      }
    }
  }
}

TEST(Claims, StopWhenProgressReturnsFalse)
{
  const Scene scene = regularScene(2, 100);
  const tipp::Claims claims =
    tipp::claimSamples(scene.mesh(), latticeOf(2, 9, 0, 1), 1, [](double) { return false; });
  EXPECT_TRUE(claims.Aborted);
}

TEST(Claims, InSpaceAreExactWhereSamplesFallOnFacesEdgesAndCorners)
{
  for (const Scene& scene : spaceScenes())
  {
    expectExact(scene, latticeOf(3, 9, -0.5, 1.5));
  }
}

TEST(Claims, InSpaceAreExactForSamplesInsideCells)
{
  for (const Scene& scene : spaceScenes())
  {
    expectExact(scene, latticeOf(3, 11, 0.013, 1.0171));
  }
}

TEST(Claims, InSpaceAreExactIfBoxesHaveAtMostOneSample)
{
  std::vector<Scene> scenes = spaceScenes();
  scenes.push_back(jitteredScene(3, 6, 1));
  for (const Scene& scene : scenes)
  {
    expectExact(scene, latticeOf(3, 5, 0, 1));
    expectExact(scene, latticeOf(3, 4, 0.013, 1.0171));
  }
}

TEST(Claims, InSpaceLeaveOutCellsWithASampleAndACoordinateThatIsNotFinite)
{
  const Scene scene = jitteredScene(3, 6, 1);
  const tipp::Lattice lattice = latticeOf(3, 4, 0.013, 0.9871);
  std::vector<unsigned char> hidden(std::size_t(scene.cells()));
  Scene infinite = scene;
  for (int cell = 0; cell < scene.cells(); cell += 7)
  {
    const std::int64_t point = scene.Ids[std::size_t(4 * cell)];
    for (int other = 0; other < scene.cells(); ++other)
    {
      const auto* const ids = scene.Ids.data() + 4 * other;
      hidden[std::size_t(other)] |= (unsigned char)(std::count(ids, ids + 4, point) > 0);
    }
    infinite.Points[std::size_t(3 * point + cell % 3)] =
      cell % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : HUGE_VAL;
  }
  tipp::SimplexMesh without = scene.mesh();
  without.Hidden = hidden.data();
  const tipp::Claims expected = tipp::claimSamples(without, lattice, 2);
  const tipp::Claims claims = tipp::claimSamples(infinite.mesh(), lattice, 2);
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    EXPECT_EQ(claims.Cells[std::size_t(i)], expected.Cells[std::size_t(i)]) << i;
  }
}

TEST(Claims, InSpaceAreExactIfSamplesAreDenserThanDoubles)
{
  tipp::Lattice lattice = latticeOf(3, 6, 0.5, 0.5);
  lattice.Delta = { 0x1p-54, 0x1p-53, 0x1p-55 };
  for (const Scene& scene : spaceScenes())
  {
    expectExact(scene, lattice);
  }
}

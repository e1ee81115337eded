// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/KeptSamples.h"
#include "Resample/Resample.h"

#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{

constexpr double dry = std::numeric_limits<double>::quiet_NaN();

std::vector<double> randomValues(std::size_t count, unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> any(-5, 5);
  std::vector<double> values(count);
  for (double& value : values)
  {
    value = any(generator);
  }
  return values;
}

/// What resample() makes of values.
template <typename T>
std::vector<T> resampled(
  const Scene& scene, const tipp::Lattice& lattice, const std::vector<T>& values, bool ofCells)
{
  std::vector<T> samples(std::size_t(lattice.samples()), 77);
  const tipp::Scalar type = sizeof(T) == 4 ? tipp::Scalar::Float32 : tipp::Scalar::Float64;
  tipp::ResampleOptions options;
  options.Threads = 2;
  tipp::resample(
    scene.mesh(), lattice, { { values.data(), samples.data(), type, 1, ofCells, -9 } }, options);
  return samples;
}

/// Lattices that are wider than a tile, of one row, and beyond a mesh of the unit square.
std::vector<tipp::Lattice> lattices()
{
  std::vector<tipp::Lattice> all = { latticeOf(2, 101, -0.1, 1.1), latticeOf(2, 65, 0, 1),
    latticeOf(2, 9, 0, 1), latticeOf(2, 3, 5, 6) };
  all.push_back(all[0]);
  all.back().Extent = { 3, 90, 40, 40, 0, 0 };
  all.push_back(all[0]);
  all.back().Slack = { 0.02, 0.02, 0 };
  return all;
}

} // namespace

TEST(KeptSamples, HaveTheBitsOfResample)
{
  for (const Scene& scene : planeScenes())
  {
    const std::vector<double> values = randomValues(scene.Points.size() / 3, 1);
    const std::vector<float> single(values.begin(), values.end());
    const std::vector<double> ofCells = randomValues(std::size_t(scene.cells()), 2);
    for (const tipp::Lattice& lattice : lattices())
    {
      for (const int threads : { 1, 3 })
      {
        const auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, threads);
        ASSERT_TRUE(kept);
        ASSERT_EQ(kept->samples(), lattice.samples());
        std::vector<double> samples(std::size_t(lattice.samples()));
        kept->fromPoints(values.data(), samples.data(), -9.0, threads);
        EXPECT_EQ(samples, resampled(scene, lattice, values, false)) << scene.Name;
        kept->fromCells(ofCells.data(), samples.data(), -9.0, threads);
        EXPECT_EQ(samples, resampled(scene, lattice, ofCells, true)) << scene.Name;
        std::vector<float> rounded(samples.size());
        kept->fromPoints(single.data(), rounded.data(), -9.0F, threads);
        EXPECT_EQ(rounded, resampled(scene, lattice, single, false)) << scene.Name;
      }
    }
  }
}

TEST(KeptSamples, CountThoseInTriangles)
{
  const Scene scene = jitteredScene(2, 12, 3);
  const tipp::Lattice lattice = latticeOf(2, 101, -0.1, 1.1);
  const std::vector<double> samples =
    resampled(scene, lattice, std::vector<double>(scene.Points.size() / 3, 1.0), false);
  const auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, 2);
  EXPECT_EQ(
    kept->inside(), samples.size() - std::size_t(std::count(samples.begin(), samples.end(), -9)));
  EXPECT_GT(kept->bytes(), samples.size() * 2);
}

TEST(KeptSamples, TakeOneComponentOfVectors)
{
  const Scene scene = jitteredScene(2, 12, 3);
  const tipp::Lattice lattice = latticeOf(2, 70, 0, 1);
  const auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, 2);
  std::vector<double> vectors(std::size_t(2 * lattice.samples()), 4);
  std::vector<double> alone(std::size_t(lattice.samples()));
  std::vector<double> x;
  for (std::size_t i = 0; i < scene.Points.size(); i += 3)
  {
    x.push_back(scene.Points[i]);
  }
  kept->fromPoints(x.data(), alone.data(), -9.0, 2);
  std::vector<double> three(std::size_t(3 * lattice.samples()), 4);
  kept->fromPoints(scene.Points.data(), three.data(), -9.0, 2, 3);
  for (std::size_t i = 0; i < alone.size(); ++i)
  {
    ASSERT_EQ(three[3 * i], alone[i]);
    ASSERT_EQ(three[3 * i + 1], 4);
  }
}

TEST(KeptSamples, AreMissingWhereACornerIs)
{
  const Scene scene = jitteredScene(2, 12, 3);
  const tipp::Lattice lattice = latticeOf(2, 70, 0, 1);
  const auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, 2);
  std::vector<double> values = randomValues(scene.Points.size() / 3, 4);
  std::vector<double> marks(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); i += 7)
  {
    values[i] = dry;
    marks[i] = 1;
  }
  std::vector<double> samples(std::size_t(lattice.samples()));
  std::vector<double> marked(samples.size());
  kept->fromPoints(values.data(), samples.data(), -9.0, 2);
  kept->fromPoints(marks.data(), marked.data(), -9.0, 2);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    // A sample on an edge between wet points may have a mark of 0 though the third corner is dry.
    ASSERT_TRUE(marked[i] > 0 ? std::isnan(samples[i]) : true) << i;
    ASSERT_TRUE(std::isnan(samples[i]) || marked[i] <= 0) << i;
  }
  EXPECT_TRUE(std::any_of(samples.begin(), samples.end(), [](double v) { return !std::isnan(v); }));
}

TEST(KeptSamples, EndTheWaterWhereTheGroundRises)
{
  // The ground is x, the water's level 0.5, and the points above it are dry.
  const Scene scene = jitteredScene(2, 12, 3);
  const tipp::Lattice lattice = latticeOf(2, 100, 0, 1);
  const auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, 2);
  std::vector<double> level;
  std::vector<double> x;
  for (std::size_t i = 0; i < scene.Points.size(); i += 3)
  {
    x.push_back(scene.Points[i]);
    level.push_back(x.back() < 0.5 ? 0.5 : dry);
  }
  std::vector<double> ground(std::size_t(lattice.samples()));
  kept->fromPoints(x.data(), ground.data(), -9.0, 2);
  std::vector<double> samples(ground.size());
  kept->waterLevel(level.data(), ground.data(), samples.data(), -9.0, 2);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (ground[i] == -9)
    {
      ASSERT_EQ(samples[i], -9);
    }
    else if (std::fabs(ground[i] - 0.5) > 1e-12)
    {
      ASSERT_EQ(std::isnan(samples[i]), ground[i] > 0.5) << ground[i];
      ASSERT_TRUE(std::isnan(samples[i]) || std::fabs(samples[i] - 0.5) < 1e-12);
    }
  }
}

TEST(KeptSamples, StopWhenTheCallerWishes)
{
  const Scene scene = jitteredScene(2, 40, 3);
  EXPECT_FALSE(tipp::KeptSamples::find(
    scene.mesh(), latticeOf(2, 300, 0, 1), 2, [](double) { return false; }));
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/KeptSamples.h"
#include "Resample/Resample.h"

#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
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

/// What resample() makes of values; NaN outside.
std::vector<double> resampled(
  const Scene& scene, const tipp::Lattice& lattice, const std::vector<double>& values, bool ofCells)
{
  std::vector<double> samples(std::size_t(lattice.samples()), 77);
  tipp::ResampleOptions options;
  options.Threads = 2;
  tipp::resample(scene.mesh(), lattice,
    { { values.data(), samples.data(), tipp::Scalar::Float64, 1, ofCells, dry } }, options);
  return samples;
}

/// Expects samples that differ by the rounding of weights and results alone: `range` is the largest
/// difference between values.
void expectNear(const std::vector<double>& exact, const std::vector<float>& samples, double range)
{
  ASSERT_EQ(exact.size(), samples.size());
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    const double bound = 0x1p-23 * range + 0x1p-24 * std::fabs(exact[i]);
    ASSERT_TRUE(
      std::isnan(exact[i]) ? std::isnan(samples[i]) : std::fabs(samples[i] - exact[i]) <= bound)
      << i << ": " << exact[i] << " " << samples[i];
  }
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

TEST(KeptSamples, HaveTheValuesOfResample)
{
  for (const Scene& scene : planeScenes())
  {
    const std::vector<double> values = randomValues(scene.Points.size() / 3, 1);
    const std::vector<double> ofCells = randomValues(std::size_t(scene.cells()), 2);
    for (const tipp::Lattice& lattice : lattices())
    {
      const auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, 2);
      ASSERT_TRUE(kept);
      ASSERT_EQ(kept->samples(), lattice.samples());
      std::vector<float> samples(std::size_t(lattice.samples()));
      kept->fromPoints(values.data(), samples.data(), 2);
      expectNear(resampled(scene, lattice, values, false), samples, 10);
      kept->fromCells(ofCells.data(), samples.data(), 2);
      expectNear(resampled(scene, lattice, ofCells, true), samples, 0);
    }
  }
}

TEST(KeptSamples, DoNotDependOnThreads)
{
  const Scene scene = jitteredScene(2, 30, 3);
  const tipp::Lattice lattice = latticeOf(2, 300, -0.1, 1.1);
  const std::vector<double> values = randomValues(scene.Points.size() / 3, 1);
  std::vector<std::vector<float>> all;
  for (const int threads : { 1, 2, 5 })
  {
    all.emplace_back(std::size_t(lattice.samples()));
    tipp::KeptSamples::find(scene.mesh(), lattice, threads)
      ->fromPoints(values.data(), all.back().data(), threads);
  }
  for (const std::vector<float>& samples : all)
  {
    EXPECT_EQ(0, std::memcmp(all[0].data(), samples.data(), samples.size() * sizeof(float)));
  }
}

TEST(KeptSamples, OfTwoFieldsAtOnceAreThoseOfEach)
{
  const Scene scene = jitteredScene(2, 30, 3);
  const tipp::Lattice lattice = latticeOf(2, 301, -0.1, 1.1);
  const std::size_t points = scene.Points.size() / 3;
  std::vector<std::vector<double>> fields = { randomValues(points, 1), randomValues(points, 2) };
  fields[1][points / 2] = std::nan("");
  std::vector<double> both;
  for (std::size_t i = 0; i < points; ++i)
  {
    both.insert(both.end(), { fields[0][i], fields[1][i] });
  }
  const auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, 2);
  const auto size = std::size_t(lattice.samples());
  std::vector<std::vector<float>> samples(2, std::vector<float>(size));
  kept->pairFromPoints(both.data(), samples[0].data(), samples[1].data(), 2);
  for (std::size_t k = 0; k < 2; ++k)
  {
    std::vector<float> single(size);
    kept->fromPoints(fields[k].data(), single.data(), 2);
    EXPECT_EQ(0, std::memcmp(single.data(), samples[k].data(), size * sizeof(float)));
  }
}

TEST(KeptSamples, TakeTheValuesThatTheyUseAlone)
{
  const Scene scene = jitteredScene(2, 40, 3);
  const tipp::Lattice lattice = latticeOf(2, 21, 0.2, 0.5);
  const std::vector<double> values = randomValues(scene.Points.size() / 3, 1);
  const std::vector<double> ofCells = randomValues(std::size_t(scene.cells()), 2);
  auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, 2);
  std::vector<float> all(std::size_t(lattice.samples()));
  std::vector<float> allOfCells(all.size());
  kept->fromPoints(values.data(), all.data(), 2);
  kept->fromCells(ofCells.data(), allOfCells.data(), 2);
  std::vector<double> used;
  for (const std::int32_t point : kept->keepPoints(std::int64_t(values.size())))
  {
    used.push_back(values[std::size_t(point)]);
  }
  std::vector<double> usedOfCells;
  for (const std::int32_t cell : kept->keepCells(scene.cells()))
  {
    usedOfCells.push_back(ofCells[std::size_t(cell)]);
  }
  EXPECT_LT(used.size(), values.size() / 4);
  EXPECT_LT(usedOfCells.size(), ofCells.size() / 4);
  std::vector<float> samples(all.size());
  kept->fromPoints(used.data(), samples.data(), 2);
  EXPECT_EQ(all, samples);
  kept->fromCells(usedOfCells.data(), samples.data(), 2);
  EXPECT_EQ(allOfCells, samples);
  std::vector<std::int32_t> backwards;
  for (std::size_t i = 0; i < used.size(); ++i)
  {
    backwards.push_back(std::int32_t(used.size() - 1 - i));
  }
  kept->renumberPoints(backwards);
  std::reverse(used.begin(), used.end());
  kept->fromPoints(used.data(), samples.data(), 2);
  EXPECT_EQ(all, samples);
}

TEST(KeptSamples, CountThoseInTriangles)
{
  const Scene scene = jitteredScene(2, 12, 3);
  const tipp::Lattice lattice = latticeOf(2, 101, -0.1, 1.1);
  const std::vector<double> samples =
    resampled(scene, lattice, std::vector<double>(scene.Points.size() / 3, 1.0), false);
  const auto kept = tipp::KeptSamples::find(scene.mesh(), lattice, 2);
  EXPECT_EQ(kept->inside(), std::count(samples.begin(), samples.end(), 1.0));
  EXPECT_GT(kept->bytes(), samples.size() * 12);
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
  std::vector<float> samples(std::size_t(lattice.samples()));
  std::vector<float> marked(samples.size());
  kept->fromPoints(values.data(), samples.data(), 2);
  kept->fromPoints(marks.data(), marked.data(), 2);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    // A sample on an edge between wet points may have a mark of 0 though the third corner is dry.
    ASSERT_TRUE(marked[i] > 0 ? std::isnan(samples[i]) : true) << i;
    ASSERT_TRUE(std::isnan(samples[i]) || marked[i] <= 0) << i;
  }
  EXPECT_TRUE(std::any_of(samples.begin(), samples.end(), [](float v) { return !std::isnan(v); }));
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
  std::vector<float> ground(std::size_t(lattice.samples()));
  kept->fromPoints(x.data(), ground.data(), 2);
  std::vector<float> samples(ground.size());
  kept->waterLevel(level.data(), ground.data(), samples.data(), 2);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (std::isnan(ground[i]))
    {
      ASSERT_TRUE(std::isnan(samples[i]));
    }
    else if (std::fabs(ground[i] - 0.5) > 1e-6)
    {
      ASSERT_EQ(std::isnan(samples[i]), ground[i] > 0.5) << ground[i];
      ASSERT_TRUE(std::isnan(samples[i]) || std::fabs(samples[i] - 0.5) < 1e-6);
    }
  }
}

TEST(KeptSamples, StopWhenTheCallerWishes)
{
  const Scene scene = jitteredScene(2, 40, 3);
  EXPECT_FALSE(tipp::KeptSamples::find(
    scene.mesh(), latticeOf(2, 300, 0, 1), 2, [](double) { return false; }));
}

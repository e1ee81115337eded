// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Resample.h"

#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>

namespace
{

double linear(const double* p)
{
  return 3 + 2 * p[0] - 5 * p[1] + 7 * p[2];
}

template <typename T>
std::vector<T> valuesOf(const Scene& scene)
{
  std::vector<T> values;
  for (std::size_t i = 0; i < scene.Points.size(); i += 3)
  {
    values.push_back(T(linear(scene.Points.data() + i)));
  }
  return values;
}

template <typename T>
tipp::Attribute attribute(tipp::Scalar type, const std::vector<T>& values, std::vector<T>& samples)
{
  tipp::Attribute result;
  result.Values = values.data();
  result.Samples = samples.data();
  result.Type = type;
  return result;
}

std::vector<double> sampled(const Scene& scene, const tipp::Lattice& lattice,
  const std::vector<double>& values, int threads = 2)
{
  std::vector<double> samples(std::size_t(lattice.samples()));
  tipp::Attribute array = attribute(tipp::Scalar::Float64, values, samples);
  array.NullValue = std::numeric_limits<double>::quiet_NaN();
  tipp::ResampleOptions options;
  options.Threads = threads;
  tipp::resample(scene.mesh(), lattice, { array }, options);
  return samples;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

void expectLinear(const Scene& scene, const tipp::Lattice& lattice)
{
  const std::vector<double> samples = sampled(scene, lattice, valuesOf<double>(scene));
  int hits = 0;
  for (std::int64_t i = 0; i < lattice.samples(); ++i)
  {
    double sample[3];
    sampleOf(lattice, i, sample);
    const double value = samples[std::size_t(i)];
    if (!std::isnan(value))
    {
      ++hits;
      ASSERT_NEAR(value, linear(sample), 2e-14) << scene.Name << " sample " << i;
    }
  }
  EXPECT_GT(hits, 0) << scene.Name;
}

} // namespace

TEST(Interpolation, ReproducesLinearFieldsExactly)
{
  for (const Scene& scene : planeScenes())
  {
    expectLinear(scene, latticeOf(2, 65, 0, 1));
    expectLinear(scene, latticeOf(2, 137, 0.0013, 0.9991));
  }
}

TEST(Interpolation, InSpaceReproducesLinearFieldsExactly)
{
  for (const Scene& scene : spaceScenes())
  {
    expectLinear(scene, latticeOf(3, 17, 0, 1));
    expectLinear(scene, latticeOf(3, 23, 0.0013, 0.9991));
  }
}

TEST(Interpolation, InSliversReproducesLinearFieldsExactly)
{
  const Scene scene = sliverScene();
  tipp::Lattice lattice = latticeOf(2, 10, 0, 1);
  // The samples are at the corners of the flat triangles, or an ulp away from them.
  lattice.Delta[1] = lattice.Delta[0] / 3;
  expectLinear(scene, lattice);
  lattice.Min[1] = 0x1p-54;
  expectLinear(scene, lattice);
}

TEST(Interpolation, HasTheSameBitsForAnyThreadsAndOrder)
{
  std::mt19937 random(5);
  for (Scene scene : { jitteredScene(2, 20, 4), regularScene(2, 8), jitteredScene(3, 5, 4) })
  {
    std::vector<double> values(scene.Points.size() / 3);
    std::generate(values.begin(), values.end(), [&] { return std::ldexp(double(random()), -32); });
    const tipp::Lattice lattice = latticeOf(scene.Dimension, 41, -0.1, 1.1);
    const std::vector<double> one = sampled(scene, lattice, values, 1);
    for (int threads = 2; threads <= 4; ++threads)
    {
      EXPECT_TRUE(
        sameBits(one, sampled(scene.shuffled(unsigned(threads)), lattice, values, threads)))
        << scene.Name;
    }
  }
}

TEST(Interpolation, TakesIntegersFromTheCornerOfLargestWeight)
{
  Scene scene;
  scene.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
  scene.Ids = { 2, 0, 1 };
  const std::vector<std::int32_t> values = { 10, 20, 30 };
  std::vector<std::int32_t> samples(81);
  tipp::Attribute array = attribute(tipp::Scalar::Int32, values, samples);
  array.NullValue = -7;
  tipp::resample(scene.mesh(), latticeOf(2, 9, 0, 1), { array }, {});
  for (int y = 0; y < 9; ++y)
  {
    for (int x = 0; x < 9; ++x)
    {
      const int weights[3] = { 8 - x - y, x, y };
      const int heaviest = *std::max_element(weights, weights + 3);
      const std::int32_t value = samples[std::size_t(9 * y + x)];
      ASSERT_EQ(weights[0] < 0, value == -7);
      if (weights[0] >= 0)
      {
        EXPECT_EQ(weights[value / 10 - 1], heaviest) << x << " " << y;
      }
    }
  }
}

TEST(Interpolation, RoundsFloatsOnce)
{
  const Scene scene = jitteredScene(2, 6, 1);
  const std::vector<float> values = valuesOf<float>(scene);
  const std::vector<double> wide(values.begin(), values.end());
  const tipp::Lattice lattice = latticeOf(2, 40, 0, 1);
  std::vector<float> samples(1600);
  tipp::resample(scene.mesh(), lattice, { attribute(tipp::Scalar::Float32, values, samples) }, {});
  const std::vector<double> expected = sampled(scene, lattice, wide);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    ASSERT_EQ(samples[i], std::isnan(expected[i]) ? 0.0f : float(expected[i]));
  }
}

TEST(Interpolation, InterpolatesEachComponentSeparately)
{
  const Scene scene = jitteredScene(2, 6, 1);
  const std::vector<double> first = valuesOf<double>(scene);
  std::vector<double> three;
  for (const double value : first)
  {
    three.insert(three.end(), { value, -value, 2 * value });
  }
  const tipp::Lattice lattice = latticeOf(2, 40, 0, 1);
  std::vector<double> samples(3 * 1600);
  tipp::Attribute array = attribute(tipp::Scalar::Float64, three, samples);
  array.Components = 3;
  array.NullValue = std::numeric_limits<double>::quiet_NaN();
  tipp::resample(scene.mesh(), lattice, { array }, {});
  const std::vector<double> expected = sampled(scene, lattice, first);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    if (!std::isnan(expected[i]))
    {
      ASSERT_EQ(samples[3 * i], expected[i]);
      ASSERT_EQ(samples[3 * i + 1], -expected[i]);
      ASSERT_EQ(samples[3 * i + 2], 2 * expected[i]);
    }
  }
}

TEST(Interpolation, TakesCellValuesFromTheParent)
{
  const Scene scene = regularScene(2, 1);
  const std::vector<std::int64_t> parents = { 4, 2 };
  const std::vector<std::int16_t> values = { 0, 0, 22, 0, 44 };
  std::vector<std::int16_t> samples(25);
  tipp::Attribute array = attribute(tipp::Scalar::Int16, values, samples);
  array.OfCells = true;
  tipp::ResampleOptions options;
  options.Parents = parents.data();
  tipp::resample(scene.mesh(), latticeOf(2, 5, 0, 1), { array }, options);
  EXPECT_EQ(samples[3], 44);  // below the diagonal
  EXPECT_EQ(samples[15], 22); // above the diagonal
}

TEST(Interpolation, RestrictsNaNToTheCellsThatHaveIt)
{
  const Scene scene = regularScene(2, 4);
  std::vector<double> values = valuesOf<double>(scene);
  values[12] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> samples = sampled(scene, latticeOf(2, 33, 0, 1), values);
  EXPECT_TRUE(std::isnan(samples[33 * 16 + 17]));
  EXPECT_EQ(
    std::count_if(samples.begin(), samples.end(), [](double v) { return v != v; }) < 33 * 33 / 2,
    true);
  EXPECT_FALSE(std::isnan(samples[33 * 2 + 2]));
}

TEST(Interpolation, AnInfiniteValueWithWeightDoesNotBecomeNaN)
{
  const Scene scene = regularScene(2, 1);
  std::vector<double> values(4, 1);
  values[3] = std::numeric_limits<double>::infinity();
  const std::vector<double> samples = sampled(scene, latticeOf(2, 33, 0, 1), values);
  EXPECT_EQ(samples[33 * 30 + 29], values[3]);
  EXPECT_EQ(samples[33 * 29 + 30], values[3]);
}

TEST(Interpolation, OfPartsInAnyOrderEqualsTheWhole)
{
  const Scene whole = overlappingScene(80, 7);
  const tipp::Lattice lattice = latticeOf(2, 33, 0, 1);
  std::vector<double> values(whole.Points.size() / 3);
  std::iota(values.begin(), values.end(), 0.5);
  const std::vector<double> expected = sampled(whole, lattice, values);
  for (const bool forward : { true, false })
  {
    std::vector<double> samples(std::size_t(lattice.samples()), std::nan(""));
    std::vector<tipp::CellKey> keys(samples.size(), tipp::noCellKey);
    std::vector<unsigned char> valid(samples.size(), 0);
    tipp::ResampleOptions options;
    options.Keys = keys.data();
    options.Valid = valid.data();
    for (int part = 0; part < 8; ++part)
    {
      Scene some = whole;
      const int i = forward ? part : 7 - part;
      some.Ids.assign(whole.Ids.begin() + 30 * i, whole.Ids.begin() + 30 * (i + 1));
      tipp::resample(
        some.mesh(), lattice, { attribute(tipp::Scalar::Float64, values, samples) }, options);
    }
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      ASSERT_EQ(std::isnan(expected[i]), valid[i] == 0);
      ASSERT_TRUE(samples[i] == expected[i] || !valid[i]) << i;
    }
  }
}

TEST(Interpolation, HasTheSameBitsForEveryTypeOfPointsAndIds)
{
  for (const Scene& scene : { jitteredScene(2, 9, 3).rounded(), jitteredScene(3, 5, 3).rounded() })
  {
    const tipp::Lattice lattice = latticeOf(scene.Dimension, 23, -0.03, 1);
    const std::vector<double> values = valuesOf<double>(scene);
    const std::vector<double> expected = sampled(scene, lattice, values);
    for (const bool single : { false, true })
    {
      const StoredMesh stored(scene, single, true);
      std::vector<double> samples(expected.size());
      tipp::Attribute array = attribute(tipp::Scalar::Float64, values, samples);
      array.NullValue = std::numeric_limits<double>::quiet_NaN();
      tipp::resample(stored.Mesh, lattice, { array }, {});
      EXPECT_TRUE(sameBits(expected, samples)) << single;
    }
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Resample.h"

#include "RequireDevice.h"
#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace
{

struct Sampled
{
  std::vector<double> Values;
  std::vector<unsigned char> Valid;
  tipp::ResampleResult Result;
};

Sampled sampled(const Scene& scene, const tipp::Lattice& lattice, tipp::DeviceChoice device,
  std::uint64_t memory = 0)
{
  std::vector<double> values;
  for (std::size_t i = 0; i < scene.Points.size(); i += 3)
  {
    values.push_back(std::sin(50 * scene.Points[i]) + scene.Points[i + 1] + scene.Points[i + 2]);
  }
  Sampled sampled;
  sampled.Values.resize(std::size_t(lattice.samples()));
  sampled.Valid.resize(sampled.Values.size());
  tipp::Attribute attribute;
  attribute.Values = values.data();
  attribute.Samples = sampled.Values.data();
  tipp::ResampleOptions options;
  options.Device = std::move(device);
  options.DeviceMemory = memory;
  options.Threads = 2;
  options.Valid = sampled.Valid.data();
  sampled.Result = tipp::resample(scene.mesh(), lattice, { attribute }, options);
  return sampled;
}

const tipp::DeviceChoice openMP{ tipp::Device::OpenMP, -1, "", false };

/// Arrays of all kinds: float64, float32 with three components, integers, and integers at cells.
struct Kinds
{
  std::vector<double> Double;
  std::vector<float> Float;
  std::vector<std::int16_t> Whole;
  std::vector<std::uint8_t> OfCells;

  static Kinds sized(std::size_t points, std::size_t cells)
  {
    return { std::vector<double>(points), std::vector<float>(3 * points),
      std::vector<std::int16_t>(points), std::vector<std::uint8_t>(cells) };
  }

  static Kinds of(const Scene& scene)
  {
    const std::size_t points = scene.Points.size() / 3;
    Kinds kinds = sized(points, std::size_t(scene.cells()));
    for (std::size_t i = 0; i < points; ++i)
    {
      kinds.Double[i] = std::sin(50 * scene.Points[3 * i]) + scene.Points[3 * i + 1];
      kinds.Whole[i] = std::int16_t(100 * i);
      for (std::size_t component = 0; component < 3; ++component)
      {
        kinds.Float[3 * i + component] = float(scene.Points[3 * i + component] + double(i));
      }
    }
    for (std::size_t i = 0; i < kinds.OfCells.size(); ++i)
    {
      kinds.OfCells[i] = std::uint8_t(i);
    }
    return kinds;
  }

  std::vector<tipp::Attribute> into(Kinds& samples) const
  {
    return { { this->Double.data(), samples.Double.data(), tipp::Scalar::Float64, 1, false, -7 },
      { this->Float.data(), samples.Float.data(), tipp::Scalar::Float32, 3, false, -7 },
      { this->Whole.data(), samples.Whole.data(), tipp::Scalar::Int16, 1, false, -7 },
      { this->OfCells.data(), samples.OfCells.data(), tipp::Scalar::UInt8, 1, true, 77 } };
  }
};

void expectNear(const Kinds& a, const Kinds& b)
{
  EXPECT_EQ(a.Whole, b.Whole);
  EXPECT_EQ(a.OfCells, b.OfCells);
  for (std::size_t i = 0; i < a.Double.size(); ++i)
  {
    ASSERT_NEAR(a.Double[i], b.Double[i], 1e-12) << i;
  }
  for (std::size_t i = 0; i < a.Float.size(); ++i)
  {
    ASSERT_NEAR(a.Float[i], b.Float[i], 2e-7 * std::fabs(a.Float[i])) << i;
  }
}

/// Each test runs with the device as it is, and with the device treated as a graphics card, so that
/// no graphics card is needed.
class ResampleOnDevice : public testing::TestWithParam<bool>
{
protected:
  void SetUp() override { TIPP_REQUIRE_OPENCL(); }

  void expectAgreement(
    const Scene& scene, const tipp::Lattice& lattice, std::uint64_t memory = 0) const
  {
    const Sampled ours = sampled(scene, lattice, openMP);
    const Sampled theirs = sampled(scene, lattice, this->openCL, memory);
    EXPECT_EQ(theirs.Result.Warning, "");
    EXPECT_NE(theirs.Result.Device, "OpenMP");
    ASSERT_EQ(ours.Valid, theirs.Valid) << scene.Name;
    for (std::size_t i = 0; i < ours.Values.size(); ++i)
    {
      ASSERT_NEAR(ours.Values[i], theirs.Values[i], 1e-12) << scene.Name << " sample " << i;
    }
  }

  const tipp::DeviceChoice openCL{ tipp::Device::OpenCL, -1, "", GetParam() };
};

INSTANTIATE_TEST_SUITE_P(, ResampleOnDevice, testing::Bool(),
  [](const auto& asCard) { return asCard.param ? "AsCard" : "AsItIs"; });

} // namespace

TEST_P(ResampleOnDevice, AgreesWithOpenMP)
{
  for (const Scene& scene : planeScenes())
  {
    expectAgreement(scene, latticeOf(2, 65, -0.1, 1.1));
    expectAgreement(scene, latticeOf(2, 65, 0, 1));
  }
}

TEST_P(ResampleOnDevice, InSpaceAgreesWithOpenMP)
{
  for (const Scene& scene : spaceScenes())
  {
    expectAgreement(scene, latticeOf(3, 23, -0.1, 1.1));
    expectAgreement(scene, latticeOf(3, 17, 0, 1));
  }
}

TEST_P(ResampleOnDevice, AgreesIfBoxesHaveAtMostOneSample)
{
  const Scene scene = jitteredScene(3, 12, 5);
  expectAgreement(scene, latticeOf(3, 8, -0.1, 1.2));
  expectAgreement(scene, latticeOf(3, 7, 0, 1)); // on faces, edges and corners of the border
}

TEST_P(ResampleOnDevice, HandlesCellsWithCornersOnRowsOfSamples)
{
  const Scene triangle = { "triangle", 2, { 0.25, 0.1, 0, 0.6, 0.3, 0, 0.3, 0.7, 0 }, { 0, 1, 2 } };
  const Scene tetrahedron = { "tetrahedron", 3,
    { 0.25, 0.1, 0.1, 0.6, 0.3, 0.25, 0.3, 0.75, 0.3, 0.35, 0.3, 0.75 }, { 0, 1, 2, 3 } };
  for (const Scene& scene : { triangle, tetrahedron })
  {
    const tipp::Lattice lattice = latticeOf(scene.Dimension, 5, 0, 1);
    expectAgreement(scene, lattice);
    EXPECT_EQ(sampled(scene, lattice, openCL).Result.Statistics.VisitedCells, 0) << "by threads";
  }
}

TEST_P(ResampleOnDevice, AgreesOnASmallRangeOfALargeMesh)
{
  expectAgreement(jitteredScene(2, 40, 5), latticeOf(2, 30, 0.4, 0.5));
  expectAgreement(jitteredScene(3, 12, 5), latticeOf(3, 11, 0.4, 0.5));
}

/// SampleOnDevice samples no integers and no cell arrays, so this test has none.
TEST_P(ResampleOnDevice, SamplesArraysOfPointsWithSeveralComponentsLikeOpenMP)
{
  for (const int dimension : { 2, 3 })
  {
    const Scene scene = jitteredScene(dimension, 12, 4);
    const tipp::Lattice lattice = latticeOf(dimension, 31, -0.1, 1.1);
    Kinds kinds = Kinds::of(scene);
    kinds.Double[5] = HUGE_VAL; // cells with this value are left to the threads
    const auto sampledOn = [&](const tipp::DeviceChoice& device)
    {
      Kinds samples = Kinds::sized(std::size_t(lattice.samples()), std::size_t(lattice.samples()));
      std::vector<tipp::Attribute> attributes = kinds.into(samples);
      attributes.resize(2);
      tipp::ResampleOptions options;
      options.Device = device;
      options.Threads = 2;
      EXPECT_EQ(tipp::resample(scene.mesh(), lattice, attributes, options).Warning, "");
      for (double& value : samples.Double)
      {
        value = std::isfinite(value) ? value : 1e6; // NaN would not compare equal
      }
      return samples;
    };
    const Kinds ours = sampledOn(openMP);
    EXPECT_GT(std::count(ours.Double.begin(), ours.Double.end(), 1e6), 0);
    expectNear(ours, sampledOn(openCL));
  }
}

TEST_P(ResampleOnDevice, AgreesWhereCellsOverlap)
{
  expectAgreement(overlappingScene(100, 3), latticeOf(2, 65, -0.013, 1.017));
}

TEST_P(ResampleOnDevice, AgreesWhereACellIsLarge)
{
  expectAgreement(jitteredScene(2, 2, 3), latticeOf(2, 701, 0.0013, 0.997));
  expectAgreement(jitteredScene(3, 2, 3), latticeOf(3, 61, 0.0013, 0.997));
}

TEST_P(ResampleOnDevice, DividesALargerMesh)
{
  const Scene scene = jitteredScene(2, 60, 3);
  const tipp::Lattice lattice = latticeOf(2, 33, 0.0013, 0.997);
  expectAgreement(scene, lattice, 60000);
}

TEST_P(ResampleOnDevice, AgreesForEveryTypeOfPointsAndIds)
{
  const Scene scene = jitteredScene(2, 9, 3).rounded();
  const tipp::Lattice lattice = latticeOf(2, 65, -0.013, 1);
  const Kinds values = Kinds::of(scene);
  Kinds expected = Kinds::sized(65 * 65, 65 * 65);
  tipp::resample(scene.mesh(), lattice, values.into(expected), {});
  for (const bool single : { false, true })
  {
    for (const bool narrow : { false, true })
    {
      const StoredMesh stored(scene, single, narrow);
      Kinds samples = Kinds::sized(65 * 65, 65 * 65);
      tipp::ResampleOptions options;
      options.Device = openCL;
      EXPECT_EQ(tipp::resample(stored.Mesh, lattice, values.into(samples), options).Warning, "");
      expectNear(expected, samples);
    }
  }
}

TEST_P(ResampleOnDevice, LeavesOutHiddenCells)
{
  const Scene scene = jitteredScene(2, 9, 3);
  const tipp::Lattice lattice = latticeOf(2, 65, -0.013, 1.017);
  std::vector<unsigned char> hidden(std::size_t(scene.cells()));
  for (std::size_t i = 0; i < hidden.size(); i += 3)
  {
    hidden[i] = 1;
  }
  tipp::SimplexMesh mesh = scene.mesh();
  mesh.Hidden = hidden.data();
  const Kinds values = Kinds::of(scene);
  Kinds here = Kinds::sized(65 * 65, 65 * 65);
  Kinds there = Kinds::sized(65 * 65, 65 * 65);
  tipp::resample(mesh, lattice, values.into(here), {});
  for (const std::uint64_t memory : { std::uint64_t(0), std::uint64_t(262144) })
  {
    tipp::ResampleOptions options;
    options.Device = openCL;
    options.DeviceMemory = memory;
    EXPECT_EQ(tipp::resample(mesh, lattice, values.into(there), options).Warning, "");
    expectNear(here, there);
  }
  EXPECT_NE(std::count(here.Double.begin(), here.Double.end(), -7), 0);
}

TEST_P(ResampleOnDevice, CombinesPartsLikeOpenMP)
{
  const Scene scene = overlappingScene(60, 2);
  const tipp::Lattice lattice = latticeOf(2, 65, -0.013, 1.017);
  const Kinds values = Kinds::of(scene);
  const auto together = [&](const tipp::DeviceChoice& device)
  {
    Kinds samples = Kinds::sized(65 * 65, 65 * 65);
    std::vector<tipp::CellKey> keys(65 * 65, tipp::noCellKey);
    std::vector<unsigned char> valid(65 * 65);
    for (const int half : { 0, 1 })
    {
      std::vector<unsigned char> hidden(std::size_t(scene.cells()));
      std::fill(hidden.begin() + half * 30, hidden.begin() + half * 30 + 30, 1);
      tipp::SimplexMesh mesh = scene.mesh();
      mesh.Hidden = hidden.data();
      tipp::ResampleOptions options;
      options.Device = device;
      options.Keys = keys.data();
      options.Valid = valid.data();
      EXPECT_EQ(tipp::resample(mesh, lattice, values.into(samples), options).Warning, "");
    }
    return samples;
  };
  // Threads interpolate the device's claims, so even the last bits are equal.
  const Kinds ours = together(openMP);
  const Kinds theirs = together(openCL);
  EXPECT_EQ(ours.Double, theirs.Double);
  EXPECT_EQ(ours.Float, theirs.Float);
  EXPECT_EQ(ours.Whole, theirs.Whole);
  EXPECT_EQ(ours.OfCells, theirs.OfCells);
}

TEST_P(ResampleOnDevice, CombinesTilesToTheWholeImage)
{
  const Scene scene = jitteredScene(2, 12, 2);
  const tipp::Lattice lattice = latticeOf(2, 65, -0.013, 1.017);
  const Kinds values = Kinds::of(scene);
  Kinds whole = Kinds::sized(65 * 65, 65 * 65);
  std::vector<tipp::Attribute> points = values.into(whole);
  points.pop_back(); // removes the cell array, since tiles number cells differently
  tipp::resample(scene.mesh(), lattice, points, {});
  Kinds tiled = Kinds::sized(65 * 65, 65 * 65);
  std::fill(tiled.Double.begin(), tiled.Double.end(), -7);
  std::fill(tiled.Float.begin(), tiled.Float.end(), -7.0f);
  std::fill(tiled.Whole.begin(), tiled.Whole.end(), -7);
  points = values.into(tiled);
  points.pop_back();
  std::vector<tipp::CellKey> keys(65 * 65, tipp::noCellKey);
  std::vector<unsigned char> valid(65 * 65);
  for (const Scene& tile : tilesOf(scene, 3, false))
  {
    tipp::ResampleOptions options;
    options.Device = openCL;
    options.Keys = keys.data();
    options.Valid = valid.data();
    const tipp::ResampleResult result = tipp::resample(tile.mesh(), lattice, points, options);
    EXPECT_EQ(result.Warning, "");
    EXPECT_NE(result.Device, "OpenMP");
  }
  expectNear(whole, tiled);
}

TEST_P(ResampleOnDevice, ReportsItsTimesAndStopsOnRequest)
{
  const Scene scene = jitteredScene(2, 60, 3);
  const tipp::Lattice lattice = latticeOf(2, 33, 0.0013, 0.997);
  const Kinds values = Kinds::of(scene);
  Kinds samples = Kinds::sized(33 * 33, 33 * 33);
  tipp::ResampleOptions options;
  options.Device = openCL;
  options.DeviceMemory = 150000;
  const tipp::ResampleResult result =
    tipp::resample(scene.mesh(), lattice, values.into(samples), options);
  EXPECT_GT(result.ClaimSeconds, 0);
  EXPECT_GT(result.InterpolationSeconds, 0);
  EXPECT_GT(result.TransferSeconds, 0);
  for (const double until : { 0.1, 0.75 }) // during claims and during interpolation
  {
    double last = 0;
    options.Progress = [&](double done)
    {
      last = done;
      return done < until;
    };
    EXPECT_TRUE(tipp::resample(scene.mesh(), lattice, values.into(samples), options).Aborted);
    EXPECT_LT(last, until + 0.1);
  }
}

TEST_P(ResampleOnDevice, WithoutDeviceMemoryForTheSamplesOpenMPIsUsed)
{
  const Scene scene = jitteredScene(2, 8, 3);
  const Sampled result = sampled(scene, latticeOf(2, 65, 0, 1), openCL, 1000);
  EXPECT_EQ(result.Result.Device, "OpenMP");
  EXPECT_NE(result.Result.Warning.find("OpenMP does it instead"), std::string::npos);
  EXPECT_EQ(result.Values, sampled(scene, latticeOf(2, 65, 0, 1), openMP).Values);
}

TEST(ResampleDevices, AnUnknownDeviceIsAnError)
{
  const Scene scene = jitteredScene(2, 8, 3);
  EXPECT_THROW(
    sampled(scene, latticeOf(2, 65, 0, 1), { tipp::Device::OpenCL, 99, "" }), tipp::UnknownDevice);
  EXPECT_THROW(sampled(scene, latticeOf(2, 65, 0, 1), { tipp::Device::OpenCL, -1, "no such name" }),
    tipp::UnknownDevice);
}

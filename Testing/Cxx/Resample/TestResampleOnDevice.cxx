// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/Resample.h"

#include "RequireDevice.h"
#include "ResampleScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

const tipp::DeviceChoice openMP{ tipp::Device::OpenMP, -1, "" };
const tipp::DeviceChoice openCL{ tipp::Device::OpenCL, -1, "" };

void expectAgreement(const Scene& scene, const tipp::Lattice& lattice, std::uint64_t memory = 0)
{
  const Sampled ours = sampled(scene, lattice, openMP);
  const Sampled theirs = sampled(scene, lattice, openCL, memory);
  EXPECT_EQ(theirs.Result.Warning, "");
  EXPECT_NE(theirs.Result.Device, "OpenMP");
  ASSERT_EQ(ours.Valid, theirs.Valid) << scene.Name;
  for (std::size_t i = 0; i < ours.Values.size(); ++i)
  {
    ASSERT_NEAR(ours.Values[i], theirs.Values[i], 1e-12) << scene.Name << " sample " << i;
  }
}

class ResampleOnDevice : public testing::Test
{
protected:
  void SetUp() override { TIPP_REQUIRE_OPENCL(); }
};

} // namespace

TEST_F(ResampleOnDevice, AgreesWithOpenMP)
{
  for (const Scene& scene : planeScenes())
  {
    expectAgreement(scene, latticeOf(2, 65, -0.1, 1.1));
    expectAgreement(scene, latticeOf(2, 65, 0, 1));
  }
}

TEST_F(ResampleOnDevice, InSpaceAgreesWithOpenMP)
{
  for (const Scene& scene : spaceScenes())
  {
    expectAgreement(scene, latticeOf(3, 23, -0.1, 1.1));
    expectAgreement(scene, latticeOf(3, 17, 0, 1));
  }
}

TEST_F(ResampleOnDevice, AgreesWhereCellsOverlap)
{
  expectAgreement(overlappingScene(100, 3), latticeOf(2, 65, -0.013, 1.017));
}

TEST_F(ResampleOnDevice, AgreesWhereACellIsLarge)
{
  expectAgreement(jitteredScene(2, 2, 3), latticeOf(2, 701, 0.0013, 0.997));
  expectAgreement(jitteredScene(3, 2, 3), latticeOf(3, 61, 0.0013, 0.997));
}

TEST_F(ResampleOnDevice, TakesALargerMeshInPieces)
{
  const Scene scene = jitteredScene(2, 60, 3);
  const tipp::Lattice lattice = latticeOf(2, 33, 0.0013, 0.997);
  expectAgreement(scene, lattice, 60000);
}

TEST_F(ResampleOnDevice, WithoutMemoryForTheSamplesOpenMPDoesIt)
{
  const Scene scene = jitteredScene(2, 8, 3);
  const Sampled result = sampled(scene, latticeOf(2, 65, 0, 1), openCL, 1000);
  EXPECT_EQ(result.Result.Device, "OpenMP");
  EXPECT_NE(result.Result.Warning.find("OpenMP does it instead"), std::string::npos);
  EXPECT_EQ(result.Values, sampled(scene, latticeOf(2, 65, 0, 1), openMP).Values);
}

TEST(ResampleDevices, AMissingDeviceIsAWarning)
{
  const Scene scene = jitteredScene(2, 8, 3);
  const Sampled result = sampled(scene, latticeOf(2, 65, 0, 1), { tipp::Device::OpenCL, 99, "" });
  EXPECT_EQ(result.Result.Device, "OpenMP");
  EXPECT_NE(result.Result.Warning, "");
  EXPECT_EQ(result.Values, sampled(scene, latticeOf(2, 65, 0, 1), openMP).Values);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/ComputeDevice.h"

#include "ExpectAcceleratorError.h"
#include "RequireDevice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <thread>
#include <vector>

using tipp::ComputeDevice;
using tipp::Device;
using tipp::DeviceChoice;
using tipp::KernelSource;

namespace
{

const KernelSource Doubling = { "Doubling",
  "kernel void twice(global const double* from, global double* to)"
  "{ to[get_global_id(0)] = 2.0 * from[get_global_id(0)]; }" };

DeviceChoice anyDevice()
{
  DeviceChoice choice;
  choice.Kind = Device::OpenCL;
  return choice;
}

std::vector<double> twice(ComputeDevice& device, const std::vector<double>& values)
{
  const std::size_t bytes = values.size() * sizeof(double);
  const cl::Buffer from = device.input(values.data(), bytes);
  const cl::Buffer to = device.room(bytes);
  cl::Kernel kernel = device.kernel(Doubling, "twice");
  kernel.setArg(0, from);
  kernel.setArg(1, to);
  device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(values.size()));
  std::vector<double> result(values.size());
  device.read(to, result.data(), bytes);
  return result;
}

} // namespace

TEST(ComputeDevice, DescribesItself)
{
  TIPP_REQUIRE_OPENCL();
  const ComputeDevice* device = ComputeDevice::open(anyDevice());
  ASSERT_NE(device, nullptr);
  EXPECT_FALSE(device->description().Name.empty());
  EXPECT_FALSE(device->description().Platform.empty());
  EXPECT_GT(device->description().Memory, 0u);
  EXPECT_GT(device->description().LargestBuffer, 0u);
  EXPECT_LE(device->description().LargestBuffer, device->description().Memory);
}

TEST(ComputeDevice, IsOpenedOnceAProcess)
{
  TIPP_REQUIRE_OPENCL();
  const ComputeDevice* device = ComputeDevice::open(anyDevice());
  EXPECT_EQ(device, ComputeDevice::open(anyDevice()));
  DeviceChoice byIndex = anyDevice();
  byIndex.Index = device->description().Index;
  EXPECT_EQ(device, ComputeDevice::open(byIndex));
  DeviceChoice byName = anyDevice();
  byName.Name = device->description().Name;
  EXPECT_EQ(device, ComputeDevice::open(byName));
}

TEST(ComputeDevice, CanBeUsedAsACardAndAsItIsAtOnce)
{
  TIPP_REQUIRE_OPENCL();
  const ComputeDevice* const device = ComputeDevice::open(anyDevice());
  DeviceChoice choice = anyDevice();
  choice.AsCard = true;
  ComputeDevice* const card = ComputeDevice::open(choice);
  EXPECT_NE(card, device);
  EXPECT_EQ(card, ComputeDevice::open(choice));
  EXPECT_EQ(card->description().Name, device->description().Name);
  EXPECT_EQ(card->description().Type, tipp::DeviceType::Gpu);
  EXPECT_FALSE(card->sharesHostMemory());
  EXPECT_EQ(twice(*card, { 1.5, -0.25 }), (std::vector<double>{ 3.0, -0.5 }));
}

TEST(ComputeDevice, IsNoneForOpenMP)
{
  DeviceChoice choice;
  choice.Kind = Device::OpenMP;
  EXPECT_EQ(ComputeDevice::open(choice), nullptr);
}

TEST(ComputeDevice, RunsAKernel)
{
  TIPP_REQUIRE_OPENCL();
  EXPECT_EQ(twice(*ComputeDevice::open(anyDevice()), { 1.5, -0.25, 1e300 }),
    (std::vector<double>{ 3.0, -0.5, 2e300 }));
}

TEST(ComputeDevice, ServesSeveralThreadsAtOnce)
{
  TIPP_REQUIRE_OPENCL();
  ComputeDevice& device = *ComputeDevice::open(anyDevice());
  std::vector<std::vector<double>> results(4);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < results.size(); ++t)
  {
    threads.emplace_back(
      [&, t] { results[t] = twice(device, std::vector<double>(1000, static_cast<double>(t))); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (std::size_t t = 0; t < results.size(); ++t)
  {
    EXPECT_EQ(results[t], std::vector<double>(1000, 2.0 * static_cast<double>(t)));
  }
}

TEST(ComputeDevice, CopiesMoreThanItsStagesHold)
{
  TIPP_REQUIRE_OPENCL();
  DeviceChoice choice = anyDevice();
  choice.AsCard = true;
  ComputeDevice& card = *ComputeDevice::open(choice);
  const double before = card.transferSeconds();
  std::vector<double> values(5000001);
  std::iota(values.begin(), values.end(), 0.5);
  const std::vector<double> doubled = twice(card, values);
  for (double& value : values)
  {
    value *= 2;
  }
  EXPECT_TRUE(doubled == values);
  EXPECT_GT(card.transferSeconds(), before);
}

TEST(ComputeDevice, ReportsKernelsThatDoNotCompile)
{
  TIPP_REQUIRE_OPENCL();
  ComputeDevice& device = *ComputeDevice::open(anyDevice());
  const KernelSource broken = { "Broken", "kernel void f(global double* p) { p[0] = nonsense; }" };
  expectAcceleratorError(
    [&] { device.kernel(broken, "f"); }, "cannot compile the kernels of Broken: ");
}

TEST(ComputeDevice, RefusesAKernelThatTheProgramLacks)
{
  TIPP_REQUIRE_OPENCL();
  ComputeDevice& device = *ComputeDevice::open(anyDevice());
  expectAcceleratorError([&] { device.kernel(Doubling, "thrice"); },
    "The OpenCL device '" + device.description().Name + "' failed: ");
}

TEST(ComputeDevice, TurnsOpenCLsExceptionsIntoErrors)
{
  TIPP_REQUIRE_OPENCL();
  const ComputeDevice& device = *ComputeDevice::open(anyDevice());
  expectAcceleratorError([&]
    { device.run([]() -> void { throw cl::Error(CL_OUT_OF_RESOURCES, "clFinish"); }); },
    "failed: the device has not enough memory (clFinish).");
}

TEST(ComputeDevice, AcceptsEmptyInput)
{
  TIPP_REQUIRE_OPENCL();
  const ComputeDevice& device = *ComputeDevice::open(anyDevice());
  const cl::Buffer nothing = device.input(nullptr, 0);
  EXPECT_NO_THROW(device.read(nothing, nullptr, 0));
}

// SPDX-License-Identifier: BSD-3-Clause
// A device kernel: the areas of triangles, on an OpenCL device and on threads.
#include "OpenCL/ComputeDevice.h"
#include "Parallel/ParallelFor.h"
#include "TriangleAreas.cl.h"

#include "RequireDevice.h"

#include <gtest/gtest.h>

namespace
{

using namespace tipp;

std::vector<double> twiceAreas(const std::vector<double>& corners, const DeviceChoice& choice)
{
  const std::size_t triangles = corners.size() / 6;
  std::vector<double> areas(triangles);
  if (ComputeDevice* const device = ComputeDevice::open(choice))
  {
    const std::size_t bytes = triangles * sizeof(double);
    const cl::Buffer input = device->input(corners.data(), 6 * bytes);
    const cl::Buffer output = device->room(bytes);
    cl::Kernel kernel = device->kernel(TriangleAreasKernels, "twiceAreas");
    device->launch(kernel, triangles, input, cl_uint(triangles), output);
    device->read(output, areas.data(), bytes);
    return areas;
  }
  parallelFor(std::int64_t(triangles), 0,
    [&](std::int64_t t)
    {
      const double* const c = &corners[std::size_t(6 * t)];
      areas[std::size_t(t)] = (c[2] - c[0]) * (c[5] - c[1]) - (c[3] - c[1]) * (c[4] - c[0]);
    });
  return areas;
}

TEST(ExtendingDeviceKernel, AgreesWithThreads)
{
  TIPP_REQUIRE_OPENCL();
  std::vector<double> corners;
  for (int i = 0; i < 600; ++i)
  {
    corners.push_back((i * i * 37) % 101); // small integers, so that both results are exact
  }
  const std::vector<double> onThreads = twiceAreas(corners, parseDeviceChoice("openmp"));
  EXPECT_EQ(onThreads, twiceAreas(corners, parseDeviceChoice("opencl")));
  EXPECT_NE(std::vector<double>(100), onThreads);
}

} // namespace

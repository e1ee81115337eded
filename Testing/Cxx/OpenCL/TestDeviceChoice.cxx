// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/Devices.h"

#include "ExpectAcceleratorError.h"

#include <gtest/gtest.h>

using tipp::Device;
using tipp::DeviceChoice;
using tipp::parseDeviceChoice;

TEST(DeviceChoice, IsAutoByDefault)
{
  EXPECT_EQ(DeviceChoice().Kind, Device::Auto);
  EXPECT_EQ(parseDeviceChoice("auto").Kind, Device::Auto);
}

TEST(DeviceChoice, NamesABackEnd)
{
  EXPECT_EQ(parseDeviceChoice("openmp").Kind, Device::OpenMP);
  const DeviceChoice choice = parseDeviceChoice("opencl");
  EXPECT_EQ(choice.Kind, Device::OpenCL);
  EXPECT_EQ(choice.Index, -1);
  EXPECT_EQ(choice.Name, "");
}

TEST(DeviceChoice, DistinguishesAnIndexFromAName)
{
  EXPECT_EQ(parseDeviceChoice("opencl:12").Index, 12);
  EXPECT_EQ(parseDeviceChoice("opencl:12").Name, "");
  EXPECT_EQ(parseDeviceChoice("opencl:RTX 4090").Index, -1);
  EXPECT_EQ(parseDeviceChoice("opencl:RTX 4090").Name, "RTX 4090");
}

TEST(DeviceChoice, RefusesOtherWords)
{
  for (const char* text : { "", "cuda", "OpenCL", "opencl:", "openmp:0", "auto " })
  {
    expectAcceleratorError([&] { parseDeviceChoice(text); }, "A device is auto, openmp, opencl");
  }
}

TEST(DeviceChoice, RefusesAnIndexThatOverflows)
{
  expectAcceleratorError([] { parseDeviceChoice("opencl:99999999999999999999"); },
    "There is no OpenCL device 99999999999999999999");
}

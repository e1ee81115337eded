// SPDX-License-Identifier: BSD-3-Clause
// CTest sets OCL_ICD_VENDORS=/nonexistent, so that no OpenCL driver is found.
#include "OpenCL/ComputeDevice.h"

#include "ExpectAcceleratorError.h"

#include <gtest/gtest.h>

TEST(NoOpenCLDevice, TheListIsEmpty)
{
  EXPECT_TRUE(tipp::listDevices().empty());
}

TEST(NoOpenCLDevice, AutoIsOpenMP)
{
  EXPECT_EQ(tipp::ComputeDevice::open({}), nullptr);
}

TEST(NoOpenCLDevice, RequestingADeviceIsAnError)
{
  expectAcceleratorError([] { tipp::ComputeDevice::open(tipp::parseDeviceChoice("opencl")); },
    "This machine has no OpenCL device: install");
}

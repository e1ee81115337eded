// SPDX-License-Identifier: BSD-3-Clause
// Tests of a build without OpenCL.
#include "ExpectAcceleratorError.h"
#include "OpenCL/Devices.h"

#include <gtest/gtest.h>

TEST(WithoutOpenCL, TheListIsEmpty)
{
  EXPECT_TRUE(tipp::listDevices().empty());
}

TEST(WithoutOpenCL, AutoIsOpenMP)
{
  EXPECT_FALSE(tipp::chooseDevice({}, tipp::listDevices()));
}

TEST(WithoutOpenCL, RequestingADeviceIsAnErrorThatNamesTheBuild)
{
  expectAcceleratorError([]
    { tipp::chooseDevice(tipp::parseDeviceChoice("opencl"), tipp::listDevices()); },
    "TIPP was built without OpenCL: use OpenMP");
}

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRequireDevice_h
#define tippRequireDevice_h

#include "OpenCL/Devices.h"

#include <algorithm>

/// Skips a test if there is no OpenCL device with double precision.
#define TIPP_REQUIRE_OPENCL()                                                                      \
  if (std::none_of(tipp::listDevices().begin(), tipp::listDevices().end(),                         \
        [](const tipp::DeviceDescription& device) { return device.Double; }))                      \
  {                                                                                                \
    GTEST_SKIP() << "no OpenCL device with double precision; pocl-opencl-icd makes one";           \
  }

#endif

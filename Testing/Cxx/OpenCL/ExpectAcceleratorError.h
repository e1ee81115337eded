// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExpectAcceleratorError_h
#define tippExpectAcceleratorError_h

#include "OpenCL/Devices.h"

#include <gtest/gtest.h>

#include <string>

/// Expects that `work` throws an AcceleratorError whose message contains `words`.
template <typename Work>
void expectAcceleratorError(Work&& work, const std::string& words)
{
  try
  {
    work();
    ADD_FAILURE() << "no error; expected: " << words;
  }
  catch (const tipp::AcceleratorError& error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos)
      << "expected '" << words << "' in: " << error.what();
  }
}

#endif

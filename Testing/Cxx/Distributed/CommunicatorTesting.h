// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCommunicatorTesting_h
#define tippCommunicatorTesting_h

#include "Ranks/Communicator.h"

#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

namespace tipp
{
namespace test
{

inline vtkMultiProcessController* controller()
{
  return vtkMultiProcessController::GetGlobalController();
}

inline Bytes filled(std::size_t size, char with)
{
  Bytes bytes(size);
  std::fill(bytes.begin(), bytes.end(), with);
  return bytes;
}

} // namespace test
} // namespace tipp

#endif

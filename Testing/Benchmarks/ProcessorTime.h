// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProcessorTime_h
#define tippProcessorTime_h

#include <ctime>

namespace tipp
{
namespace benchmark
{

/// Processor seconds of this process so far, the sum over all threads.
inline double processorSeconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

} // namespace benchmark
} // namespace tipp

#endif

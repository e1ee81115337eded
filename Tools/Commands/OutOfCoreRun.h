// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreRun_h
#define tippOutOfCoreRun_h

#include "OutOfCore/OutOfCoreRanks.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// triangulateOutOfCoreOnRanks() with a progress bar of this title, warnings, and Ctrl-C. `open` is
/// called on all ranks. Returns Success on all ranks, or the exit code of a failed or interrupted
/// run, about which the user has been told.
int runOutOfCore(Communicator& ranks, const std::string& title, const OpenPoints& open,
  const std::string& path, OutOfCoreOptions options, OutOfCoreStatistics& statistics);

/// What a process has used, which /proc and the system know.
struct ProcessUsage
{
  ProcessUsage();

  std::int64_t PeakMemory;
  std::int64_t Read;
  std::int64_t Written;
};

/// On the first rank, of all; collective.
std::vector<ProcessUsage> gatherUsage(Communicator& ranks);

std::int64_t largestMemory(const std::vector<ProcessUsage>& ranks);

} // namespace tipp

#endif

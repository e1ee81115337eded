// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/OutOfCoreRun.h"

#include "Commands/Commands.h"
#include "Commands/Report.h"
#include "Console/Interrupt.h"
#include "Console/ProgressBar.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <utility>

#include <malloc.h>

namespace tipp
{
namespace
{

/// What the process has read and written so far, in bytes: "rchar" and "wchar" of Linux's
/// /proc/self/io.
std::int64_t movedBytes(const std::string& name)
{
  std::ifstream file("/proc/self/io");
  std::string label;
  std::int64_t bytes = 0;
  while (file >> label >> bytes)
  {
    if (label == name + ":")
    {
      return bytes;
    }
  }
  return 0;
}

} // namespace

int runOutOfCore(Communicator& ranks, const std::string& title, const OpenPoints& open,
  const std::string& path, OutOfCoreOptions options, OutOfCoreStatistics& statistics)
{
  // Large blocks go back to the system when they are freed, whatever was freed before.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  const bool isFirst = ranks.rank() == 0;
  std::unique_ptr<ProgressBar> bar;
  const auto start = [&] { bar = std::make_unique<ProgressBar>(title); };
  options.Progress = [&bar](double fraction)
  {
    if (bar)
    {
      bar->update(fraction);
    }
    return !isInterrupted();
  };
  options.Warn = [&](const std::string& sentence)
  {
    bar.reset();
    fmt::print(stderr, "tipp: warning: {}\n", sentence);
    start();
  };
  const auto openFirst = [&]
  {
    auto points = open();
    isFirst ? start() : void();
    return points;
  };
  try
  {
    statistics = triangulateOutOfCoreOnRanks(ranks, openFirst, path, options);
  }
  catch (const RankFailure& failure)
  {
    bar.reset();
    if (isFirst)
    {
      fmt::print(stderr, "tipp: {}{}\n",
        ranks.size() > 1 ? fmt::format("rank {}: ", failure.Rank) : "", failure.what());
    }
    return Failure;
  }
  bar.reset();
  return statistics.Aborted
    ? reportInterrupt(
        statistics.Kept ? "the same command with --resume goes on" : "nothing was written")
    : Success;
}

ProcessUsage::ProcessUsage()
  : PeakMemory(peakMemoryBytes())
  , Read(movedBytes("rchar"))
  , Written(movedBytes("wchar"))
{
}

std::vector<ProcessUsage> gatherUsage(Communicator& ranks)
{
  ByteWriter writer;
  writer.value(ProcessUsage());
  std::vector<ProcessUsage> all;
  for (const Bytes& bytes : ranks.gather(writer.take()))
  {
    all.push_back(ByteReader(bytes).value<ProcessUsage>());
  }
  return all;
}

std::int64_t largestMemory(const std::vector<ProcessUsage>& ranks)
{
  return std::max_element(ranks.begin(), ranks.end(),
    [](const ProcessUsage& a, const ProcessUsage& b) { return a.PeakMemory < b.PeakMemory; })
    ->PeakMemory;
}

} // namespace tipp

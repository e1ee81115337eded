// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReport_h
#define tippReport_h

#include "Console/ProgressBar.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Output/RunStatistics.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace tipp
{

/// The peak memory of this process so far.
std::int64_t peakMemoryBytes();

/// The figures of a run that have a Key: totals, and for each list an array of objects.
nlohmann::ordered_json jsonOf(const RunStatistics& statistics);
/// An object for each row of a list.
nlohmann::ordered_json jsonOf(const FigureList& list);

/// Prints a warning if a run has made no triangles.
void warnOfNoTriangles(std::int64_t triangles);

/// Prints a warning if values of a raster equal the number for no data.
void warnOfHidden(double values, double noData);

/// Writes a JSON file; throws IOError.
void writeJson(const std::string& path, const nlohmann::ordered_json& json);

/// triangulateOutOfCoreOnRanks() with a progress bar of this title, warnings, and Ctrl-C. `open` is
/// called on all ranks. Returns Success on all ranks, or the exit code of a failed or interrupted
/// run, about which the user has been told.
int runOutOfCore(Communicator& ranks, const std::string& title, const OpenPoints& open,
  const std::string& path, OutOfCoreOptions options, OutOfCoreStatistics& statistics);

/// Passes progress to a bar, if there is one, and tells whether to go on: not after Ctrl-C. The bar
/// must outlive the function.
std::function<bool(double)> progressOn(const std::unique_ptr<ProgressBar>& bar);

/// Prints a warning above a progress bar, which is made anew. The bar must outlive the function.
std::function<void(const std::string&)> warnAbove(
  std::unique_ptr<ProgressBar>& bar, const std::string& title);

/// reportInterrupt() of a run out of core; `kept`: it can be resumed.
int reportInterruptedRun(bool kept);

/// Prints, on the first rank, which rank has failed and why. Returns Failure.
int reportRankFailure(const RankFailure& failure, const Communicator& ranks);

/// The sum of the phases' seconds.
template <typename Phase>
double totalSeconds(const std::vector<Phase>& phases)
{
  return std::accumulate(phases.begin(), phases.end(), 0.0,
    [](double sum, const Phase& phase) { return sum + phase.Seconds; });
}

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

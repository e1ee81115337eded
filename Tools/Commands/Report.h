// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReport_h
#define tippReport_h

#include "Files/PendingOutput.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Statistics/RunStatistics.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace tipp
{

/// Returns a number with a noun that agrees with it, such as "1 triangle" or "2 triangles".
std::string counted(std::int64_t count, const char* one, const char* many);

/// Returns a name as a field of a .csv file, in quotes if necessary.
std::string quotedField(const std::string& name);

/// Estimates the remaining time of a task from the progress since the first update. Work that an
/// earlier, interrupted run did is not counted.
class TimeLeft
{
public:
  /// Returns text such as "about 12 min left"; empty while there is too little data. `fraction`:
  /// finished, 0 to 1. `seconds`: the time on any clock.
  std::string update(double fraction, double seconds);

private:
  double FirstFraction = -1;
  double FirstSeconds = 0;
};

/// A progress line on stderr, removed at the end. Prints nothing if stderr is not a terminal.
class ProgressBar
{
public:
  explicit ProgressBar(const std::string& task);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Sets the finished fraction (0 to 1). Redraws when the percentage changes or a second has
  /// passed.
  void update(double fraction);

private:
  void draw(double fraction, const std::string& left);

  std::string Task;
  bool OnTerminal;
  int Percent = -1;
  Stopwatch Watch;
  double DrawnAt = 0; ///< in seconds
  TimeLeft Left;
};

/// Returns the peak memory of this process so far, in bytes.
std::int64_t peakMemoryBytes();

/// Returns the statistics of a run that have a Key: totals as values, lists as arrays of objects.
nlohmann::ordered_json jsonOf(const RunStatistics& statistics);
/// Returns an array with an object for each row of the list.
nlohmann::ordered_json jsonOf(const FigureList& list);
/// Returns an object with what was not read.
nlohmann::ordered_json jsonOf(const ReadFigures& figures);

/// Prints warnings, each one sentence.
void printWarnings(const std::vector<std::string>& warnings);

/// Why a run has made no triangles. `maximumEdge`: of --max-edge; 0: not given.
std::string reasonForNoTriangles(double maximumEdge);
/// Prints a warning with it if a run has made no triangles.
void warnOfNoTriangles(std::int64_t triangles, double maximumEdge);

/// Warns that some of a raster's values equal the number for no data. `values`: how many; without
/// any, nothing is printed.
void warnOfHidden(double values, double noData);

/// Throws IOError if an output is also an input (see requireApart()), or if the file of statistics,
/// which may be empty, cannot be written. Call it before the computation.
void checkOutputs(const std::string& output, const std::string& statistics,
  const std::string& scratch, const std::vector<std::string>& inputs);

/// Throws IOError unless the output files can be written and differ from the inputs. Call it before
/// the computation. `statistics` may be empty. Returns the state of the output's path; code that
/// writes the output later refuses to replace anything else.
PathState requireWritable(
  const std::string& output, const std::string& statistics, const std::vector<std::string>& inputs);

/// Writes a JSON file. Throws IOError.
void writeJson(const std::string& path, const nlohmann::ordered_json& json);

/// Returns the beginning of a summary, from figures of a run: points, cells, duplicates, and,
/// unless they are 0, positions with different elevations and rejected points.
std::string describeCounts(const nlohmann::ordered_json& figures);

/// Reports a triangulation: writes its figures to the JSON file `path`, if that is not empty, and
/// prints a summary, one line: the counts, the pieces if any, `seconds`, points per second, and the
/// peak memory. `more` ends the line. Throws IOError.
void reportRun(const std::string& path, const nlohmann::ordered_json& figures, double seconds,
  const std::string& more = "");

///@{
/// Calls triangulateOutOfCoreOnRanks() or tetrahedralizeOutOfCoreOnRanks() with a progress bar of
/// this title, warnings, and Ctrl-C.
/// `open` is called on all ranks. Returns Success on all ranks, or the exit code of a failed or
/// interrupted run, after printing a message.
int runOutOfCore(Communicator& ranks, const std::string& title, const OpenPoints& open,
  const std::string& path, OutOfCoreOptions options, OutOfCoreStatistics& statistics);
int runOutOfCore(Communicator& ranks, const std::string& title, const OpenPoints& open,
  const std::string& path, OutOfCoreOptions3 options, OutOfCoreStatistics3& statistics);
///@}

/// Returns a function that passes progress to a bar, if there is one, and returns false after
/// Ctrl-C. `bar` must outlive the function.
std::function<bool(double)> progressOn(const std::unique_ptr<ProgressBar>& bar);

/// Returns a function that prints a warning and starts the progress bar again below it. `bar` must
/// outlive the function.
std::function<void(const std::string&)> warnAbove(
  std::unique_ptr<ProgressBar>& bar, const std::string& title);

/// Calls reportInterrupt() for a run out of core; `kept`: it can be resumed.
int reportInterruptedRun(bool kept);

/// Calls work() on all ranks of a controller, or in this process alone (null). Returns the exit
/// code, the same on all ranks, after printing a message if a rank failed or the user stopped it.
int runTogether(
  vtkMultiProcessController* controller, const std::function<void(Communicator&)>& work);

/// Returns the sum of the phases' seconds.
template <typename Phase>
double totalSeconds(const std::vector<Phase>& phases)
{
  return std::accumulate(phases.begin(), phases.end(), 0.0,
    [](double sum, const Phase& phase) { return sum + phase.Seconds; });
}

/// The resources that all ranks have used so far, in bytes.
struct RankUsage
{
  std::vector<std::int64_t> PeakMemory; ///< by rank
  std::int64_t Read = 0;                ///< of all ranks
  std::int64_t Written = 0;
};

/// Returns the usage of all ranks on the first rank; PeakMemory is empty on the others. Collective.
RankUsage gatherUsage(Communicator& ranks);

} // namespace tipp

#endif

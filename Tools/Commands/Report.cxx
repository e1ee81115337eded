// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Report.h"

#include "Console/Process.h"
#include "Files/Platform.h"
#include "Files/RequireApart.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Series/WriteUgrid.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

namespace tipp
{

std::string counted(std::int64_t count, const char* one, const char* many)
{
  return fmt::format("{} {}", count, count == 1 ? one : many);
}
namespace
{

std::string textOf(double exactly)
{
  const double seconds = exactly - 1e-6; // so that a rounding error does not add a second
  if (seconds < 60)
  {
    return fmt::format("about {:.0f} s left", std::ceil(seconds));
  }
  const double minutes = std::ceil(seconds / 60);
  return minutes < 60 ? fmt::format("about {:.0f} min left", minutes)
                      : fmt::format("about {:.0f} h {:02.0f} min left", std::floor(minutes / 60),
                          std::fmod(minutes, 60));
}

/// Returns the bytes that the process has read or written so far: `name` is "rchar" or "wchar", a
/// field of Linux's /proc/self/io.
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

/// Prints on the first rank which rank has failed, and why. Returns Failure.
int reportRankFailure(const RankFailure& failure, const Communicator& ranks)
{
  if (ranks.isFirst())
  {
    // mpirun may send SIGTERM as soon as another rank has ended; that would be a second sentence.
    endWatch();
    fmt::print(stderr, "tipp: {}{}\n",
      ranks.size() > 1 ? fmt::format("rank {}: ", failure.Rank) : "", failure.what());
  }
  return Failure;
}

} // namespace

std::string quotedField(const std::string& name)
{
  if (name.find_first_of(",\"\n") == std::string::npos)
  {
    return name;
  }
  std::string text = "\"";
  for (const char c : name)
  {
    text += c == '"' ? "\"\"" : std::string(1, c);
  }
  return text + "\"";
}

std::string TimeLeft::update(double fraction, double seconds)
{
  if (this->FirstFraction < 0)
  {
    this->FirstFraction = fraction;
    this->FirstSeconds = seconds;
  }
  constexpr double leastSeconds = 0.5;
  constexpr double leastFraction = 0.02;
  const double done = fraction - this->FirstFraction;
  const double taken = seconds - this->FirstSeconds;
  return taken < leastSeconds || done < leastFraction || fraction >= 1
    ? std::string()
    : textOf((1 - fraction) * taken / done);
}

ProgressBar::ProgressBar(const std::string& task)
  : Task(task)
  , OnTerminal(isatty(STDERR_FILENO) == 1)
{
  this->draw(0, "");
}

ProgressBar::~ProgressBar()
{
  if (this->OnTerminal)
  {
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
  }
}

void ProgressBar::update(double fraction)
{
  if (!this->OnTerminal)
  {
    return;
  }
  const double now = this->Watch.seconds();
  const std::string left = this->Left.update(fraction, now);
  const int percent = int(100 * std::clamp(fraction, 0.0, 1.0));
  if (percent != this->Percent || now >= this->DrawnAt + 1)
  {
    this->DrawnAt = now;
    this->draw(fraction, left);
  }
}

void ProgressBar::draw(double fraction, const std::string& left)
{
  if (!this->OnTerminal)
  {
    return;
  }
  this->Percent = int(100 * std::clamp(fraction, 0.0, 1.0));
  constexpr int width = 40;
  const std::string done(std::size_t(this->Percent * width / 100), '#');
  fmt::print(stderr, "\r{} [{:<{}}] {:3} % {}\033[K", this->Task, done, width, this->Percent, left);
  std::fflush(stderr);
}

std::int64_t peakMemoryBytes()
{
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t(usage.ru_maxrss) * 1024; // Linux counts in KiB
}

nlohmann::ordered_json jsonOf(const FigureList& list)
{
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Figures& column : list.Columns)
  {
    const auto add = [&](const auto& values)
    {
      for (std::size_t i = 0; i < values.size() && !column.Key.empty(); ++i)
      {
        rows[i][column.Key] = values[i];
      }
    };
    std::visit(add, column.Values);
  }
  return rows;
}

nlohmann::ordered_json jsonOf(const RunStatistics& statistics)
{
  FigureList totals{ "", false, statistics.Totals };
  nlohmann::ordered_json json = jsonOf(totals)[0];
  for (const FigureList& list : statistics.Lists)
  {
    if (!list.Key.empty())
    {
      json[list.Key] = jsonOf(list);
    }
  }
  return json;
}

nlohmann::ordered_json jsonOf(const ReadFigures& figures)
{
  return { { "points", figures.SkippedPoints }, { "files", figures.SkippedFiles },
    { "chunks", figures.SkippedChunks } };
}

void printWarnings(const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings)
  {
    fmt::print(stderr, "tipp: warning: {}\n", warning);
  }
}

std::string reasonForNoTriangles(double maximumEdge)
{
  const std::string tooFew = "there are fewer than three distinct points or all lie on one line";
  return maximumEdge > 0
    ? fmt::format(
        "each triangle has an edge longer than the {} of --max-edge, or {}", maximumEdge, tooFew)
    : tooFew;
}

void warnOfNoTriangles(std::int64_t triangles, double maximumEdge)
{
  if (triangles == 0)
  {
    fmt::print(
      stderr, "tipp: warning: no triangles, because {}.\n", reasonForNoTriangles(maximumEdge));
  }
}

void warnOfHidden(double values, double noData)
{
  if (values > 0)
  {
    fmt::print(stderr,
      "tipp: warning: {:.0f} values equal the number for no data, {}, and are lost; give another "
      "number.\n",
      values, noData);
  }
}

void checkOutputs(const std::string& output, const std::string& statistics,
  const std::string& scratch, const std::vector<std::string>& inputs)
{
  requireApart({ output, statistics, scratchIn(scratch) }, inputs);
  if (!statistics.empty())
  {
    const PendingFile writable(statistics);
  }
}

PathState requireWritable(
  const std::string& output, const std::string& statistics, const std::vector<std::string>& inputs)
{
  checkOutputs(output, statistics, "", inputs);
  requireNetcdfFor(output);
  return PendingFile(output).before();
}

void writeJson(const std::string& path, const nlohmann::ordered_json& json)
{
  PendingFile pending(path);
  // File names need not be UTF-8, so replace invalid bytes.
  const std::string text =
    json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
  pending.file().write(0, text.data(), text.size());
  pending.commit();
}

std::string describeCounts(const nlohmann::ordered_json& figures)
{
  const auto number = [&figures](const char* key) { return figures.value(key, std::int64_t(0)); };
  const char* const cells = figures.contains("tetrahedra") ? "tetrahedra" : "triangles";
  std::string text = fmt::format("{} points, {} {}, {} duplicates", number("points"), number(cells),
    cells, number("duplicates"));
  if (const std::int64_t positions = number("disagreeing_places"))
  {
    text += fmt::format(
      ", {} location{} with different elevations", positions, positions == 1 ? "" : "s");
  }
  const std::int64_t rejected = number("rejected");
  return text + (rejected > 0 ? fmt::format(", {} rejected", rejected) : "");
}

void reportRun(const std::string& path, const nlohmann::ordered_json& figures, double seconds,
  const std::string& more)
{
  if (!path.empty())
  {
    writeJson(path, figures);
  }
  const std::string pieces = figures.contains("pieces")
    ? fmt::format(", {} pieces, {:.0f} MB", figures["pieces"].get<std::int64_t>(),
        figures["mesh_bytes"].get<double>() / 1e6)
    : "";
  fmt::print("{}{}, {:.3f} s, {:.0f} points/s, peak memory {:.0f} MB{}\n", describeCounts(figures),
    pieces, seconds, seconds > 0 ? figures["points"].get<double>() / seconds : 0.0,
    figures["peak_memory_bytes"].get<double>() / 1e6, more);
}

std::function<bool(double)> progressOn(const std::unique_ptr<ProgressBar>& bar)
{
  return [&bar](double fraction)
  {
    if (bar)
    {
      bar->update(fraction);
    }
    return !isInterrupted();
  };
}

std::function<void(const std::string&)> warnAbove(
  std::unique_ptr<ProgressBar>& bar, const std::string& title)
{
  return [&bar, title](const std::string& sentence)
  {
    bar.reset();
    fmt::print(stderr, "tipp: warning: {}\n", sentence);
    bar = std::make_unique<ProgressBar>(title);
  };
}

int reportInterruptedRun(bool kept)
{
  return reportInterrupt(
    kept ? "to continue, run the same command with --resume" : "nothing was written");
}

int runTogether(
  vtkMultiProcessController* controller, const std::function<void(Communicator&)>& work)
{
  Communicator ranks(controller);
  try
  {
    ranks.together([&] { work(ranks); });
  }
  catch (const RankFailure& failure)
  {
    return failure.Aborted ? reportInterrupt() : reportRankFailure(failure, ranks);
  }
  return Success;
}

namespace
{

/// `run`: triangulateOutOfCoreOnRanks() or tetrahedralizeOutOfCoreOnRanks().
template <typename Options, typename Statistics, typename Run>
int runInPieces(Communicator& ranks, const std::string& title, const OpenPoints& open,
  const std::string& path, Options& options, Statistics& statistics, const Run& run)
{
  returnLargeBlocks();
  const bool isFirst = ranks.rank() == 0;
  std::unique_ptr<ProgressBar> bar;
  options.Progress = progressOn(bar);
  options.Warn = warnAbove(bar, title);
  const auto openFirst = [&]
  {
    auto points = open();
    bar = isFirst ? std::make_unique<ProgressBar>(title) : nullptr;
    return points;
  };
  try
  {
    statistics = run(ranks, openFirst, path, options);
  }
  catch (const RankFailure& failure)
  {
    bar.reset();
    return reportRankFailure(failure, ranks);
  }
  bar.reset();
  return statistics.Aborted ? reportInterruptedRun(statistics.Kept) : Success;
}

} // namespace

int runOutOfCore(Communicator& ranks, const std::string& title, const OpenPoints& open,
  const std::string& path, OutOfCoreOptions options, OutOfCoreStatistics& statistics)
{
  return runInPieces(ranks, title, open, path, options, statistics, &triangulateOutOfCoreOnRanks);
}

int runOutOfCore(Communicator& ranks, const std::string& title, const OpenPoints& open,
  const std::string& path, OutOfCoreOptions3 options, OutOfCoreStatistics3& statistics)
{
  return runInPieces(
    ranks, title, open, path, options, statistics, &tetrahedralizeOutOfCoreOnRanks);
}

RankUsage gatherUsage(Communicator& ranks)
{
  const std::array<std::int64_t, 3> own = { peakMemoryBytes(), movedBytes("rchar"),
    movedBytes("wchar") };
  RankUsage usage;
  for (const auto& [memory, read, written] : ranks.gather(own))
  {
    usage.PeakMemory.push_back(memory);
    usage.Read += read;
    usage.Written += written;
  }
  return usage;
}

} // namespace tipp

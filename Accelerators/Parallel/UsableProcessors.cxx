// SPDX-License-Identifier: BSD-3-Clause
#include "Parallel/UsableProcessors.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>
#include <utility>

#include <unistd.h>

#ifdef __linux__
#include <sched.h>
#endif

namespace tipp
{

namespace
{

/// A file's first two words; empty if it cannot be read.
std::pair<std::string, std::string> wordsOf(const std::string& path)
{
  std::pair<std::string, std::string> words;
  std::ifstream(path) >> words.first >> words.second;
  return words;
}

/// Returns quota / period, numbers of microseconds; 0 if they are not positive numbers.
double quotient(const std::string& quota, const std::string& period)
{
  const double time = std::strtod(quota.c_str(), nullptr); // "max" and "-1" are no limit
  const double every = std::strtod(period.c_str(), nullptr);
  return time > 0 && every > 0 ? time / every : 0;
}

/// The limit of one control group: version 2 keeps it in one file, version 1 in two.
double limitOf(const std::string& group)
{
  const auto limit = wordsOf(group + "/cpu.max");
  if (!limit.first.empty())
  {
    return quotient(limit.first, limit.second);
  }
  return quotient(
    wordsOf(group + "/cpu.cfs_quota_us").first, wordsOf(group + "/cpu.cfs_period_us").first);
}

/// The smallest limit of a group and those that hold it. A container may see its own group as the
/// top one, though `path` names it as its host does.
double limitOfAll(const std::string& top, std::string path)
{
  double least = 0;
  for (;;)
  {
    const double limit = limitOf(top + path);
    least = limit > 0 && (least == 0 || limit < least) ? limit : least;
    if (path.empty())
    {
      return least;
    }
    path.erase(std::min(path.rfind('/'), path.size() - 1));
  }
}

int ranksOnNode()
{
  for (const char* const name : { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS" })
  {
    const char* const text = std::getenv(name);
    if (const int number = text ? std::atoi(text) : 0; number > 0)
    {
      return number;
    }
  }
  return 0;
}

ProcessorCount findUsableProcessors()
{
  double limit = 0;
#ifdef __linux__
  std::ifstream file("/proc/self/cgroup");
  limit = controlGroupLimit(
    { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() }, "/sys/fs/cgroup");
#endif
  return fewestProcessors(
    processorCount(), int(sysconf(_SC_NPROCESSORS_ONLN)), limit, ranksOnNode());
}

} // namespace

double controlGroupLimit(const std::string& groups, const std::string& folder)
{
  double least = 0;
  std::istringstream lines(groups);
  for (std::string line; std::getline(lines, line);)
  {
    // A line is "number:controllers:path"; version 2 names no controllers.
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos)
    {
      continue;
    }
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool limitsTime = ("," + controllers + ",").find(",cpu,") != std::string::npos;
    if (!controllers.empty() && !limitsTime)
    {
      continue;
    }
    std::string path = line.substr(second + 1);
    path = path == "/" ? "" : path;
    const std::string top = controllers.empty() ? folder : folder + "/" + controllers;
    const double limit = limitOfAll(top, path);
    least = limit > 0 && (least == 0 || limit < least) ? limit : least;
  }
  return least;
}

ProcessorCount fewestProcessors(int allowed, int all, double limit, int ranks)
{
  ProcessorCount usable{ std::max(allowed, 1), allowed < all ? "affinity" : "processors" };
  if (limit > 0 && std::ceil(limit) < usable.Count)
  {
    usable = { int(std::ceil(limit)), "control group" };
  }
  if (ranks > 0 && all / ranks < usable.Count)
  {
    usable = { std::max(all / ranks, 1), "ranks on this node" };
  }
  return usable;
}

const ProcessorCount& usableProcessors()
{
  static const ProcessorCount found = findUsableProcessors();
  return found;
}

int processorCount()
{
#ifdef __linux__
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0)
  {
    return CPU_COUNT(&allowed);
  }
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace tipp

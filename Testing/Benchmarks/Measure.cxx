// SPDX-License-Identifier: BSD-3-Clause
#include "Measure.h"

#include <cstdio>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tipp
{
namespace benchmark
{
namespace
{

double residentMegabytes()
{
  long total = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return double(resident) * double(sysconf(_SC_PAGESIZE)) / 1e6;
}

double peakMegabytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * 1024 / 1e6;
}

/// One value per line. Names of phases contain spaces, so a name is last on its line.
std::string pack(const Measurement& m)
{
  std::ostringstream text;
  const TriangulationStatistics& s = m.Result.Statistics;
  text << std::setprecision(17) << m.Result.Seconds << '\n'
       << m.Result.Triangles << '\n'
       << m.Result.Checksum << '\n'
       << m.Result.Recovered << '\n'
       << m.PeakMegabytes << '\n'
       << m.OwnMegabytes << '\n'
       << s.Partitions << '\n'
       << s.InitialPoints << '\n'
       << s.WorkerVertices << '\n'
       << s.Threads << '\n'
       << s.Stages.size() << '\n'
       << s.Phases.size() << '\n';
  for (const auto& stage : s.Stages)
  {
    text << stage.ActivePartitions << ' ' << stage.MeshTriangles << '\n';
  }
  for (const auto& phase : s.Phases)
  {
    text << phase.Seconds << ' ' << phase.Name << '\n';
  }
  return text.str();
}

bool unpack(const std::string& packed, Measurement& m)
{
  std::istringstream text(packed);
  TriangulationStatistics& s = m.Result.Statistics;
  std::size_t stages = 0;
  std::size_t phases = 0;
  text >> m.Result.Seconds >> m.Result.Triangles >> m.Result.Checksum >> m.Result.Recovered >>
    m.PeakMegabytes >> m.OwnMegabytes >> s.Partitions >> s.InitialPoints >> s.WorkerVertices >>
    s.Threads >> stages >> phases;
  for (std::size_t i = 0; text && i < stages; ++i)
  {
    TriangulationStatistics::Stage stage{};
    text >> stage.ActivePartitions >> stage.MeshTriangles;
    s.Stages.push_back(stage);
  }
  for (std::size_t i = 0; text && i < phases; ++i)
  {
    TriangulationStatistics::Phase phase{};
    text >> phase.Seconds;
    std::getline(text >> std::ws, phase.Name);
    s.Phases.push_back(phase);
  }
  return bool(text);
}

/// The fastest of as many runs as fit into a tenth of a second. A single short run would mostly
/// measure the first access to memory and code.
Run fastestOfShort(const std::function<Run()>& work)
{
  constexpr double enough = 0.1;
  Run fastest = work();
  double spent = fastest.Seconds;
  for (int runs = 1; runs < 100 && spent < enough; ++runs)
  {
    Run run = work();
    spent += run.Seconds;
    if (run.Seconds < fastest.Seconds)
    {
      fastest = std::move(run);
    }
  }
  return fastest;
}

[[noreturn]] void workInChild(const std::function<Run()>& work, int out)
{
  int status = 1;
  try
  {
    Measurement m;
    // The peak of a forked process includes the memory that it shares with its parent.
    const double before = residentMegabytes();
    m.Result = fastestOfShort(work);
    m.PeakMegabytes = peakMegabytes();
    m.OwnMegabytes = m.PeakMegabytes - before;
    const std::string packed = pack(m);
    status = write(out, packed.data(), packed.size()) == ssize_t(packed.size()) ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "benchmarkDelaunay: %s\n", error.what());
  }
  _exit(status);
}

} // namespace

Measurement measure(const std::function<Run()>& work)
{
  int ends[2];
  std::fflush(nullptr);
  malloc_trim(0); // the child would have to copy freed pages before it reuses them
  if (pipe(ends) != 0)
  {
    throw std::runtime_error("no pipe to a measured process could be made");
  }
  const pid_t child = fork();
  if (child == 0)
  {
    workInChild(work, ends[1]);
  }
  close(ends[1]);
  std::string packed;
  char part[4096];
  for (ssize_t n; (n = read(ends[0], part, sizeof(part))) > 0;)
  {
    packed.append(part, std::size_t(n));
  }
  close(ends[0]);
  int status = 0;
  Measurement m;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0 || !unpack(packed, m))
  {
    throw std::runtime_error("a measured process failed (status " + std::to_string(status) + ")");
  }
  return m;
}

} // namespace benchmark
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
// Measures reading points from files, block by block.
#include "IoSubjects.h"

#include "Points/ReadPoints.h"

#include <chrono>
#include <cstdio>

namespace tipp
{
namespace benchmark
{

void benchmarkPoints(const IoArguments& arguments)
{
  for (const bool hasColumns : { false, true })
  {
    PointOptions options;
    options.Threads = arguments.Threads;
    options.Las.KeepOverlap = options.Las.KeepSynthetic = options.Las.KeepWithheld = true;
    if (!hasColumns)
    {
      options.Columns = { "z" };
    }
    const auto stream = openPointStream(arguments.Meshes, options);
    double seconds = 0;
    double processor = 0;
    std::int64_t points = 0;
    for (int run = 0; run <= arguments.Repeat; ++run) // the first run fills the system's cache
    {
      PointBlock block;
      points = 0;
      stream->rewind();
      const auto start = std::chrono::steady_clock::now();
      const double startProcessor = processorSeconds();
      while (stream->next(block, std::size_t(1) << 18))
      {
        points += std::int64_t(block.size());
      }
      const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
      if (run == 1 || (run > 1 && passed.count() < seconds))
      {
        seconds = passed.count();
        processor = processorSeconds() - startProcessor;
      }
    }
    std::printf(
      "%-24s %12lld points %8.3f s, %6.2f million points/s, %6.2f a second of processor\n",
      hasColumns ? "x, y, z and all columns" : "x, y, z", static_cast<long long>(points), seconds,
      double(points) / seconds / 1e6, double(points) / processor / 1e6);
  }
}

} // namespace benchmark
} // namespace tipp

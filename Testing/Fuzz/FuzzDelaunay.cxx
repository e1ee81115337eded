// SPDX-License-Identifier: BSD-3-Clause
// Draws point sets and options, triangulates, and compares with the oracle. A case is known by its
// number and the seed: 'fuzzDelaunay --seed S --case N' repeats one.
#include "Comparison.h"
#include "DegeneratePoints.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{

using namespace tipp;
using namespace tipp::test;

TriangulationOptions drawOptions(Engine& random)
{
  TriangulationOptions options;
  const int grids[][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 5, 3 }, { 1, 7 }, { 8, 8 } };
  const int* grid = grids[random() % 6];
  options.Columns = grid[0];
  options.Rows = grid[1];
  options.InitialPointsPerPartition = int(random() % 3);
  options.Order = random() % 2 ? Schedule::Stages : Schedule::Dynamic;
  options.Threads = 1 + int(random() % 3);
  return options;
}

/// Draws and compares one case; prints its points if it fails.
bool passes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq both{ seed, number };
  Engine random(both);
  const Coordinates xy = drawDegeneratePoints(random);
  const TriangulationOptions options = drawOptions(random);
  const auto outcome = matches(xy, triangulate(view(xy), options), reference(xy));
  if (outcome)
  {
    return true;
  }
  std::printf("case %llu of seed %llu, %s, %d initial points a partition: %s\n",
    (unsigned long long)number, (unsigned long long)seed, describe(options).c_str(),
    options.InitialPointsPerPartition, outcome.message());
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    std::printf("  %a, %a, // %zu: %.17g %.17g\n", xy[i], xy[i + 1], i / 2, xy[i], xy[i + 1]);
  }
  return false;
}

int usage()
{
  std::fputs("usage: fuzzDelaunay [--seconds N] [--seed S] [--case N]\n", stderr);
  return 2;
}

} // namespace

int main(int argc, char** argv)
{
  double seconds = 60;
  std::uint64_t seed = 1;
  for (int i = 1; i < argc; i += 2)
  {
    char* end = nullptr;
    const double value = i + 1 < argc ? std::strtod(argv[i + 1], &end) : -1;
    if (!(value >= 0) || *end != 0)
    {
      return usage();
    }
    if (std::strcmp(argv[i], "--seconds") == 0)
    {
      seconds = value;
    }
    else if (std::strcmp(argv[i], "--seed") == 0)
    {
      seed = std::uint64_t(value);
    }
    else if (std::strcmp(argv[i], "--case") == 0)
    {
      return passes(seed, std::uint64_t(value)) ? 0 : 1;
    }
    else
    {
      return usage();
    }
  }
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto end = now() + std::chrono::duration<double>(seconds);
  std::uint64_t cases = 0;
  std::uint64_t failures = 0;
  for (; now() < end && failures < 10; ++cases)
  {
    failures += passes(seed, cases) ? 0 : 1;
  }
  std::printf("%llu cases of seed %llu, %llu failures\n", (unsigned long long)cases,
    (unsigned long long)seed, (unsigned long long)failures);
  return failures == 0 ? 0 : 1;
}

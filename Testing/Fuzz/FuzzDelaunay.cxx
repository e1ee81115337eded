// SPDX-License-Identifier: BSD-3-Clause
// Draws point sets and options, triangulates them, and compares with the oracle. A seed and a
// number identify a case: 'fuzzDelaunay --seed S --case N' repeats it.
#include "Comparison.h"
#include "DegeneratePoints.h"
#include "FuzzDriver.h"

#include <cstdio>

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

/// Runs one case, and prints its points if it fails.
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

} // namespace

int main(int argc, char** argv)
{
  return fuzz("fuzzDelaunay", argc, argv, passes);
}

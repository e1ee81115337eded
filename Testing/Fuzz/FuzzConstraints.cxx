// SPDX-License-Identifier: BSD-3-Clause
// Draws point sets, constraints and options, triangulates them, and compares with the oracle. A
// seed and a number identify a case: 'fuzzConstraints --seed S --case N' repeats it.
#include "Comparison.h"
#include "ConstrainedOracle.h"
#include "DegeneratePoints.h"
#include "FuzzDriver.h"

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

namespace
{

using namespace tipp;
using namespace tipp::test;

std::vector<Constraint> drawConstraints(Engine& random, std::size_t points)
{
  std::vector<Constraint> constraints;
  if (points > 0)
  {
    const std::size_t count = random() % (random() % 3 == 0 ? 20 : 5);
    for (std::size_t i = 0; i < count; ++i)
    {
      constraints.push_back({ PointId(random() % points), PointId(random() % points) });
    }
  }
  return constraints;
}

TriangulationOptions drawOptions(Engine& random)
{
  TriangulationOptions options;
  const int sides[] = { 0, 1, 2, 5 };
  options.Columns = options.Rows = sides[random() % 4];
  options.Threads = random() % 8 == 0 ? 2 : 1;
  return options;
}

testing::AssertionResult check(const Coordinates& xy, const std::vector<Constraint>& constraints,
  const TriangulationOptions& options)
{
  try
  {
    return isConstrained(
      xy, constraints, triangulateConstrained(view(xy), constraints, CrossingRule::Split, options));
  }
  catch (const std::exception& error)
  {
    return testing::AssertionFailure() << "an exception: " << error.what();
  }
}

/// Runs one case, and prints it if it fails.
bool passes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq both{ seed, number };
  Engine random(both);
  const Coordinates xy = drawDegeneratePoints(random);
  const std::vector<Constraint> constraints = drawConstraints(random, xy.size() / 2);
  const TriangulationOptions options = drawOptions(random);
  const auto outcome = check(xy, constraints, options);
  if (outcome)
  {
    return true;
  }
  std::printf("case %llu of seed %llu, %s: %s\n", (unsigned long long)number,
    (unsigned long long)seed, describe(options).c_str(), outcome.message());
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    std::printf("  %a, %a, // %zu: %.17g %.17g\n", xy[i], xy[i + 1], i / 2, xy[i], xy[i + 1]);
  }
  for (const Constraint& constraint : constraints)
  {
    std::printf("  { %lld, %lld },\n", (long long)constraint.A, (long long)constraint.B);
  }
  return false;
}

} // namespace

int main(int argc, char** argv)
{
  return fuzz("fuzzConstraints", argc, argv, passes);
}

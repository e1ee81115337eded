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

/// Pairs of points, the segments of a star, a chain of segments, or constraints that follow each
/// other back and forth: overlapping ones, where points are on a line.
std::vector<Constraint> drawConstraints(Engine& random, std::size_t points)
{
  std::vector<Constraint> constraints;
  if (points == 0)
  {
    return constraints;
  }
  enum class Kind
  {
    Pairs,
    Star,
    Chain,
    BackAndForth
  };
  const Kind kinds[] = { Kind::Pairs, Kind::Pairs, Kind::Star, Kind::Chain, Kind::BackAndForth };
  const Kind kind = kinds[random() % 5];
  const std::size_t mosts[] = { 5, 5, 12, 25 };
  const std::size_t count = random() % mosts[random() % 4];
  const auto draw = [&] { return PointId(random() % points); };
  PointId from = draw();
  for (std::size_t i = 0; i < count; ++i)
  {
    const PointId to = draw();
    constraints.push_back({ from, to });
    if (kind == Kind::BackAndForth)
    {
      constraints.push_back({ to, draw() });
    }
    from = kind == Kind::Star ? from : kind == Kind::Chain ? to : draw();
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

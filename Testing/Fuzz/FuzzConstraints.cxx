// SPDX-License-Identifier: BSD-3-Clause
// Draws point sets, constraints and options, triangulates them in memory and out of core, and
// compares both with each other, with the oracle and with the checker. A seed and a number identify
// a case: 'fuzzConstraints --seed S --case N' repeats it. With TEST_TMPDIR=/dev/shm it is faster.
#include "ConstraintCases.h"
#include "FuzzDriver.h"
#include "TemporaryFolder.h"

#include "Constraints/OnDisk/ConstrainedStream.h"
#include "Files/IOError.h"
#include "OutOfCore/OutOfCoreTriangulation.h"

#include <cstdio>
#include <exception>
#include <string>

namespace
{

using namespace tipp;
using namespace tipp::test;

testing::AssertionResult isSameOnDisk(const ConstraintCase& drawn, const MadeInMemory& made)
{
  if (made.Points.size() == made.Result.Mesh.Rejected.size() && made.Refused.empty())
  {
    return testing::AssertionSuccess(); // out of core, no finite point is an error
  }
  const TemporaryFolder folder;
  ConstrainedStream points(drawn.stream(), drawn.Constraints, "constraints", 1);
  try
  {
    triangulateOutOfCore(points, folder.path("mesh.tipp"), drawn.OnDisk);
  }
  catch (const IOError& error)
  {
    return std::string(error.what()) == "constraints: " + made.Refused
      ? testing::AssertionSuccess()
      : testing::AssertionFailure() << "out of core: " << error.what();
  }
  if (!made.Refused.empty())
  {
    return testing::AssertionFailure() << "out of core the crossing is not refused";
  }
  const auto outcome = isSameMesh(folder.path("mesh.tipp"), made);
  return outcome ? outcome : testing::AssertionFailure() << "out of core: " << outcome.message();
}

testing::AssertionResult check(const ConstraintCase& drawn)
{
  try
  {
    const MadeInMemory made = makeInMemory(drawn);
    const auto outcome = isRight(drawn, made);
    return outcome ? isSameOnDisk(drawn, made) : outcome;
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
  const ConstraintCase drawn = drawConstraintCase(random);
  const auto outcome = check(drawn);
  if (!outcome)
  {
    std::printf("case %llu of seed %llu, %s: %s\n", (unsigned long long)number,
      (unsigned long long)seed, describe(drawn.Options).c_str(), outcome.message());
    drawn.print();
  }
  return bool(outcome);
}

} // namespace

int main(int argc, char** argv)
{
  return fuzz("fuzzConstraints", argc, argv, passes);
}

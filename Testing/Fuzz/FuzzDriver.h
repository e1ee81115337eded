// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFuzzDriver_h
#define tippFuzzDriver_h

#include <cstdint>

namespace tipp
{
namespace test
{

/// main() of a fuzzer. `NAME [--seconds N | --cases N] [--seed S] [--case N]` runs one case after
/// the other for N seconds (60 by default) or until N cases are done, or runs only the given case.
/// `passes` must derive the case from the seed and the number alone, print an error, and return
/// whether the case passed. If all ranks of an MPI program call this, passes() must return the same
/// on all of them, and so must goesOn(), which gets whether this rank has time left.
int fuzz(
  const char* name, int argc, char** argv, bool (*passes)(std::uint64_t seed, std::uint64_t number),
  bool (*goesOn)(bool hasTime) = [](bool hasTime) { return hasTime; });

} // namespace test
} // namespace tipp

#endif

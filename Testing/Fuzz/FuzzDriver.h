// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFuzzDriver_h
#define tippFuzzDriver_h

#include <cstdint>

namespace tipp
{
namespace test
{

/// main() of a fuzzer: `NAME [--seconds N] [--seed S] [--case N]` runs cases by number for N
/// seconds (60), or the one case. `passes` draws a case from the seed and the number alone, and
/// prints what is wrong if it does not pass.
int fuzz(const char* name, int argc, char** argv,
  bool (*passes)(std::uint64_t seed, std::uint64_t number));

} // namespace test
} // namespace tipp

#endif

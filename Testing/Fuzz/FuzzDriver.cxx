// SPDX-License-Identifier: BSD-3-Clause
#include "FuzzDriver.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace tipp
{
namespace test
{
namespace
{

int usage(const char* name)
{
  std::fprintf(stderr, "usage: %s [--seconds N | --cases N] [--seed S] [--case N]\n", name);
  return 2;
}

} // namespace

int fuzz(const char* name, int argc, char** argv,
  bool (*passes)(std::uint64_t seed, std::uint64_t number), bool (*goesOn)(bool hasTime))
{
  double seconds = 60;
  std::uint64_t most = UINT64_MAX;
  std::uint64_t seed = 1;
  for (int i = 1; i < argc; i += 2)
  {
    char* end = nullptr;
    const double value = i + 1 < argc ? std::strtod(argv[i + 1], &end) : -1;
    if (!(value >= 0) || *end != 0)
    {
      return usage(name);
    }
    if (std::strcmp(argv[i], "--seconds") == 0)
    {
      seconds = value;
    }
    else if (std::strcmp(argv[i], "--cases") == 0)
    {
      most = std::uint64_t(value);
      seconds = HUGE_VAL;
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
      return usage(name);
    }
  }
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto begin = now();
  const auto hasTime = [&]
  { return std::chrono::duration<double>(now() - begin).count() < seconds; };
  std::uint64_t cases = 0;
  std::uint64_t failures = 0;
  for (; cases < most && failures < 10 && goesOn(hasTime()); ++cases)
  {
    failures += passes(seed, cases) ? 0 : 1;
  }
  std::printf("%llu cases of seed %llu, %llu failures\n", (unsigned long long)cases,
    (unsigned long long)seed, (unsigned long long)failures);
  return failures == 0 ? 0 : 1;
}

} // namespace test
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
// A signed overflow: adds to the largest int.
#include <limits>

int main(int argc, char**)
{
  const int sum = std::numeric_limits<int>::max() + argc;
  return sum < 0 ? 1 : 0;
}

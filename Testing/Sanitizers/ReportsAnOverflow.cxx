// SPDX-License-Identifier: BSD-3-Clause
// A buffer overflow: reads one element past the end of a heap block.
#include <vector>

int main(int argc, char**)
{
  std::vector<int> values(10, 0);
  return values.data()[9 + argc];
}

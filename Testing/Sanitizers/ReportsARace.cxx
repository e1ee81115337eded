// SPDX-License-Identifier: BSD-3-Clause
// A data race: several threads add to one variable without synchronization.
#include <cstdio>

int main()
{
  long sum = 0;
#pragma omp parallel for num_threads(4)
  for (int i = 0; i < 1000; ++i)
  {
    sum += i;
  }
  std::printf("%ld\n", sum);
  return 0;
}

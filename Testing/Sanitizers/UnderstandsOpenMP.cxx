// SPDX-License-Identifier: BSD-3-Clause
// Shares data between threads in every way that the project uses, always synchronized by OpenMP or
// an atomic. Any report would be a false positive.
#include <omp.h>

#include <atomic>
#include <cstdlib>
#include <vector>

namespace
{

constexpr int Size = 1000;

struct Shared
{
  std::vector<int> Values = std::vector<int>(Size);
  std::vector<int> Claims = std::vector<int>(Size);
  std::atomic<int> Next{ 0 };
  omp_lock_t Lock;
  long Sum = 0;
  long Visits = 0;
  long Locked = 0;
};

void loops(Shared& shared)
{
#pragma omp for
  for (int i = 0; i < Size; ++i)
  {
    shared.Values[i] = i;
  }
  long sum = 0;
#pragma omp for schedule(dynamic, 7)
  for (int i = 0; i < Size; ++i)
  {
    sum += shared.Values[Size - 1 - i];
  }
#pragma omp atomic
  shared.Sum += sum;
}

void claims(Shared& shared)
{
  for (int i = shared.Next++; i < Size; i = shared.Next++)
  {
    ++shared.Claims[i];
#pragma omp critical(visit)
    ++shared.Visits;
    omp_set_lock(&shared.Lock);
    ++shared.Locked;
    omp_unset_lock(&shared.Lock);
  }
#pragma omp barrier
#pragma omp single
  shared.Values[0] += shared.Claims[Size - 1];
}

}

int main()
{
  for (int repeat = 0; repeat < 20; ++repeat)
  {
    Shared shared;
    omp_init_lock(&shared.Lock);
#pragma omp parallel num_threads(4)
    {
      loops(shared);
      claims(shared);
    }
    omp_destroy_lock(&shared.Lock);
    long reduced = 0;
#pragma omp parallel for num_threads(4) reduction(+ : reduced)
    for (int i = 0; i < Size; ++i)
    {
      reduced += shared.Claims[i];
    }
    if (shared.Sum != Size * (Size - 1L) / 2 || shared.Visits != Size || shared.Locked != Size ||
      reduced != Size || shared.Values[0] != 1)
    {
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}

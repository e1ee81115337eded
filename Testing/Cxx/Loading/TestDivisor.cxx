// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/ArrayFiles.h"

#include <gtest/gtest.h>

#include <random>

TEST(Divisor, DividesAsTheProcessorDoes)
{
  std::mt19937_64 random(3);
  for (int i = 0; i < 200000; ++i)
  {
    const std::uint64_t divisor = (random() >> random() % 63) | 1;
    const std::uint64_t dividend = random() >> (1 + random() % 63);
    for (const std::uint64_t d : { divisor, divisor - 1 + (divisor == 1), std::uint64_t(1) })
    {
      const tipp::Divisor by(d);
      ASSERT_EQ(dividend / d, by.quotient(dividend)) << dividend << " / " << d;
      const std::uint64_t multiple = dividend / d * d;
      ASSERT_EQ(dividend / d, by.quotient(multiple)) << multiple << " / " << d;
    }
  }
}

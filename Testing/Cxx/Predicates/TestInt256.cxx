// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactArithmetic.h"

#include <gtest/gtest.h>

#include <gmpxx.h>

#include <random>

namespace
{

using tipp::Int128;
using tipp::Int256;
using tipp::UInt128;

const Int128 Largest = static_cast<Int128>(~UInt128{ 0 } >> 1);
const Int128 Smallest = -Largest - 1;

mpz_class toGmp(Int128 value)
{
  mpz_class result(static_cast<long>(value >> 64));
  result <<= 64;
  return result + static_cast<unsigned long>(value);
}

// A number of random length with random digits.
Int128 draw(std::mt19937_64& engine)
{
  const UInt128 digits = (static_cast<UInt128>(engine()) << 64) | engine();
  return static_cast<Int128>(digits) >> (engine() % 128);
}

} // namespace

TEST(Int256, SignOfProductsAtTheEndsOfTheRange)
{
  EXPECT_EQ(1, Int256::product(Largest, Largest).sign());
  EXPECT_EQ(1, Int256::product(Smallest, Smallest).sign());
  EXPECT_EQ(-1, Int256::product(Smallest, Largest).sign());
  EXPECT_EQ(-1, Int256::product(-1, 1).sign());
  EXPECT_EQ(0, Int256::product(0, Smallest).sign());
}

TEST(Int256, ShiftAndBitLengthAgree)
{
  for (const Int128 factor : { Int128(1), Int128(-1), Int128(3), Int128(-3) })
  {
    const int digits = factor == 3 || factor == -3 ? 2 : (factor == 1 ? 1 : 0);
    for (unsigned places = 0; places < 250; ++places)
    {
      Int256 value = Int256::product(factor, 1);
      value <<= places;
      EXPECT_EQ(digits + int(places), value.bitLength()) << places;
      EXPECT_EQ(factor < 0 ? -1 : 1, value.sign()) << places;
    }
  }
  EXPECT_EQ(0, Int256().bitLength());
  EXPECT_EQ(254, Int256::product(Largest, Largest).bitLength());
  EXPECT_EQ(254, Int256::product(Smallest, Largest).bitLength());
}

TEST(Int256, SignOfASumOfProductsAgreesWithGmp)
{
  std::mt19937_64 engine(1);
  for (int i = 0; i < 100000; ++i)
  {
    // Below 2^126, so that the sum of four products fits into 256 bits.
    Int128 v[8];
    for (Int128& value : v)
    {
      value = draw(engine) / 2;
    }
    // The sum almost cancels: the last product is the first one with the opposite sign, except for
    // 1.
    v[6] = -v[0];
    v[7] = v[1] + (i % 3 - 1);
    Int256 sum = Int256::product(v[0], v[1]);
    mpz_class expected = toGmp(v[0]) * toGmp(v[1]);
    const int first = i % 2 == 0 ? 2 : 6;
    for (int j = first; j < 8; j += 2)
    {
      sum += Int256::product(v[j], v[j + 1]);
      expected += toGmp(v[j]) * toGmp(v[j + 1]);
    }
    ASSERT_EQ(sgn(expected), sum.sign());
  }
}

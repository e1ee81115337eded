// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Dyadic.h"
#include "Predicates/Fraction.h"

#include <gtest/gtest.h>

#include <gmpxx.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace
{

using tipp::Dyadic;
using tipp::Fraction;

constexpr double Smallest = std::numeric_limits<double>::denorm_min();
constexpr double Largest = std::numeric_limits<double>::max();

mpq_class powerOfTwo(int exponent)
{
  mpq_class power = 1;
  exponent < 0 ? power >>= mp_bitcnt_t(-exponent) : power <<= mp_bitcnt_t(exponent);
  return power;
}

/// The number as GMP has it: 52 digits after 52 digits are taken off until nothing is left.
mpq_class toGmp(Dyadic number)
{
  mpq_class result = 0;
  while (number.sign() != 0)
  {
    const auto [fraction, exponent] = number.rounded();
    result += mpq_class(fraction) * powerOfTwo(exponent);
    Dyadic part = fraction;
    for (int left = exponent; left != 0;)
    {
      const int step = std::max(-1000, std::min(1000, left));
      part = part * std::ldexp(1.0, step);
      left -= step;
    }
    number = number - part;
  }
  return result;
}

/// Finite doubles of all bit patterns: mostly of very different exponents, some subnormal.
double drawAny(std::mt19937_64& random)
{
  for (;;)
  {
    std::uint64_t pattern = random();
    pattern &= random() % 8 == 0 ? ~(std::uint64_t{ 0x7ff } << 52) : ~std::uint64_t{ 0 };
    double value;
    std::memcpy(&value, &pattern, sizeof value);
    if (std::isfinite(value))
    {
      return value;
    }
  }
}

/// Few digits, so that sums cancel.
double drawShort(std::mt19937_64& random)
{
  return std::ldexp(double(random() % 16) - 8, int(random() % 200) - 100);
}

/// A number and GMP's.
using Pair = std::pair<Dyadic, mpq_class>;

/// Sums, differences and products of numbers drawn.
std::vector<Pair> drawNumbers(std::mt19937_64& random, double (*draw)(std::mt19937_64&))
{
  std::vector<Pair> numbers;
  for (int i = 0; i < 4; ++i)
  {
    const double value = draw(random);
    numbers.emplace_back(value, value);
  }
  for (int i = 0; i < 8; ++i)
  {
    const Pair& a = numbers[random() % numbers.size()];
    const Pair& b = numbers[random() % numbers.size()];
    switch (random() % 3)
    {
      case 0:
        numbers.emplace_back(a.first + b.first, a.second + b.second);
        break;
      case 1:
        numbers.emplace_back(a.first - b.first, a.second - b.second);
        break;
      default:
        numbers.emplace_back(a.first * b.first, a.second * b.second);
    }
  }
  return numbers;
}

/// Whether no double is nearer to the number: its distance from each neighbour's middle decides.
bool isNearest(double value, const mpq_class& number)
{
  const mpq_class exact(value);
  const mpq_class above = (exact + mpq_class(std::nextafter(value, HUGE_VAL))) / 2;
  const mpq_class below = (exact + mpq_class(std::nextafter(value, -HUGE_VAL))) / 2;
  std::uint64_t pattern;
  std::memcpy(&pattern, &value, sizeof pattern);
  return (pattern & 1) == 0 ? below <= number && number <= above : below < number && number < above;
}

} // namespace

TEST(Dyadic, HoldsEveryDouble)
{
  std::mt19937_64 random(1);
  for (const double value : { 0.0, -0.0, 1.0, -3.0, 0x1p64, 0x1p-64, Smallest, -Smallest, Largest,
         -Largest, std::numeric_limits<double>::min() })
  {
    EXPECT_EQ(mpq_class(value), toGmp(value)) << value;
  }
  for (int i = 0; i < 1000; ++i)
  {
    const double value = drawAny(random);
    ASSERT_EQ(mpq_class(value), toGmp(value)) << value;
  }
}

TEST(Dyadic, OperationsAreExactOnAnyDoubles)
{
  std::mt19937_64 random(2);
  for (int i = 0; i < 50; ++i)
  {
    for (const auto& [number, expected] : drawNumbers(random, drawAny))
    {
      ASSERT_EQ(expected, toGmp(number)) << i;
      ASSERT_EQ(sgn(expected), number.sign()) << i;
    }
  }
}

TEST(Dyadic, OperationsAreExactWhereDigitsCancel)
{
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i)
  {
    for (const auto& [number, expected] : drawNumbers(random, drawShort))
    {
      ASSERT_EQ(expected, toGmp(number)) << i;
      ASSERT_EQ(sgn(expected), number.sign()) << i;
    }
  }
}

TEST(Dyadic, ComparisonFindsTheSmallestDifference)
{
  const Dyadic huge = Dyadic(Largest) * Dyadic(Largest);
  const Dyadic tiny = Dyadic(Smallest) * Dyadic(Smallest);
  EXPECT_EQ(1, compare(huge + tiny, huge));
  EXPECT_EQ(-1, compare(-huge - tiny, -huge));
  EXPECT_EQ(0, compare(huge + tiny - huge, tiny));
}

TEST(Dyadic, CopiesAndMovesKeepLongNumbers)
{
  Dyadic number = Dyadic(Largest) * Dyadic(Largest) + Smallest;
  const mpq_class expected = mpq_class(Largest) * mpq_class(Largest) + mpq_class(Smallest);
  Dyadic copy;
  copy = number;
  const Dyadic moved = std::move(number);
  EXPECT_EQ(expected, toGmp(moved));
  copy = Dyadic(5);
  EXPECT_EQ(5, toGmp(copy));
}

TEST(Dyadic, QuotientIsTheNearestDouble)
{
  std::mt19937_64 random(4);
  for (int i = 0; i < 3000; ++i)
  {
    const bool isAny = i % 2 == 0;
    const double a = isAny ? drawAny(random) : drawShort(random);
    const double b = isAny ? drawAny(random) : drawShort(random);
    const mpq_class exact = b != 0 ? mpq_class(a) / mpq_class(b) : mpq_class(0);
    if (b != 0 && abs(exact) <= mpq_class(Largest))
    {
      ASSERT_PRED2(isNearest, tipp::nearestQuotient(a, b), exact) << a << " " << b;
    }
  }
}

TEST(Dyadic, QuotientHalfwayBetweenDoublesIsTheEvenOne)
{
  EXPECT_EQ(1.0, tipp::nearestQuotient(Dyadic(1) + 0x1p-53, 1));
  EXPECT_EQ(1 + 0x1p-51, tipp::nearestQuotient(Dyadic(-1) - 3 * 0x1p-53, -1));
  EXPECT_EQ(0, tipp::nearestQuotient(Smallest, 2));
  EXPECT_EQ(2 * Smallest, tipp::nearestQuotient(3 * Smallest, 2));
}

TEST(Dyadic, QuotientBeyondTheLargestDoubleIsInfinite)
{
  EXPECT_EQ(HUGE_VAL, tipp::nearestQuotient(Largest, 0.5));
  EXPECT_EQ(-HUGE_VAL, tipp::nearestQuotient(-Largest, 0.5));
  EXPECT_EQ(Largest, tipp::nearestQuotient(Dyadic(Largest) + 1, 1));
}

TEST(Dyadic, RootIsTheNearestDouble)
{
  std::mt19937_64 random(5);
  for (int i = 0; i < 2000; ++i)
  {
    const double a = std::fabs(i % 2 == 0 ? drawAny(random) : drawShort(random));
    const double b = std::fabs(i % 2 == 0 ? drawAny(random) : drawShort(random)) + Smallest;
    const double root = tipp::nearestRoot(a, b);
    if (a == 0)
    {
      EXPECT_EQ(0, root);
      continue;
    }
    const mpq_class exact = mpq_class(a) / mpq_class(b);
    const mpq_class above = mpq_class(root) + mpq_class(std::nextafter(root, HUGE_VAL));
    const mpq_class below = mpq_class(root) + mpq_class(std::nextafter(root, 0));
    ASSERT_LE(exact * 4, above * above) << a << " " << b;
    ASSERT_GE(exact * 4, below * below) << a << " " << b;
  }
}

TEST(Dyadic, RootBelowTheSmallestDoubleIsZero)
{
  const Dyadic square = Dyadic(Smallest) * Dyadic(Smallest); // 2^-2148
  EXPECT_EQ(Smallest, tipp::nearestRoot(square, 1));
  EXPECT_EQ(0, tipp::nearestRoot(square, 16));
}

TEST(Fraction, OperationsAreThoseOfRationals)
{
  std::mt19937_64 random(6);
  for (int i = 0; i < 500; ++i)
  {
    const double v[4] = { drawShort(random), drawShort(random), drawAny(random),
      drawShort(random) };
    if (v[1] == 0 || v[3] == 0)
    {
      continue;
    }
    const Fraction a = Fraction(v[0]) / v[1];
    const Fraction b = Fraction(v[2]) / v[3];
    const mpq_class exactA = mpq_class(v[0]) / mpq_class(v[1]);
    const mpq_class exactB = mpq_class(v[2]) / mpq_class(v[3]);
    // The same denominator, and different ones.
    const Fraction value = (a + a - b) * b;
    const mpq_class expected = (exactA + exactA - exactB) * exactB;
    ASSERT_EQ(sgn(exactA - exactB), compare(a, b)) << i;
    ASSERT_EQ(sgn(expected), compare(value, 0)) << i;
    ASSERT_EQ(0, compare(value / b + b, a + a)) << i;
  }
}

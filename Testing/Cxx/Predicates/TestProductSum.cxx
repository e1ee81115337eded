// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/ExactArithmetic.h"

#include <gtest/gtest.h>

#include <gmpxx.h>

#include <algorithm>
#include <random>
#include <vector>

namespace
{

using tipp::BinaryNumber;
using tipp::binaryNumber;

/// A factor with up to 106 bits, made as the product of two doubles.
struct Factor
{
  double A;
  double B;

  BinaryNumber binary() const { return binaryNumber(this->A) * binaryNumber(this->B); }
  mpq_class exact() const { return mpq_class(this->A) * mpq_class(this->B); }
};

struct Product
{
  Factor Left;
  Factor Right;
};

int exactSign(const std::vector<Product>& products)
{
  mpq_class sum = 0;
  for (const Product& product : products)
  {
    sum += product.Left.exact() * product.Right.exact();
  }
  return sgn(sum);
}

int computedSign(const std::vector<Product>& products)
{
  tipp::ProductSum<48, 212> sum;
  for (const Product& product : products)
  {
    sum.add(product.Left.binary(), product.Right.binary());
  }
  return sum.sign();
}

double draw(std::mt19937_64& random, int exponents)
{
  const double mantissa = random() % 4 == 0 ? double(random() % 5) : double(random() >> 11);
  const double sign = random() % 2 == 0 ? 1 : -1;
  return std::ldexp(sign * mantissa, int(random() % std::uint64_t(exponents)) - exponents / 2);
}

std::vector<Product> drawProducts(std::mt19937_64& random, int exponents)
{
  std::vector<Product> products;
  for (std::uint64_t i = random() % 12; i > 0; --i)
  {
    products.push_back({ { draw(random, exponents), draw(random, exponents) },
      { draw(random, exponents), draw(random, exponents) } });
  }
  return products;
}

/// Appends the negative of every product, with exchanged factors, so that the sum is zero.
void cancel(std::vector<Product>& products)
{
  for (std::size_t i = 0, count = products.size(); i < count; ++i)
  {
    const Product& p = products[i];
    products.push_back({ { -p.Right.B, p.Left.A }, { p.Right.A, p.Left.B } });
  }
}

} // namespace

TEST(ProductSum, OfNothingIsZero)
{
  EXPECT_EQ(0, computedSign({}));
  EXPECT_EQ(0, computedSign({ { { 0, 1 }, { 1e300, 1 } } }));
}

TEST(ProductSum, SmallestTermDecidesWhereAllOthersCancel)
{
  const double tiny = 4.9406564584124654e-324;
  std::vector<Product> products(20, { { 1e308, 1e308 }, { 1e308, 1e308 } });
  cancel(products);
  products.push_back({ { tiny, -tiny }, { tiny, tiny } });
  EXPECT_EQ(-1, computedSign(products));
}

TEST(ProductSum, ManyEqualTermsOutweighALargerOne)
{
  std::vector<Product> products(40, { { 1.999, 1.999 }, { 1.999, 1.999 } });
  products.push_back({ { -512, 1 }, { 1, 1 } });
  EXPECT_EQ(exactSign(products), computedSign(products));
  EXPECT_EQ(1, computedSign(products));
}

TEST(ProductSum, SignIsThatOfRationals)
{
  std::mt19937_64 random(1);
  for (const int exponents : { 1, 10, 60, 300, 1800 })
  {
    for (int i = 0; i < 2000; ++i)
    {
      std::vector<Product> products = drawProducts(random, exponents);
      if (i % 2 == 0)
      {
        cancel(products);
        const std::vector<Product> rest = drawProducts(random, exponents);
        products.insert(products.end(), rest.begin(), rest.end());
      }
      std::shuffle(products.begin(), products.end(), random);
      ASSERT_EQ(exactSign(products), computedSign(products)) << exponents << " " << i;
    }
  }
}

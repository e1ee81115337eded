// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCommonExponent_h
#define tippCommonExponent_h

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstddef>

namespace tipp
{

/// Multiplies finite doubles by one power of two that makes them all integers of arbitrary length.
/// Exact for every finite double; 1e-310 and 1e300 together take 2,000 bits. `exponent`, if not
/// null, receives the exponent of the integers' unit.
template <std::size_t N>
std::array<mpz_class, N> toCommonExponent(
  const std::array<double, N>& values, int* exponent = nullptr)
{
  constexpr int digits = 53;
  std::array<double, N> mantissas;
  std::array<int, N> exponents;
  int lowest = INT_MAX;
  for (std::size_t i = 0; i < N; ++i)
  {
    mantissas[i] = std::ldexp(std::frexp(values[i], &exponents[i]), digits);
    if (values[i] != 0.0)
    {
      lowest = std::min(lowest, exponents[i]);
    }
  }
  std::array<mpz_class, N> integers;
  for (std::size_t i = 0; i < N; ++i)
  {
    if (values[i] != 0.0)
    {
      integers[i] = mantissas[i];
      integers[i] <<= static_cast<mp_bitcnt_t>(exponents[i] - lowest);
    }
  }
  if (exponent)
  {
    *exponent = lowest == INT_MAX ? 0 : lowest - digits;
  }
  return integers;
}

} // namespace tipp

#endif

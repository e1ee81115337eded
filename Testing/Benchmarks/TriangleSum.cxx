// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"

#include <cstring>

namespace tipp
{
namespace benchmark
{
namespace
{

/// The last step of splitmix64: every bit of the input affects every bit of the result.
std::uint64_t mix(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t hash(const double p[2])
{
  const double unsignedZeros[2] = { p[0] + 0.0, p[1] + 0.0 };
  std::uint64_t bits[2];
  std::memcpy(bits, unsignedZeros, sizeof(bits));
  return mix(bits[0] + mix(bits[1]));
}

} // namespace

void TriangleSum::add(const double a[2], const double b[2], const double c[2])
{
  // The sum over the corners does not depend on which corner is first.
  this->Sum += mix(hash(a) + hash(b) + hash(c));
}

} // namespace benchmark
} // namespace tipp

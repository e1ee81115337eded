// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDivisor_h
#define tippDivisor_h

#include <cstdint>

namespace tipp
{

/// Divides numbers below 2^63 by an invariant divisor, at the cost of a multiplication.
class Divisor
{
public:
  explicit Divisor(std::uint64_t divisor)
    : Value(divisor)
    , Reciprocal(~std::uint64_t(0) / divisor)
  {
  }

  std::uint64_t quotient(std::uint64_t dividend) const
  {
    __extension__ using Wide = unsigned __int128;
    // The reciprocal is too small by less than two, so the quotient by at most one.
    const auto low = std::uint64_t(Wide(dividend) * this->Reciprocal >> 64);
    return low + (dividend - low * this->Value >= this->Value ? 1 : 0);
  }

private:
  std::uint64_t Value;
  std::uint64_t Reciprocal;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInt256_h
#define tippInt256_h

#include "Predicates/Int128.h"

#include <cstdint>

namespace tipp
{

/// A 256-bit two's complement integer with the operations that the sign of a sum of products needs.
/// Sums wrap modulo 2^256, so partial sums may exceed the range if the final sum does not.
class Int256
{
public:
  Int256() = default;

  /// The full product, exact for all operands.
  static Int256 product(Int128 a, Int128 b)
  {
    const UInt128 ua = static_cast<UInt128>(a);
    const UInt128 ub = static_cast<UInt128>(b);
    Int256 result = unsignedProduct(ua, ub);
    // As an unsigned number a negative operand is too large by 2^128: subtract the other operand
    // from the upper half.
    result.High -= (a < 0 ? ub : 0) + (b < 0 ? ua : 0);
    return result;
  }

  Int256& operator+=(const Int256& other)
  {
    this->Low += other.Low;
    this->High += other.High + (this->Low < other.Low ? 1 : 0);
    return *this;
  }

  /// By less than 256 bits; bits beyond the range are lost.
  Int256& operator<<=(unsigned bits)
  {
    if (bits >= 128)
    {
      this->High = this->Low << (bits - 128);
      this->Low = 0;
    }
    else if (bits > 0)
    {
      this->High = this->High << bits | this->Low >> (128 - bits);
      this->Low <<= bits;
    }
    return *this;
  }

  /// The n for which 2^(n-1) <= value < 2^n, or 2^(n-1) < -value <= 2^n if it is negative.
  int bitLength() const
  {
    const UInt128 flip = this->sign() < 0 ? ~UInt128(0) : 0;
    const UInt128 high = this->High ^ flip;
    return high != 0 ? 128 + bitLength(high) : bitLength(this->Low ^ flip);
  }

  /// -1, 0 or +1.
  int sign() const
  {
    if (static_cast<Int128>(this->High) < 0)
    {
      return -1;
    }
    return (this->High | this->Low) != 0 ? 1 : 0;
  }

private:
  static int bitLength(UInt128 value)
  {
    const std::uint64_t top = static_cast<std::uint64_t>(value >> 64);
    const std::uint64_t bottom = static_cast<std::uint64_t>(value);
    return top != 0 ? 128 - __builtin_clzll(top) : (bottom != 0 ? 64 - __builtin_clzll(bottom) : 0);
  }

  static Int256 unsignedProduct(UInt128 a, UInt128 b)
  {
    const std::uint64_t a0 = static_cast<std::uint64_t>(a);
    const std::uint64_t a1 = static_cast<std::uint64_t>(a >> 64);
    const std::uint64_t b0 = static_cast<std::uint64_t>(b);
    const std::uint64_t b1 = static_cast<std::uint64_t>(b >> 64);
    const UInt128 low = static_cast<UInt128>(a0) * b0;
    // (2^64 - 1)^2 + 2^64 - 1 < 2^128: neither of these sums wraps.
    const UInt128 cross = static_cast<UInt128>(a1) * b0 + (low >> 64);
    const UInt128 middle = static_cast<UInt128>(a0) * b1 + static_cast<std::uint64_t>(cross);
    Int256 result;
    result.Low = (middle << 64) | static_cast<std::uint64_t>(low);
    result.High = static_cast<UInt128>(a1) * b1 + (cross >> 64) + (middle >> 64);
    return result;
  }

  UInt128 Low = 0;
  UInt128 High = 0;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactArithmetic_h
#define tippExactArithmetic_h

#include "Predicates/Geometry.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace tipp
{

/// head + tail equals the difference of two doubles exactly.
struct ExactDifference
{
  double head;
  double tail;
};

/// Knuth's two-sum as Two-Diff of Shewchuk 1997 (theorem 7). It holds for all finite operands whose
/// difference does not overflow: sums of doubles cannot underflow.
inline ExactDifference exactDifference(double x, double y)
{
  const double head = x - y;
  const double yVirtual = x - head;
  const double xVirtual = head + yVirtual;
  return { head, (x - xVirtual) + (yVirtual - y) };
}

/// An exact sum of finite doubles, rounded once at the end: the same for any order of terms, unless
/// it overflows (Shewchuk 1997, GROW-EXPANSION; the rounding is that of Python's math.fsum).
class ExactSum
{
public:
  void add(double term)
  {
    std::size_t kept = 0;
    for (const double part : this->Parts)
    {
      double large = part;
      if (std::fabs(large) < std::fabs(term))
      {
        std::swap(large, term);
      }
      const double sum = large + term;
      const double rest = term - (sum - large);
      if (rest != 0)
      {
        this->Parts[kept++] = rest;
      }
      term = sum;
    }
    this->Parts.resize(kept);
    this->Parts.push_back(term);
  }

  void add(const ExactSum& other)
  {
    for (const double part : other.Parts)
    {
      this->add(part);
    }
  }

  /// The double nearest to the sum; ties go to the even one.
  double value() const
  {
    auto at = this->Parts.rbegin();
    const auto end = this->Parts.rend();
    double sum = at != end ? *at++ : 0;
    double rest = 0;
    while (at != end && rest == 0)
    {
      const double large = sum;
      sum = large + *at;
      rest = *at++ - (sum - large);
    }
    // An exact half was rounded to even above; the next lower part breaks the tie.
    if (at != end && rest != 0 && (rest < 0) == (*at < 0))
    {
      const double further = sum + 2 * rest;
      sum = further - sum == 2 * rest ? further : sum;
    }
    return sum;
  }

  template <typename Archive>
  friend void serialize(Archive& archive, ExactSum& sum)
  {
    archive(sum.Parts);
  }

private:
  std::vector<double> Parts; ///< non-overlapping, the largest last
};

/// The lowest and the highest binary digit of a set of doubles. With n = bits() and scale(), each
/// of them times scale() is an integer below 2^n in magnitude.
class BitSpan
{
public:
  void include(double value)
  {
    std::uint64_t pattern;
    std::memcpy(&pattern, &value, sizeof pattern);
    const int exponent = static_cast<int>(pattern >> 52) & 0x7ff;
    // The implicit bit bounds the count of trailing zeros by 52.
    const std::uint64_t mantissa = pattern | (std::uint64_t{ 1 } << 52);
    int low = exponent + __builtin_ctzll(mantissa);
    // Zero has no digit. Denormals get a position below all others: they have no scale.
    low = exponent != 0 ? low : (value != 0.0 ? Denormal : None);
    this->Low = low < this->Low ? low : this->Low;
    this->High = exponent > this->High ? exponent : this->High;
  }

  /// Includes both parts of x - y.
  void includeDifference(double x, double y)
  {
    const ExactDifference difference = exactDifference(x, y);
    this->include(difference.head);
    if (difference.tail != 0.0)
    {
      this->include(difference.tail);
    }
  }

  /// Whether the digits span at most `count` bits and the values can be scaled to integers without
  /// rounding.
  bool fits(int count) const { return this->bits() <= count && this->scalable(); }

  /// The number of bits from the lowest to the highest digit; not positive if all values are zero.
  int bits() const { return this->High + 53 - this->Low; }

  /// False if there are denormals, or if the scale would not be a normal number.
  bool scalable() const
  {
    return this->Low == None || (this->Low >= LowestField && this->High < 2046);
  }

  /// The power of two that scales the values to integers; scalable() must be true.
  double scale() const
  {
    // The lowest digit is 2^(Low - 1075); the exponent field of its reciprocal is 2098 - Low.
    const int field = this->Low == None ? 1023 : 2098 - this->Low;
    const std::uint64_t pattern = static_cast<std::uint64_t>(field) << 52;
    double result;
    std::memcpy(&result, &pattern, sizeof result);
    return result;
  }

private:
  static constexpr int None = 1 << 20;
  static constexpr int Denormal = -(1 << 20);
  static constexpr int LowestField = 52; // field 2046, the largest power of two

  int Low = None;
  int High = 0;
};

/// The difference x - y in units of 1/scale. Exact if scale comes from a BitSpan that includes
/// exactDifference(x, y) and spans at most 63 bits.
inline std::int64_t longUnits(double x, double y, double scale)
{
  const ExactDifference difference = exactDifference(x, y);
  return static_cast<std::int64_t>(difference.head * scale) +
    static_cast<std::int64_t>(difference.tail * scale);
}

// 128-bit integers are an extension of GCC and Clang; __extension__ avoids -Wpedantic warnings.
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

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

  /// Shifts by less than 256 bits; overflowing bits are lost.
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

  ///@{
  /// The lower and the upper 128 bits.
  UInt128 low() const { return this->Low; }
  UInt128 high() const { return this->High; }
  ///@}

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

/// Mantissa * 2^Exponent, exactly.
struct BinaryNumber
{
  Int128 Mantissa;
  int Exponent;
};

/// A finite double, with a mantissa of exactly 53 digits, or 0.
inline BinaryNumber binaryNumber(double value)
{
  constexpr int digits = 53;
  int exponent;
  const double fraction = std::frexp(value, &exponent);
  return { static_cast<std::int64_t>(fraction * 0x1p53), exponent - digits };
}

/// The product of the mantissas must fit in 127 digits.
inline BinaryNumber operator*(const BinaryNumber& a, const BinaryNumber& b)
{
  return { a.Mantissa * b.Mantissa, a.Exponent + b.Exponent };
}

inline BinaryNumber operator-(const BinaryNumber& a)
{
  return { -a.Mantissa, a.Exponent };
}

/// The exact sign of a sum of up to `Most` products whose exponents may differ by thousands. The
/// product of two mantissas must be below 2^Digits.
//
// Terms are added from the largest exponent down. As soon as the sum is larger than all remaining
// terms together can be, its sign is known. Until then it has at most Digits + CountDigits digits
// at the next term's exponent: 256 bits are enough for any exponents.
template <std::size_t Most, int Digits>
class ProductSum
{
public:
  void add(const BinaryNumber& a, const BinaryNumber& b)
  {
    if (a.Mantissa != 0 && b.Mantissa != 0)
    {
      this->Terms[this->Count] = { a.Mantissa, b.Mantissa };
      // Insertion sort: there are only a few.
      const int exponent = a.Exponent + b.Exponent;
      std::size_t at = this->Count++;
      for (; at > 0 && this->Order[at - 1].Exponent < exponent; --at)
      {
        this->Order[at] = this->Order[at - 1];
      }
      this->Order[at] = { exponent, static_cast<int>(this->Count - 1) };
    }
  }

  /// -1, 0 or +1.
  int sign()
  {
    const auto end = this->Order.begin() + static_cast<std::ptrdiff_t>(this->Count);
    Int256 sum;
    int exponent = 0;
    for (auto next = this->Order.begin(); next != end; ++next)
    {
      if (sum.sign() != 0)
      {
        const int shift = exponent - next->Exponent;
        if (sum.bitLength() + shift > Digits + CountDigits)
        {
          break;
        }
        sum <<= static_cast<unsigned>(shift);
      }
      exponent = next->Exponent;
      const Term& term = this->Terms[static_cast<std::size_t>(next->Term)];
      sum += Int256::product(term.A, term.B);
    }
    return sum.sign();
  }

private:
  static constexpr int CountDigits = 6;
  static_assert(Most <= (1U << CountDigits) && Digits + CountDigits + 2 <= 256,
    "the sum fits 256 bits with its sign");

  struct Term
  {
    Int128 A;
    Int128 B;
  };
  struct OrderedTerm
  {
    int Exponent;
    int Term;
  };

  std::array<Term, Most> Terms;
  std::array<OrderedTerm, Most> Order; ///< sorted by descending exponent
  std::size_t Count = 0;
};

// Signs of the two determinants over integer differences, in the narrowest integers that hold them.
// The suffix is the number of binary digits of every difference: |difference| < 2^digits.

/// Sign of u x v. Each product is below 2^2k, their difference below 2^(2k+1): 31 digits fit 64
/// bits.
inline int orientationSign31(std::int64_t ux, std::int64_t uy, std::int64_t vx, std::int64_t vy)
{
  return signOf(ux * vy - uy * vx);
}

/// The same with 63 digits, below 2^127.
inline int orientationSign63(std::int64_t ux, std::int64_t uy, std::int64_t vx, std::int64_t vy)
{
  return signOf(static_cast<Int128>(ux) * vy - static_cast<Int128>(uy) * vx);
}

/// Differences of the three triangle corners to the query point.
struct InCircleIntegers
{
  std::int64_t ax, ay, bx, by, cx, cy;
};

// Why k digits need 4k+4 bits, sign included. A lift is at most 2 (2^k - 1)^2 < 2^(2k+1), and by
// Cauchy-Schwarz so is the cross product of two differences, its two products each below 2^2k.
// The crosses' signs: if two terms share a sign, the determinant lies below 2 * 2^(4k+2) =
// 2^(4k+3). If all three do, it is at most (largest lift) * |sum of crosses|, and that sum is twice
// the area of a triangle in a square of side below 2^(k+1): below 2^(2k+1) * 2^(2k+2) = 2^(4k+3)
// again. Partial sums may be larger; they wrap, which does not change a last sum that fits.

/// Sign of the in-circle determinant for 31 digits: lifts and crosses below 2^63, sum below 2^127.
inline int inCircleSign31(const InCircleIntegers& d)
{
  const auto term = [](std::int64_t x, std::int64_t y, std::int64_t cross)
  { return static_cast<UInt128>(static_cast<Int128>(x * x + y * y) * cross); };
  const UInt128 sum = term(d.ax, d.ay, d.bx * d.cy - d.by * d.cx) +
    term(d.bx, d.by, d.cx * d.ay - d.cy * d.ax) + term(d.cx, d.cy, d.ax * d.by - d.ay * d.bx);
  return signOf(static_cast<Int128>(sum));
}

/// Sign of the in-circle determinant for 63 digits: lifts and crosses below 2^127, sum below 2^255.
inline int inCircleSign63(const InCircleIntegers& d)
{
  const auto times = [](std::int64_t x, std::int64_t y) { return static_cast<Int128>(x) * y; };
  const auto term = [&](std::int64_t x, std::int64_t y, Int128 cross)
  { return Int256::product(times(x, x) + times(y, y), cross); };
  Int256 sum = term(d.ax, d.ay, times(d.bx, d.cy) - times(d.by, d.cx));
  sum += term(d.bx, d.by, times(d.cx, d.ay) - times(d.cy, d.ax));
  sum += term(d.cx, d.cy, times(d.ax, d.by) - times(d.ay, d.bx));
  return sum.sign();
}

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippProductSum_h
#define tippProductSum_h

#include "Predicates/Int128.h"
#include "Predicates/Int256.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tipp
{

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
      // They are few: each is inserted where it belongs.
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
  struct Place
  {
    int Exponent;
    int Term;
  };

  std::array<Term, Most> Terms;
  std::array<Place, Most> Order; ///< falling exponents
  std::size_t Count = 0;
};

} // namespace tipp

#endif

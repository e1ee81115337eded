// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDyadic_h
#define tippDyadic_h

#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace tipp
{

/// A number with a fraction of 0.5 to 1 in magnitude, or 0, times 2^Exponent.
struct ScaledDouble
{
  double Fraction;
  int Exponent;
};

/// A dyadic rational: an integer of any length times a power of two. Every finite double is one,
/// and sums, differences and products are exact.
//
// Digits have base 2^64, so that summands are aligned by whole digits. Most numbers are short.
// They are kept without an allocation.
class VTKTIPPACCELERATORS_EXPORT Dyadic
{
public:
  Dyadic() = default;
  /// `value` must be finite.
  Dyadic(double value);
  Dyadic(const Dyadic& other);
  Dyadic(Dyadic&& other) noexcept { this->take(other); }
  Dyadic& operator=(const Dyadic& other) { return *this = Dyadic(other); }
  Dyadic& operator=(Dyadic&& other) noexcept
  {
    this->take(other);
    return *this;
  }
  ~Dyadic() = default;

  Dyadic operator-() const;
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) { return sum(a, b, b.Negative); }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return sum(a, b, !b.Negative); }
  friend VTKTIPPACCELERATORS_EXPORT Dyadic operator*(const Dyadic& a, const Dyadic& b);
  Dyadic& operator+=(const Dyadic& other) { return *this = *this + other; }

  /// The sign of a - b.
  friend int compare(const Dyadic& a, const Dyadic& b) { return (a - b).sign(); }

  /// -1, 0 or +1.
  int sign() const { return this->Count == 0 ? 0 : this->Negative ? -1 : 1; }

  /// The number within 2^-52 of its magnitude.
  ScaledDouble rounded() const;

private:
  Dyadic(std::ptrdiff_t low, std::size_t count);
  static Dyadic sum(const Dyadic& a, const Dyadic& b, bool isNegativeB);
  static bool isShorter(const Dyadic& a, const Dyadic& b);
  void take(Dyadic& other) noexcept;
  void trim();

  std::uint64_t* digits() { return this->Heap ? this->Heap.get() : this->Own.data(); }
  const std::uint64_t* digits() const { return this->Heap ? this->Heap.get() : this->Own.data(); }
  std::ptrdiff_t high() const { return this->Low + static_cast<std::ptrdiff_t>(this->Count); }
  std::uint64_t digitAt(std::ptrdiff_t position) const
  {
    return position < this->Low ? 0 : this->digits()[position - this->Low];
  }

  std::unique_ptr<std::uint64_t[]> Heap; ///< null if Own holds the digits
  static constexpr std::size_t OwnCount = 16;
  std::array<std::uint64_t, OwnCount> Own; ///< lowest digit first
  std::size_t Count = 0;                   ///< the last digit is not 0
  std::ptrdiff_t Low = 0;                  ///< the first digit counts 2^(64 * Low)
  bool Negative = false;
};

/// The double nearest to numerator / denominator; ties go to the even one. 0 if the numerator is 0.
/// Otherwise the denominator must not be 0.
VTKTIPPACCELERATORS_EXPORT double nearestQuotient(
  const Dyadic& numerator, const Dyadic& denominator);

/// The double nearest to the square root of a quotient that is not negative.
VTKTIPPACCELERATORS_EXPORT double nearestRoot(const Dyadic& numerator, const Dyadic& denominator);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRandom_h
#define tippRandom_h

#include <array>
#include <cmath>
#include <cstdint>

namespace tipp
{

/// Mixes the bits of a number: SplitMix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number
/// Generators, 2014) with this state.
inline std::uint64_t mixBits(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// xoshiro256++ (Blackman and Vigna, 2021), seeded through SplitMix64. Everything derived from it
/// uses only the basic operations and the square root, which IEEE 754 rounds correctly, so the
/// numbers are the same on every platform; those of std:: distributions and libm's log are not.
class Random
{
public:
  explicit Random(std::uint64_t seed)
  {
    for (std::uint64_t& word : this->State)
    {
      word = mixBits(seed);
      seed += 0x9e3779b97f4a7c15u;
    }
  }

  std::uint64_t bits()
  {
    auto& s = this->State;
    const std::uint64_t result = rotate(s[0] + s[3], 23) + s[0];
    const std::uint64_t t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rotate(s[3], 45);
    return result;
  }

  /// In [0, 1), a multiple of 2^-53.
  double uniform() { return double(this->bits() >> 11) * 0x1p-53; }

  double uniform(double low, double high) { return low + (high - low) * this->uniform(); }

  /// In 0 .. bound - 1; the bias is below bound / 2^53.
  std::int64_t index(std::int64_t bound) { return std::int64_t(this->uniform() * double(bound)); }

  /// Two random numbers, or the coordinates of a random point.
  struct Pair
  {
    double x;
    double y;
  };

  /// A uniform point of the unit disk without its centre; `s` gets its squared radius.
  Pair inDisk(double& s)
  {
    Pair p;
    do
    {
      p = { this->uniform(-1, 1), this->uniform(-1, 1) };
      s = p.x * p.x + p.y * p.y;
    } while (s > 1 || s == 0);
    return p;
  }

  /// A uniform direction.
  Pair onCircle()
  {
    double s;
    const Pair p = this->inDisk(s);
    const double r = std::sqrt(s);
    return { p.x / r, p.y / r };
  }

  /// Two independent standard normal numbers (Marsaglia's polar method).
  Pair normal()
  {
    double s;
    const Pair p = this->inDisk(s);
    const double scale = std::sqrt(-2 * logarithm(s) / s);
    return { p.x * scale, p.y * scale };
  }

  /// Natural logarithm of a positive number, by 2 atanh((m - 1) / (m + 1)).
  static double logarithm(double value)
  {
    int exponent;
    double m = std::frexp(value, &exponent);
    if (m < 0.70710678118654752)
    {
      m *= 2;
      --exponent;
    }
    const double z = (m - 1) / (m + 1);
    const double z2 = z * z;
    double sum = 0;
    for (int k = 19; k >= 1; k -= 2)
    {
      sum = sum * z2 + 1.0 / k;
    }
    return 2 * z * sum + exponent * 0.69314718055994531;
  }

  /// e^value for |value| up to a few dozen, by Taylor's series of value / 1024 and ten squarings.
  static double exponential(double value)
  {
    const double t = value / 1024;
    double result = 1;
    for (int k = 8; k >= 1; --k)
    {
      result = 1 + result * t / k;
    }
    for (int i = 0; i < 10; ++i)
    {
      result *= result;
    }
    return result;
  }

private:
  static std::uint64_t rotate(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }

  std::array<std::uint64_t, 4> State;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactSum_h
#define tippExactSum_h

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace tipp
{

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
      std::fabs(large) < std::fabs(term) ? std::swap(large, term) : void();
      const double sum = large + term;
      const double rest = term - (sum - large);
      rest != 0 ? void(this->Parts[kept++] = rest) : void();
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

} // namespace tipp

#endif

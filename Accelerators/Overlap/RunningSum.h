// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRunningSum_h
#define tippRunningSum_h

namespace tipp
{

/// A sum that keeps the rounding errors of its additions, so that its error does not grow with the
/// number of terms: Knuth's exact sum of two numbers (The Art of Computer Programming, volume 2,
/// 4.2.2), whose errors are added up, too. The result depends on the order of the terms in its last
/// digits only.
struct RunningSum
{
  double Sum = 0;  ///< the rounded sum
  double Rest = 0; ///< what its roundings lost

  void add(double term)
  {
    const double sum = this->Sum + term;
    const double added = sum - this->Sum;
    this->Rest += (this->Sum - (sum - added)) + (term - added);
    this->Sum = sum;
  }
  void add(const RunningSum& other)
  {
    this->add(other.Sum);
    this->Rest += other.Rest;
  }

  double value() const { return this->Sum + this->Rest; }
};

} // namespace tipp

#endif

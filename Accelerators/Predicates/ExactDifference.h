// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactDifference_h
#define tippExactDifference_h

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

} // namespace tipp

#endif

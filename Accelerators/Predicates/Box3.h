// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBox3_h
#define tippBox3_h

#include <array>

namespace tipp
{

/// A closed axis-aligned box with finite bounds, Min[i] <= Max[i]; it may be flat. In 2D Min[2] =
/// Max[2] = 0.
struct Box3
{
  std::array<double, 3> Min = {};
  std::array<double, 3> Max = {};
};

} // namespace tipp

#endif

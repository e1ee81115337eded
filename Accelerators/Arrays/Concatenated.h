// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConcatenated_h
#define tippConcatenated_h

#include <vector>

namespace tipp
{

/// All items of several lists, such as those that threads or ranks have found, in their order.
template <typename T>
std::vector<T> concatenated(const std::vector<std::vector<T>>& parts)
{
  std::vector<T> all;
  for (const std::vector<T>& part : parts)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

} // namespace tipp

#endif

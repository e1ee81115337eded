// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNodeNumbers_h
#define tippNodeNumbers_h

#include <cstdint>
#include <unordered_map>

namespace tipp
{

/// The indices of nodes, from 0 in the order in which they are added, by the numbers that a file
/// gives them. Numbers may have gaps and any order.
class NodeNumbers
{
public:
  /// Returns false if the number has been added before.
  bool add(std::int64_t number)
  {
    const auto next = std::int64_t(this->IndexOf.size());
    return this->IndexOf.emplace(number, next).second;
  }

  /// The index of a node; -1 if its number has not been added.
  std::int64_t find(std::int64_t number) const
  {
    const auto found = this->IndexOf.find(number);
    return found == this->IndexOf.end() ? -1 : found->second;
  }

private:
  std::unordered_map<std::int64_t, std::int64_t> IndexOf;
};

} // namespace tipp

#endif

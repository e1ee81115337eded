// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSharingSets_h
#define tippSharingSets_h

#include "Partitioned/PieceTable.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace tipp
{

/// Numbers the distinct sets of pieces that borrow from one piece.
class VTKTIPPIO_EXPORT SharingSets
{
public:
  /// Returns the number of a set, which is given as an ascending list.
  int number(const std::vector<std::int32_t>& set);
  /// Returns the number of the union of two sets; -1 is the empty set.
  int unite(int a, int b);
  const std::vector<std::int32_t>& set(int number) const
  {
    return *this->Sets[static_cast<std::size_t>(number)];
  }
  std::size_t size() const { return this->Sets.size(); }
  /// Items grouped by the number of their set (-1: none), in lexicographic order of the sets, and
  /// for each set its index among the groups, or -1.
  struct Grouping
  {
    std::vector<LentGroup> Groups;
    std::vector<int> IndexOf;
  };
  Grouping groups(const std::vector<int>& setOf) const;
  /// For each set, by number, its index in the lexicographic order of all.
  std::vector<int> sortedIndices() const;

private:
  std::map<std::vector<std::int32_t>, int> Numbers;
  std::vector<const std::vector<std::int32_t>*> Sets;
  std::map<std::pair<int, int>, int> Unions;
};

} // namespace tipp

#endif

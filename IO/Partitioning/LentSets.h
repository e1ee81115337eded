// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLentSets_h
#define tippLentSets_h

#include "Partitioned/PieceTable.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace tipp
{

/// The sets of pieces that borrow from one piece, each by a number.
class VTKTIPPIO_EXPORT LentSets
{
public:
  /// Of an ascending list.
  int number(const std::vector<std::int32_t>& set);
  /// Of the union of two sets; -1 is the empty one.
  int unite(int a, int b);
  const std::vector<std::int32_t>& set(int number) const
  {
    return *this->Sets[static_cast<std::size_t>(number)];
  }
  std::size_t size() const { return this->Sets.size(); }
  /// The groups of things that have the sets of these numbers (-1: none), in lexicographic order,
  /// and of each set its place among them, or -1.
  struct Grouping
  {
    std::vector<LentGroup> Groups;
    std::vector<int> PlaceOf;
  };
  Grouping groups(const std::vector<int>& setOf) const;
  /// The place of each set, by number, in the lexicographic order of all.
  std::vector<int> places() const;

private:
  std::map<std::vector<std::int32_t>, int> Numbers;
  std::vector<const std::vector<std::int32_t>*> Sets;
  std::map<std::pair<int, int>, int> Unions;
};

} // namespace tipp

#endif

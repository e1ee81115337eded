// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGlobalIdMap_h
#define tippGlobalIdMap_h

#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace tipp
{

/// Whether all ids are in [0, limit).
template <typename Id>
bool areBelow(const Id* ids, std::size_t count, std::int64_t limit)
{
  using Unsigned = std::make_unsigned_t<Id>;
  Unsigned greatest = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    greatest = std::max(greatest, Unsigned(ids[i]));
  }
  return count == 0 || std::uint64_t(greatest) < std::uint64_t(limit);
}

/// A map from ids to values, neither negative. A look-up uses a table with about one id per entry,
/// and a search among the few ids that share an entry: two cache lines.
class VTKTIPPIO_EXPORT GlobalIdMap
{
public:
  GlobalIdMap() = default;
  /// `ids` must ascend; ids[i] maps to values[i], or to i if `values` is null.
  GlobalIdMap(const std::int64_t* ids, const std::int64_t* values, std::size_t count);

  /// The id's value; -1 if the id is not in the map.
  std::int64_t find(std::int64_t id) const;

  /// Writes the values of `count` ids; returns false if an id is not in the map.
  bool translate(const std::int64_t* ids, std::size_t count, std::int32_t* values) const;
  bool translate(const std::int64_t* ids, std::size_t count, std::int64_t* values) const;

private:
  template <typename Number>
  struct Entry
  {
    Number Id; ///< minus the least id
    Number Value;
  };
  template <typename Number>
  std::int64_t search(const std::vector<Entry<Number>>& entries, std::uint64_t key) const;
  template <typename Number>
  void fill(std::vector<Entry<Number>>& entries, const std::int64_t* ids,
    const std::int64_t* values, std::size_t count);
  template <typename Value>
  bool translateAll(const std::int64_t* ids, std::size_t count, Value* values) const;

  std::int64_t Least = 0;
  std::uint64_t Range = 0; ///< greatest id minus least id
  int Shift = 0;
  std::vector<std::uint32_t> Starts; ///< first entry for each value of the upper bits, and the end
  // Only one is used; the first if everything fits in 32 bits.
  std::vector<Entry<std::uint32_t>> Narrow;
  std::vector<Entry<std::uint64_t>> Wide;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIdMap_h
#define tippIdMap_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// From ids to values, both not negative. Looking up takes a table of about one id an entry, and a
/// search among the few ids that share an entry: two cache lines a look-up.
class VTKTIPPIO_EXPORT IdMap
{
public:
  IdMap() = default;
  /// `ids` ascend; ids[i] has the value values[i], or i if `values` is null.
  IdMap(const std::int64_t* ids, const std::int64_t* values, std::size_t count);

  /// -1 if there is no such id.
  std::int64_t find(std::int64_t id) const;

  /// Writes the values of ids; false if one has none.
  bool translate(const std::int64_t* ids, std::size_t count, std::int32_t* values) const;
  bool translate(const std::int64_t* ids, std::size_t count, std::int64_t* values) const;

private:
  template <typename Number>
  struct Entry
  {
    Number Id; ///< less the least
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
  std::uint64_t Range = 0; ///< from the least to the greatest
  int Shift = 0;
  std::vector<std::uint32_t> Starts; ///< of each value of the upper bits; one more at the end
  // One of them, the first where everything fits in 32 bits.
  std::vector<Entry<std::uint32_t>> Narrow;
  std::vector<Entry<std::uint64_t>> Wide;
};

} // namespace tipp

#endif

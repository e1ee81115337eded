// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIdRange_h
#define tippIdRange_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

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

} // namespace tipp

#endif

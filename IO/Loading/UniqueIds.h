// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUniqueIds_h
#define tippUniqueIds_h

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// The ids of a chunk without repetition: a vertex is in several cells of a chunk, six of a plane
/// mesh's triangles.
struct UniqueIds
{
  /// Throws std::length_error for 2^32 ids or more. None is negative.
  UniqueIds(const std::int64_t* ids, std::size_t count);

  std::vector<std::pair<std::int64_t, std::uint32_t>> Sorted; ///< each id and its number
  std::vector<std::uint32_t> Numbers;                         ///< of the chunk's ids
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUniqueIds_h
#define tippUniqueIds_h

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// The distinct ids of a chunk: a vertex belongs to several cells, to six triangles on average in a
/// planar mesh.
struct UniqueIds
{
  /// Throws std::length_error for 2^32 ids or more. Ids must not be negative.
  UniqueIds(const std::int64_t* ids, std::size_t count);

  /// each distinct id and its number, sorted by id
  std::vector<std::pair<std::int64_t, std::uint32_t>> Sorted;
  std::vector<std::uint32_t> Numbers; ///< the number of each of the chunk's ids
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCopyTuples_h
#define tippCopyTuples_h

#include <cstddef>
#include <cstdint>

namespace tipp
{

/// to[targets[i]] = from[sources[i]], the places being counted in tuples of `bytes` bytes.
void scatterTuples(const char* from, const std::uint64_t* sources, char* to,
  const std::uint64_t* targets, std::size_t count, std::size_t bytes);

/// to[i] = from[sources[i]].
void gatherTuples(
  const char* from, const std::uint64_t* sources, char* to, std::size_t count, std::size_t bytes);

} // namespace tipp

#endif

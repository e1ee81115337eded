// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCopyTuples_h
#define tippCopyTuples_h

#include <cstddef>
#include <cstdint>

namespace tipp
{

/// to[targets[i]] = from[sources[i]]; positions are in tuples of `bytes` bytes.
void scatterTuples(const char* from, const std::uint64_t* sources, char* to,
  const std::uint64_t* targets, std::size_t count, std::size_t bytes);

/// to[i] = from[sources[i]]; positions are in tuples of `bytes` bytes. Source is an integer of 16,
/// 32 or 64 bits.
template <typename Source>
void gatherTuples(
  const char* from, const Source* sources, char* to, std::size_t count, std::size_t bytes);

} // namespace tipp

#endif

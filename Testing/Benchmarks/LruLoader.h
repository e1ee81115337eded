// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLruLoader_h
#define tippLruLoader_h

#include "Loading/ArrayFiles.h"
#include "Loading/BlockCache.h"

namespace tipp
{
namespace benchmark
{

/// The cache that Direct Load is compared with (dissertation, section 4.5.1): M vertices in blocks
/// of equal size, the least recently used one being replaced. It uses one thread, and must not be
/// used any more after an error.
class LruLoader : public FileLoader
{
public:
  /// Throws as makeVertexLoader does. `m` is at least 1; it is divided into `blocks` blocks.
  LruLoader(std::vector<RawArray> arrays, std::int64_t m, std::int64_t blocks);

  void load(const std::int64_t* ids, std::size_t count, void* const* out) override;
  const char* name() const override { return "lru"; }
  /// The number of blocks that were read, since the cache did not hold them.
  std::int64_t misses() const { return this->Misses; }

private:
  std::uint32_t slotOf(std::uint64_t block);
  void copy(std::size_t from, std::size_t to, void* const* out);

  std::int64_t Block; ///< size of a block, in tuples
  Divisor ByBlock;
  std::uint32_t Slots;
  BlockCache Cache;
  std::int64_t Misses = 0;
  TupleBuffers Buffers;
};

} // namespace benchmark
} // namespace tipp

#endif

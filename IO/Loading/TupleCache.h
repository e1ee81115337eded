// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTupleCache_h
#define tippTupleCache_h

#include "Loading/ArrayFiles.h"
#include "Loading/BlockCache.h"

#include <cstdint>
#include <cstring>

namespace tipp
{

/// An LRU cache of single tuples, with a fixed number of slots.
class TupleCache
{
public:
  TupleCache(const ArrayFiles& files, std::uint32_t slots)
    : Places(slots)
  {
    this->Tuples.resize(files, slots);
  }

  /// Returns the tuple's slot. After a miss the caller must fill it; if that fails, the cache must
  /// not be used any more.
  BlockCache::Place use(std::int64_t id) { return this->Places.use(std::uint64_t(id)); }

  void fill(std::uint32_t slot, const ArrayFiles& files, TupleBuffers& from, std::size_t place)
  {
    for (std::size_t a = 0; a < files.count(); ++a)
    {
      const std::size_t bytes = files.tupleBytes(a);
      std::memcpy(this->Tuples.data(a) + slot * bytes, from.data(a) + place * bytes, bytes);
    }
  }

  TupleBuffers& tuples() { return this->Tuples; }

private:
  BlockCache Places;
  TupleBuffers Tuples;
};

} // namespace tipp

#endif

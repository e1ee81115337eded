// SPDX-License-Identifier: BSD-3-Clause
#include "LruLoader.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tipp
{
namespace benchmark
{

LruLoader::LruLoader(std::vector<RawArray> arrays, std::int64_t m, std::int64_t blocks)
  : FileLoader(ArrayFiles(std::move(arrays)), 1)
  , Block(std::max<std::int64_t>(m / blocks, 1))
  , ByBlock(std::uint64_t(this->Block))
  , Slots(std::uint32_t(std::min<std::int64_t>(m / this->Block, 1 << 30)))
  , Cache(this->Slots)
{
  this->Buffers.resize(this->Files, std::int64_t(this->Slots) * this->Block);
}

void LruLoader::load(const std::int64_t* ids, std::size_t count, void* const* out)
{
  this->Files.range(ids, count, 1);
  this->Counts.UsefulBytes += std::int64_t(count * this->Files.recordBytes());
  constexpr std::size_t ahead = 16;
  std::uint64_t last = ~std::uint64_t(0);
  std::uint32_t slot = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i + ahead < count)
    {
      this->Cache.prefetch(this->ByBlock.quotient(std::uint64_t(ids[i + ahead])));
    }
    const std::uint64_t block = this->ByBlock.quotient(std::uint64_t(ids[i]));
    if (block != last)
    {
      slot = this->slotOf(block);
      last = block;
    }
    const std::int64_t inside = ids[i] - std::int64_t(block) * this->Block;
    this->copy(std::size_t(std::int64_t(slot) * this->Block + inside), i, out);
  }
}

std::uint32_t LruLoader::slotOf(std::uint64_t block)
{
  const BlockCache::UsedSlot found = this->Cache.use(block);
  if (found.Miss)
  {
    ++this->Misses;
    const std::int64_t first = std::int64_t(block) * this->Block;
    const std::int64_t size = std::min(this->Block, this->Files.tuples() - first);
    const std::size_t to = std::size_t(found.Slot) * std::size_t(this->Block);
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      this->Files.read(
        a, first, size, this->Buffers.data(a) + to * this->Files.tupleBytes(a), 1, this->Counts);
    }
  }
  return found.Slot;
}

void LruLoader::copy(std::size_t from, std::size_t to, void* const* out)
{
  for (std::size_t a = 0; a < this->Files.count(); ++a)
  {
    const std::size_t bytes = this->Files.tupleBytes(a);
    std::memcpy(
      static_cast<char*>(out[a]) + to * bytes, this->Buffers.data(a) + from * bytes, bytes);
  }
}

} // namespace benchmark
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
// The cache that Direct Load is compared with (dissertation, section 4.5.1): M vertices in blocks
// of equal size, the least recently used one being replaced.
#include "Loading/ArrayFiles.h"
#include "Loading/BlockCache.h"

#include <algorithm>
#include <cstring>

namespace tipp
{
namespace
{

class LruLoader : public VertexLoader
{
public:
  LruLoader(ArrayFiles files, std::int64_t m, std::int64_t blocks)
    : Files(std::move(files))
    , Block(std::max<std::int64_t>(m / std::max<std::int64_t>(blocks, 1), 1))
    , ByBlock(std::uint64_t(this->Block))
    , Cache(slotsFor(m / this->Block))
  {
    this->Buffers.resize(this->Files, std::int64_t(slotsFor(m / this->Block)) * this->Block);
  }

  void load(const std::int64_t* ids, std::size_t count, void* const* out) override
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

  const LoadCounters& counters() const override { return this->Counts; }
  Loader kind() const override { return Loader::Lru; }

private:
  static std::uint32_t slotsFor(std::int64_t blocks)
  {
    return std::uint32_t(std::clamp<std::int64_t>(blocks, 1, std::int64_t(1) << 30));
  }

  std::uint32_t slotOf(std::uint64_t block)
  {
    const BlockCache::Found found = this->Cache.use(block);
    if (found.Miss)
    {
      ++this->Counts.CacheMisses;
      this->readBlock(std::int64_t(block) * this->Block, found.Slot);
    }
    return found.Slot;
  }

  void readBlock(std::int64_t first, std::uint32_t slot)
  {
    const std::int64_t size = std::min(this->Block, this->Files.tuples() - first);
    try
    {
      for (std::size_t a = 0; a < this->Files.count(); ++a)
      {
        const std::size_t at =
          std::size_t(std::int64_t(slot) * this->Block) * this->Files.tupleBytes(a);
        this->Files.read(a, first, size, this->Buffers.data(a) + at, 1, this->Counts);
      }
    }
    catch (...)
    {
      this->Cache.forget(slot);
      throw;
    }
  }

  void copy(std::size_t from, std::size_t to, void* const* out)
  {
    for (std::size_t a = 0; a < this->Files.count(); ++a)
    {
      const std::size_t bytes = this->Files.tupleBytes(a);
      std::memcpy(
        static_cast<char*>(out[a]) + to * bytes, this->Buffers.data(a) + from * bytes, bytes);
    }
  }

  ArrayFiles Files;
  std::int64_t Block; ///< in tuples
  Divisor ByBlock;
  BlockCache Cache;
  LoadCounters Counts;
  TupleBuffers Buffers;
};

} // namespace

std::unique_ptr<VertexLoader> makeLruLoader(ArrayFiles files, std::int64_t m, std::int64_t blocks)
{
  return std::make_unique<LruLoader>(std::move(files), m, blocks);
}

} // namespace tipp

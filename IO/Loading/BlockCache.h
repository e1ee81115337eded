// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBlockCache_h
#define tippBlockCache_h

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace tipp
{

/// The distinct ids of a chunk: a vertex belongs to several cells, to six triangles on average in a
/// planar mesh.
struct UniqueIds
{
  /// Throws std::length_error for more than 2^31 distinct ids.
  UniqueIds(const std::int64_t* ids, std::size_t count);

  /// each distinct id and its number, sorted by id
  std::vector<std::pair<std::int64_t, std::uint32_t>> Sorted;
  std::vector<std::uint32_t> Numbers; ///< the number of each of the chunk's ids
};

/// Returns for each of `blocks` blocks whether the chunk has ids in it: block i has the 2^shift ids
/// from low + (i << shift) on. All ids must lie in these blocks.
std::vector<char> findActive(const std::int64_t* ids, std::size_t count, std::int64_t low,
  std::size_t blocks, int shift, int threads);

/// Consecutive tuples that one read loads.
struct TupleRun
{
  std::int64_t First; ///< index of the first tuple
  std::int64_t Size;  ///< number of tuples
};

/// Returns the active blocks, of `block` tuples each, as runs within [low, high). Runs less than
/// `gap` tuples apart are merged.
std::vector<TupleRun> runsOfBlocks(const std::vector<char>& active, std::int64_t block,
  std::int64_t low, std::int64_t high, std::int64_t gap);

/// Returns single ids, the first members of the pairs, in ascending order, as runs. Runs less than
/// `gap` tuples apart are merged.
std::vector<TupleRun> runsOfIds(
  const std::vector<std::pair<std::int64_t, std::uint32_t>>& ids, std::int64_t gap);

/// Runs in groups of at most m tuples, and each run's position in the buffer of its group.
struct RunPlan
{
  /// Longer runs are cut at multiples of `block` tuples from `low`.
  RunPlan(const std::vector<TupleRun>& runs, std::int64_t m, std::int64_t block, std::int64_t low);

  std::size_t groups() const { return this->Starts.size() - 1; }

  std::vector<TupleRun> Runs;         ///< cut
  std::vector<std::size_t> Starts;    ///< first run of each group, and the number of runs
  std::vector<std::uint32_t> Packed;  ///< position of each run in tuples; m is below 2^32
  std::vector<std::uint32_t> GroupOf; ///< group of each run
};

/// The positions, in a buffer, of the blocks of tuples that are kept for the next chunks. A block
/// is 2^shift tuples. Blocks are only added, until all are dropped.
class HeldBlocks
{
public:
  HeldBlocks(int shift, std::int64_t tuples)
    : Shift(shift)
    , Tuples(tuples)
  {
  }

  bool isEmpty() const { return this->Used == 0; }
  std::int64_t used() const { return this->Used; } ///< tuples in use in the buffer
  std::int64_t room() const { return this->Room; } ///< capacity of the buffer in tuples
  /// Call it only while no block is held, since resizing the buffer discards its content.
  void setRoom(std::int64_t tuples) { this->Room = tuples; }
  void forget();

  /// Returns a function from the index of a tuple whose block is held to its position in the
  /// buffer. It works on copies, which writing positions cannot alias.
  auto finder() const
  {
    return [positions = this->Positions.data(), shift = this->Shift, mask = this->mask()](
             std::uint64_t id) { return positions[id >> shift] + (id & mask); };
  }

  /// Returns, for each block, whether it is active and not held. `active` starts at the block of
  /// tuple `low`.
  std::vector<char> missing(const std::vector<char>& active, std::int64_t low);
  /// Adds a run of whole blocks, positioned after those already held.
  void add(const TupleRun& run);

  /// Writes the buffer position of each id's tuple to `positions`. Blocks that are not held are
  /// assigned a position, and the caller must read them next, see found(). Returns false, and adds
  /// no block, if there is no room for them, if they have more tuples than there are ids, or if an
  /// id is not a tuple's index.
  bool find(const std::int64_t* ids, std::size_t count, std::uint32_t* positions);
  /// The runs to read after find(), in the order of their positions.
  std::vector<TupleRun> found() const;
  void keepFound();
  void loseFound();

private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  std::uint64_t mask() const { return (std::uint64_t(1) << this->Shift) - 1; }
  bool addFound(std::uint64_t block, std::int64_t most);

  int Shift;
  std::int64_t Tuples;
  std::vector<std::uint32_t> Positions; ///< position of each block
  std::int64_t Used = 0;
  std::int64_t Room = 0;
  std::vector<std::uint64_t> Found; ///< blocks that are to be read
};

/// An LRU cache's bookkeeping: a hash table from block numbers to slots, and a doubly linked list
/// of the slots, the most recently used first.
class BlockCache
{
public:
  struct UsedSlot
  {
    std::uint32_t Slot;
    bool Miss; ///< the slot is assigned to the block, but the caller has yet to fill it
  };

  /// `slots` is in [1, 2^30].
  explicit BlockCache(std::uint32_t slots);

  /// Returns the block's slot and makes it the most recently used one. A block that is not cached
  /// replaces the least recently used one.
  UsedSlot use(std::uint64_t block);

  /// Prefetches the table entry that use(block) will read first.
  void prefetch(std::uint64_t block) const
  {
    __builtin_prefetch(&this->Table[this->bucketOf(block)]);
  }

private:
  struct Slot
  {
    std::uint64_t Block;
    std::uint32_t Before;
    std::uint32_t After;
  };

  std::size_t bucketOf(std::uint64_t block) const
  {
    return std::size_t(block * 0x9E3779B97F4A7C15U >> this->TableShift);
  }
  void unlink(std::uint32_t slot);
  void linkFirst(std::uint32_t slot);
  void erase(std::uint64_t block);

  static constexpr std::uint64_t nothing = ~std::uint64_t(0);

  std::vector<Slot> Slots; ///< one more than requested: the list's sentinel
  std::vector<std::uint32_t> Table;
  int TableShift;
  std::uint32_t End; ///< the sentinel's slot
};

} // namespace tipp

#endif

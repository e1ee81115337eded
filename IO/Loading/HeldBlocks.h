// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippHeldBlocks_h
#define tippHeldBlocks_h

#include "Loading/Runs.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tipp
{

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
  /// Only while no block is held: a buffer of another size does not keep its content.
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
  void add(const Run& run);

  /// Writes the buffer position of each id's tuple to `positions`. Blocks that are not held are
  /// assigned a position, and the caller must read them next, see found(). Returns false, and adds
  /// no block, if there is no room for them, if they have more tuples than there are ids, or if an
  /// id is not a tuple's index.
  bool find(const std::int64_t* ids, std::size_t count, std::uint32_t* positions);
  /// The runs to read after find(), in the order of their positions.
  std::vector<Run> found() const;
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

} // namespace tipp

#endif

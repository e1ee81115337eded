// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBlockPlaces_h
#define tippBlockPlaces_h

#include "Loading/Runs.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tipp
{

/// Where in a buffer blocks of tuples are that stay for the next chunks. A block is 2^shift tuples.
/// Blocks are only added, until all are forgotten.
class BlockPlaces
{
public:
  BlockPlaces(int shift, std::int64_t tuples)
    : Shift(shift)
    , Tuples(tuples)
  {
  }

  bool isEmpty() const { return this->Used == 0; }
  std::int64_t used() const { return this->Used; } ///< tuples of the buffer
  std::int64_t room() const { return this->Room; } ///< for tuples in the buffer
  /// Only while it is empty: the buffer of another size does not keep what it holds.
  void setRoom(std::int64_t tuples) { this->Room = tuples; }
  void forget();

  /// Gives the places of tuples whose blocks are held. A copy of what that takes, which writing
  /// places cannot change.
  auto finder() const
  {
    return [places = this->Places.data(), shift = this->Shift, mask = this->mask()](
             std::uint64_t id) { return places[id >> shift] + (id & mask); };
  }

  /// Those of the active blocks, from that of tuple `low` on, that are not held.
  std::vector<char> missing(const std::vector<char>& active, std::int64_t low);
  /// A run of whole blocks is behind those that were held.
  void add(const Run& run);

  /// The places of tuples, among them those of blocks that are not held but get their place here;
  /// these are to be read next. False, and there are no such blocks, if they had more tuples than
  /// there is room for or there are ids, or if an id is not that of a tuple.
  bool find(const std::int64_t* ids, std::size_t count, std::uint32_t* places);
  /// What is to be read after find(), in the order of their places.
  std::vector<Run> found() const;
  void keepFound();
  void loseFound();

private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  std::uint64_t mask() const { return (std::uint64_t(1) << this->Shift) - 1; }
  bool addFound(std::uint64_t block, std::int64_t most);

  int Shift;
  std::int64_t Tuples;
  std::vector<std::uint32_t> Places; ///< of each block
  std::int64_t Used = 0;
  std::int64_t Room = 0;
  std::vector<std::uint64_t> Found; ///< blocks that are to be read
};

} // namespace tipp

#endif

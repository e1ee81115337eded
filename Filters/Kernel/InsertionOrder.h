// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInsertionOrder_h
#define tippInsertionOrder_h

#include "Kernel/Instructions.h"
#include "Kernel/Uninitialised.h"
#include "Predicates/Point2.h"

#include <cstddef>
#include <cstdint>

namespace tipp
{

/// The order in which a box's points are inserted: biased randomised rounds (Amenta, Choi, Rote
/// 2003), each along a Hilbert curve. One point in eight goes to an earlier round than the last.
/// Depends on coordinates and positions in the array alone.
class InsertionOrder
{
public:
  explicit InsertionOrder(Instructions instructions = Instructions::Best);

  /// Valid until the next call.
  void compute(const Point2* points, std::size_t count);

  /// Room for so many points.
  void reserve(std::size_t points)
  {
    this->Entries.reserve(points);
    this->Scratch.reserve(points);
  }

  std::size_t size() const { return this->Entries.size(); }

  /// The index of the point to insert k-th.
  std::uint32_t operator[](std::size_t k) const
  {
    return static_cast<std::uint32_t>(this->Entries[k]) & IndexMask;
  }

  /// Gives large memory back; then the permutation is gone.
  void releaseIfLarge();

  std::size_t bytes() const
  {
    return (this->Entries.capacity() + this->Scratch.capacity()) * sizeof(std::uint64_t);
  }

  static constexpr unsigned IndexBits = 28;

private:
  static constexpr std::uint32_t IndexMask = (1U << IndexBits) - 1;

  template <unsigned passes>
  void sortByDigits(unsigned lowest, unsigned digitBits);
  bool hasManyTies(unsigned lowest) const;
  void refineTies(const Point2* points);

  const Instructions Allowed;
  Uninitialised<std::uint64_t> Entries; ///< round, key and index, from the highest bits down
  Uninitialised<std::uint64_t> Scratch;
};

} // namespace tipp

#endif

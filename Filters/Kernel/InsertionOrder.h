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
/// 2003), each along a Hilbert curve. One point in eight goes to a round before the last. The order
/// depends only on the coordinates and on the points' indices in the array.
class InsertionOrder
{
public:
  explicit InsertionOrder(Instructions instructions = Instructions::Best);

  /// Computes the order of `count` points. It is valid until the next call.
  void compute(const Point2* points, std::size_t count);

  /// Reserves memory for `points` points.
  void reserve(std::size_t points)
  {
    this->Entries.reserve(points);
    this->Scratch.reserve(points);
  }

  std::size_t size() const { return this->Entries.size(); }

  /// The index of the k-th point to insert.
  std::uint32_t operator[](std::size_t k) const
  {
    return static_cast<std::uint32_t>(this->Entries[k]) & IndexMask;
  }

  /// Frees the memory if it is large; the order is invalid then.
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
  Uninitialised<std::uint64_t> Entries; ///< round, key and index, highest bits first
  Uninitialised<std::uint64_t> Scratch;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInsertionOrder_h
#define tippInsertionOrder_h

#include "Predicates/Point2.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The order in which a box's points are inserted: biased randomised rounds (Amenta, Choi, Rote
/// 2003), each along a Hilbert curve. One point in eight goes to an earlier round than the last.
/// Depends on coordinates and positions in the array alone.
class InsertionOrder
{
public:
  /// The permutation: entry k is the index of the point to insert k-th. Valid until the next call.
  const std::vector<std::uint32_t>& compute(const Point2* points, std::size_t count);

  /// Gives large memory back; then the permutation is gone.
  void releaseIfLarge();

  std::size_t bytes() const
  {
    return 2 * this->Entries.capacity() * sizeof(std::uint64_t) +
      this->Order.capacity() * sizeof(std::uint32_t);
  }

private:
  void computeKeys(const Point2* points, std::size_t count);
  template <unsigned passes>
  void sortByKey();

  std::vector<std::uint64_t> Entries; ///< round, key and index, from the highest bits down
  std::vector<std::uint64_t> Scratch;
  std::vector<std::uint32_t> Order;
};

} // namespace tipp

#endif

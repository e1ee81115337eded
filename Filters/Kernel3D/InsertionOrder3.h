// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInsertionOrder3_h
#define tippInsertionOrder3_h

#include "Arrays/Buffer.h"
#include "Predicates/Points.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The order in which points in space are inserted: biased randomised rounds (Amenta, Choi, Rote
/// 2003), each along a Hilbert curve. One point in eight goes to a round before the last. The order
/// depends only on the coordinates and on the points' indices in the array.
class VTKTIPPFILTERS_EXPORT InsertionOrder3
{
public:
  static constexpr unsigned IndexBits = 28;

  /// Computes the order of `count` < 2^IndexBits points. It is valid until the next call.
  void compute(const Point3* points, std::size_t count);

  std::size_t size() const { return this->Entries.size(); }

  /// The index of the k-th point to insert.
  std::uint32_t operator[](std::size_t k) const
  {
    return static_cast<std::uint32_t>(this->Entries[k]) & IndexMask;
  }

  /// One past the last point of each round, among the points to insert.
  const std::vector<std::size_t>& roundEnds() const { return this->RoundEnds; }

  /// Frees the memory; the order is invalid then.
  void release();

private:
  static constexpr std::uint32_t IndexMask = (1U << IndexBits) - 1;

  void sortRound(const Point3* points, std::size_t begin, std::size_t end);
  void sortByKey(std::size_t begin, std::size_t end);
  void fillKeys(
    const Point3* points, std::size_t begin, std::size_t end, const Point3& low, double scale);

  Uninitialised<std::uint64_t> Entries; ///< key and index, highest bits first
  Uninitialised<std::uint64_t> Scratch;
  std::vector<std::size_t> RoundEnds;
};

} // namespace tipp

#endif

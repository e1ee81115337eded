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

/// The order in which the kernel inserts points: biased randomised rounds (Amenta, Choi, Rote
/// 2003), each along a Hilbert curve. An eighth of the points is in rounds before the last
/// one, an eighth of these before the last but one, and so on. The order depends only on the
/// coordinates and on the points' indices.
class VTKTIPPFILTERS_EXPORT InsertionOrder3
{
public:
  static constexpr unsigned IndexBits = 28;

  /// Computes the order of `count` < 2^IndexBits points; replaces the previous order.
  void compute(const Point3* points, std::size_t count);

  std::size_t size() const { return this->Entries.size(); }

  /// The input index of the k-th point to insert.
  std::uint32_t operator[](std::size_t k) const
  {
    return static_cast<std::uint32_t>(this->Entries[k]) & IndexMask;
  }

  /// For each round the position in the order that follows its last point; ascending.
  const std::vector<std::size_t>& roundEnds() const { return this->RoundEnds; }

  /// Frees the memory and the order.
  void release();

private:
  static constexpr std::uint32_t IndexMask = (1U << IndexBits) - 1;

  void sortRound(const Point3* points, std::size_t begin, std::size_t end);
  void sortByKey(std::size_t begin, std::size_t end);
  void fillKeys(
    const Point3* points, std::size_t begin, std::size_t end, const Point3& low, double scale);

  Uninitialised<std::uint64_t> Entries; ///< Hilbert key in the high bits, input index in the low
  Uninitialised<std::uint64_t> Scratch;
  std::vector<std::size_t> RoundEnds;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMortonOrder_h
#define tippMortonOrder_h

#include "Parallel/BoundsOf.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Sort.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// Puts D - 1 zeros between the bits of a number of 32 bits (D = 2) or 21 bits (D = 3).
template <int D>
std::uint64_t spreadBits(std::uint64_t x)
{
  if constexpr (D == 2)
  {
    x = (x | x << 16) & 0x0000ffff0000ffffu;
    x = (x | x << 8) & 0x00ff00ff00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fu;
    x = (x | x << 2) & 0x3333333333333333u;
    return (x | x << 1) & 0x5555555555555555u;
  }
  else
  {
    x = (x | x << 32) & 0x001f00000000ffffu;
    x = (x | x << 16) & 0x001f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
  }
}

/// The Morton code of a box's centre within the bounds `all`.
template <int D>
std::uint64_t mortonCode(const Box<D>& box, const Box<D>& all)
{
  constexpr double cells = double(std::uint64_t(1) << (64 / D));
  std::uint64_t code = 0;
  for (int axis = 0; axis < D; ++axis)
  {
    // Halves, so that nothing overflows.
    const double low = all.Min[axis] / 2;
    const double extent = all.Max[axis] / 2 - low;
    const double centre = (box.Min[axis] / 2 - low) / 2 + (box.Max[axis] / 2 - low) / 2;
    const double share = extent > 0 ? centre / extent : 0;
    code |= spreadBits<D>(std::uint64_t(std::min(std::max(share, 0.0) * cells, cells - 1))) << axis;
  }
  return code;
}

/// The indices of the boxes boxOf(0) ... boxOf(count - 1), sorted by the Morton code of their
/// centres within `all`, their bounds. Boxes that are not finite are left out. `count` must be
/// below 2^31. The order does not depend on the number of threads.
template <int D, typename BoxOf>
std::vector<std::int32_t> mortonOrder(
  std::int64_t count, int threads, const Box<D>& all, const BoxOf& boxOf)
{
  using CodedBox = std::pair<std::uint64_t, std::int32_t>; // a code and a box; -1: not finite
  std::vector<CodedBox> boxes(static_cast<std::size_t>(count));
  forIndices(
    count,
    [&](std::int64_t i)
    {
      const Box<D> box = boxOf(i);
      boxes[std::size_t(i)] = isFinite(box) ? CodedBox{ mortonCode(box, all), std::int32_t(i) }
                                            : CodedBox{ ~std::uint64_t(0), -1 };
    },
    threads, 1 << 14);
  sortInParts(boxes.begin(), boxes.end(), threads);
  std::vector<std::int32_t> order;
  order.reserve(boxes.size());
  for (const auto& [code, number] : boxes)
  {
    if (number >= 0)
    {
      order.push_back(number);
    }
  }
  return order;
}

/// The indices of the points at(0) ... at(count - 1) in an order in which
/// successive points are near each other: approximately that of their Morton codes. Non-finite
/// points are left out. `count` must be below 2^31. The order does not depend on the number of
/// threads.
template <int D, typename At>
std::vector<std::int32_t> nearOrder(std::int64_t count, int threads, const At& at)
{
  const auto boxOf = [&at](std::int64_t i) { return Box<D>::of(at(i)); };
  const Box<D> all = boundsOf<D>(count, threads, boxOf);
  constexpr std::uint64_t notFinite = ~std::uint64_t(0);
  std::vector<std::uint64_t> words(static_cast<std::size_t>(count));
  forIndices(
    count,
    [&](std::int64_t i)
    {
      const Box<D> box = boxOf(i);
      const std::uint64_t code = isFinite(box) ? mortonCode(box, all) << (D == 2 ? 0 : 1) : 0;
      words[std::size_t(i)] = isFinite(box) ? (code >> 32 << 32) | std::uint64_t(i) : notFinite;
    },
    threads, 1 << 14);
  // Sorts by as many bits as give about one point per key.
  const unsigned lowest = count > 1 << 22 ? 32 : count > 1 << 11 ? 42 : 53;
  sortByUpperHalf(words, threads, lowest);
  std::vector<std::int32_t> order;
  order.reserve(words.size());
  for (const std::uint64_t word : words)
  {
    if (word != notFinite)
    {
      order.push_back(std::int32_t(std::uint32_t(word)));
    }
  }
  return order;
}

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBoundsOf_h
#define tippBoundsOf_h

#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Returns the common bounds of the boxes boxOf(0) ... boxOf(count - 1), ignoring those that are
/// not finite.
template <int D, typename BoxOf>
Box<D> boundsOf(std::int64_t count, int threads, const BoxOf& boxOf)
{
  std::vector<Box<D>> bounds(std::size_t(threads), Box<D>::empty());
  forChunks(count, 1 << 14, threads, {},
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      Box<D> own = Box<D>::empty();
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Box<D> box = boxOf(i);
        if (isFinite(box))
        {
          own.extend(box);
        }
      }
      bounds[std::size_t(thread)].extend(own);
    });
  for (const Box<D>& box : bounds)
  {
    bounds[0].extend(box);
  }
  return bounds[0];
}

} // namespace tipp

#endif

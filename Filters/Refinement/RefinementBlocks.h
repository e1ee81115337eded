// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRefinementBlocks_h
#define tippRefinementBlocks_h

#include "Arrays/Buffer.h"
#include "Files/PagedMemory.h"
#include "Predicates/Geometry.h"
#include "Refinement/RefinementMesh.h"
#include "Refinement/RefinementQueue.h"

#include <cstddef>
#include <vector>

namespace tipp
{

/// A box, half-open, and a range of the elements in it.
struct RefinementBlock
{
  Box2 Bounds;
  std::size_t Begin;
  std::size_t End;
};

/// Cuts the plane into boxes with about equally many elements each: a k-d tree. Sorts the elements
/// by block; an element lies where the first corner of its triangle does. Equal elements in equal
/// order give equal blocks. `most`: the largest number of blocks.
///
/// If the elements are what other blocks have left over, most lie along their borders. Therefore
/// `avoidsBorders` cuts where there is most room between elements.
///
/// `memory`: where a copy of the elements is sorted; null: the process's memory.
std::vector<RefinementBlock> makeBlocks(const RefinementMesh& mesh,
  Buffer<RefinementQueue::Element>& elements, std::size_t most, bool avoidsBorders, int threads,
  PagedMemory* memory);

} // namespace tipp

#endif

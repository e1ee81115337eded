// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReferenceTree_h
#define tippReferenceTree_h

#include "CellSets.h"
#include "ExpectIOError.h"

#include "Partitioning/BuildTree.h"

#include <cstdint>
#include <string>
#include <vector>

/// A leaf of the tree that buildTree() should make, and the cells that meet it.
struct ReferenceLeaf
{
  tipp::Box3 Box;
  std::int64_t Cells;
};

/// Builds the tree by recursion over lists of cells; each cell is tested by clipping in rational
/// arithmetic.
std::vector<ReferenceLeaf> referenceTree(
  const CellSet& cells, std::int64_t threshold, int maxDepth = tipp::BoxTiling::MaxDepth);

/// Cells in memory as a source.
tipp::CellSource sourceOf(const CellSet& cells);

/// Expects the same boxes of leaves, with the same numbers of cells.
void expectTree(const std::vector<ReferenceLeaf>& expected, const tipp::PartitionTree& actual);

/// Expects that the action throws an IOError whose message contains `words`.
template <typename Action>
void expectFailure(Action action, const std::string& words)
{
  tipp::test::expectIOError("", words, action);
}

#endif

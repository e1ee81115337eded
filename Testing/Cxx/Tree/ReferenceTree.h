// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReferenceTree_h
#define tippReferenceTree_h

#include "CellSets.h"
#include "ExpectIOError.h"

#include "Partitioning/BuildTree.h"

#include <cstdint>
#include <string>
#include <vector>

/// A leaf of the tree that the rule of buildTree gives, and the cells that meet it.
struct ReferenceLeaf
{
  tipp::Box3 Box;
  std::int64_t Cells;
};

/// By recursion over lists of cells, each tested by clipping in rationals.
std::vector<ReferenceLeaf> referenceTree(
  const CellSet& cells, std::int64_t threshold, int maxDepth = tipp::BoxTiling::MaxDepth);

/// Cells in memory as a source.
tipp::CellSource sourceOf(const CellSet& cells);

/// The leaves' boxes and numbers of cells.
void expectTree(const std::vector<ReferenceLeaf>& expected, const tipp::PartitionTree& actual);

/// The action fails with an IOError whose sentence holds the words.
template <typename Action>
void expectFailure(Action action, const std::string& words)
{
  tipp::test::expectIOError("", words, action);
}

#endif

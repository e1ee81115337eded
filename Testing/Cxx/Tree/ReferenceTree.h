// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReferenceTree_h
#define tippReferenceTree_h

#include "CellSets.h"
#include "ExpectIOError.h"

#include "Partitioning/MeshTiling.h"

#include <cstdint>
#include <string>
#include <vector>

/// Returns the leaves of the tree that buildTree() should make, by recursion over lists of cells;
/// each cell is tested by clipping in rational arithmetic.
std::vector<tipp::Box3> referenceTree(const CellSet& cells, std::int64_t threshold);

/// Cells in memory as a source.
tipp::CellSource sourceOf(const CellSet& cells);

/// Expects the same boxes of leaves.
void expectTree(const std::vector<tipp::Box3>& expected, const tipp::BoxTiling& actual);

/// Expects that the action throws an IOError whose message contains `words`.
template <typename Action>
void expectFailure(Action action, const std::string& words)
{
  tipp::test::expectIOError("", words, action);
}

#endif

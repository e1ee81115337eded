// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellCounter_h
#define tippCellCounter_h

#include "Partition/CellShape.h"
#include "Partitioning/RefinementTree.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Cells of each node of a tree.
struct NodeCounts
{
  std::vector<std::int64_t> Meeting; ///< cells that share a point with its closed box
  std::vector<std::int64_t> Fitting; ///< of these, the cells no longer than the box

  void resize(std::size_t nodes)
  {
    this->Meeting.resize(nodes, 0);
    this->Fitting.resize(nodes, 0);
  }
};

/// Counts cells in the nodes of a tree that grows meanwhile: a leaf with more than `limit` fitting
/// cells is split repeatedly, and the chunk's cells are counted in its children. Cells of earlier
/// chunks are not counted in those.
class VTKTIPPIO_EXPORT CellCounter
{
public:
  CellCounter(RefinementTree& tree, int maxDepth, int threads);

  /// firstCell is the index in the mesh of the chunk's first cell. Throws IOError if a coordinate
  /// is not finite or a cell lies outside the domain.
  void add(const CellsView& chunk, std::int64_t firstCell, std::int64_t limit);

  const NodeCounts& counts() const { return this->Counts; }

private:
  struct Visit
  {
    std::int32_t Node;
    std::uint32_t Cell;
  };
  struct ThreadRange;

  void countAll(const CellShape& shape, std::size_t cells, std::int64_t firstCell);
  void visitTree(const CellShape& shape, std::uint32_t cell, ThreadRange& range) const;
  void visitChildren(const CellShape& shape, Visit parent, ThreadRange& range) const;
  void collectVisits(const CellShape& shape, std::size_t cells);
  void refineOnce(const CellShape& shape);
  bool markSplits(std::int64_t limit);
  std::vector<ThreadRange> makeRanges(std::size_t items) const;
  void sum(const std::vector<ThreadRange>& ranges);
  void takeVisits(std::vector<ThreadRange>& ranges);

  RefinementTree& Tree;
  int MaxDepth;
  int Threads;
  NodeCounts Counts;
  std::vector<std::uint8_t> Marked; // leaves to be split
  std::vector<Visit> Visits;        // of cells to the marked leaves
};

} // namespace tipp

#endif

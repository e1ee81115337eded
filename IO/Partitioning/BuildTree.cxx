// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/MeshTiling.h"

#include "Files/IOError.h"
#include "OpenCL/Devices.h"
#include "Parallel/ParallelFor.h"
#include "Partition/ClassifyCells.h"
#include "Ranks/Communicator.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

struct MeasuredCell
{
  std::uint32_t Index; ///< in the chunk
  const double* Corners;
  Box3 Bounds;
  double Length;
  bool IsFinite;
};

MeasuredCell measure(const CellShape& shape, int dimension, std::size_t index)
{
  MeasuredCell cell{ std::uint32_t(index), shape.cell(index), {}, 0.0, false };
  cell.IsFinite = shape.bounds(cell.Corners, cell.Bounds);
  for (std::size_t axis = 0; axis < std::size_t(dimension); ++axis)
  {
    cell.Length = std::max(cell.Length, cell.Bounds.width(axis));
  }
  return cell;
}

bool meetsBox(const CellShape& shape, const MeasuredCell& cell, const Box3& box)
{
  return cell.Bounds.meets(box) && (box.contains(cell.Bounds) || shape.meets(cell.Corners, box));
}

/// For each node of a tree, the number of cells that share a point with its closed box and are no
/// longer than it.
using NodeCounts = std::vector<std::int64_t>;

/// The leaves that have more fitting cells than the limit and may be split.
std::vector<std::int32_t> leavesAbove(
  const RefinementTree& tree, const NodeCounts& counts, std::int64_t limit)
{
  std::vector<std::int32_t> leaves;
  for (std::size_t index = 0; index < tree.size(); ++index)
  {
    const auto node = std::int32_t(index);
    if (counts[index] > limit && tree.isLeaf(node) && tree.canSplit(node))
    {
      leaves.push_back(node);
    }
  }
  return leaves;
}

/// Counts cells in the nodes of a tree, which grows at the same time: a leaf with more than `limit`
/// fitting cells is split repeatedly, and the chunk's cells are counted in its children. Cells of
/// earlier chunks are not counted in these children.
class CellCounter
{
public:
  CellCounter(RefinementTree& tree, int threads)
    : Tree(tree)
    , Threads(threadCount(threads))
  {
  }

  /// firstCell is the index in the mesh of the chunk's first cell. Throws IOError if a coordinate
  /// is not finite or a cell lies outside the domain.
  void add(const CellsView& chunk, std::int64_t firstCell, std::int64_t limit)
  {
    const CellShape shape(chunk, this->Tree.dimension());
    this->countAll(shape, chunk.Cells, firstCell);
    if (!this->markSplits(limit))
    {
      return;
    }
    this->takeVisits(this->onThreads(chunk.Cells,
      [&](std::size_t i, ThreadResult& result)
      { this->visitTree(shape, measure(shape, this->Tree.dimension(), i), result); }));
    const std::size_t most =
      std::max(std::size_t(1) << 17, 8 * (std::size_t(firstCell) + chunk.Cells));
    do
    {
      if (this->Tree.size() > most)
      {
        throw IOError("More than " + std::to_string(limit) +
          " cells overlap nearly everywhere, so that no " +
          "boxes hold fewer; allow more cells a box.");
      }
      this->refineOnce(shape);
    } while (this->markSplits(limit));
    this->Visits.clear();
  }

  const NodeCounts& counts() const { return this->Counts; }

private:
  struct Visit
  {
    std::int32_t Node;
    std::uint32_t Cell;
  };
  /// A thread's counts, and the visits that it records.
  struct ThreadResult
  {
    NodeCounts Counts;
    std::vector<Visit> Visits;
  };

  /// Calls visit(item, result) for all items. Each thread visits one range of items and has its own
  /// result; the results are returned in the order of the ranges.
  template <typename VisitItem>
  std::vector<ThreadResult> onThreads(std::size_t items, const VisitItem& visit) const
  {
    const auto count = std::size_t(this->Threads);
    std::vector<ThreadResult> results(count);
    parallelFor(this->Threads, this->Threads,
      [&](std::int64_t thread)
      {
        const auto t = std::size_t(thread);
        results[t].Counts.resize(this->Tree.size(), 0);
        for (std::size_t i = items * t / count; i < items * (t + 1) / count; ++i)
        {
          pollAt(std::int64_t(i));
          visit(i, results[t]);
        }
      });
    return results;
  }

  void countAll(const CellShape& shape, std::size_t cells, std::int64_t firstCell)
  {
    this->Marked.clear();
    this->sum(this->onThreads(cells,
      [&](std::size_t i, ThreadResult& result)
      {
        const MeasuredCell cell = measure(shape, this->Tree.dimension(), i);
        if (!cell.IsFinite ||
          (!this->Tree.domain().contains(cell.Bounds) &&
            !shape.meets(cell.Corners, this->Tree.domain())))
        {
          throw IOError("Cell " + std::to_string(firstCell + std::int64_t(i)) +
            (cell.IsFinite ? " lies outside the domain that is partitioned."
                           : " has a corner whose coordinates are not finite."));
        }
        this->visitTree(shape, cell, result);
      }));
  }

  /// Counts the cell in all nodes that it meets and fits. If leaves are marked, records visits to
  /// these only. Children are no longer than their parent, so a cell that is too long for a node
  /// fits none below it.
  void visitTree(const CellShape& shape, const MeasuredCell& cell, ThreadResult& result) const
  {
    std::array<std::int32_t, 7 * BoxTiling::MaxDepth + 1> stack;
    std::size_t size = 0;
    if (cell.Length <= this->Tree.length(0))
    {
      stack[size++] = 0;
    }
    while (size > 0)
    {
      const std::int32_t node = stack[--size];
      if (this->Marked.empty())
      {
        ++result.Counts[std::size_t(node)];
      }
      else if (this->Marked[std::size_t(node)] != 0)
      {
        result.Visits.push_back({ node, cell.Index });
      }
      this->forEachChildMet(shape, cell, node, [&](std::int32_t child) { stack[size++] = child; });
    }
  }

  /// Calls visit(child) for the node's children that the cell meets and fits.
  template <typename VisitChild>
  void forEachChildMet(const CellShape& shape, const MeasuredCell& cell, std::int32_t node,
    const VisitChild& visit) const
  {
    if (this->Tree.isLeaf(node))
    {
      return;
    }
    const std::int32_t first = this->Tree.firstChild(node);
    for (std::int32_t child = first; child < first + this->Tree.childCount(); ++child)
    {
      if (meetsBox(shape, cell, this->Tree.box(child)) && cell.Length <= this->Tree.length(child))
      {
        visit(child);
      }
    }
  }

  bool markSplits(std::int64_t limit)
  {
    this->Marked.assign(this->Tree.size(), 0);
    const std::vector<std::int32_t> leaves = leavesAbove(this->Tree, this->Counts, limit);
    for (const std::int32_t leaf : leaves)
    {
      this->Marked[std::size_t(leaf)] = 1;
    }
    return !leaves.empty();
  }

  /// Splits the marked leaves and counts the cells that visited them in their children.
  void refineOnce(const CellShape& shape)
  {
    for (std::size_t index = 0, end = this->Tree.size(); index < end; ++index)
    {
      if (this->Marked[index] != 0)
      {
        this->Tree.split(std::int32_t(index));
      }
    }
    const std::vector<Visit> parents = std::move(this->Visits);
    std::vector<ThreadResult> results = this->onThreads(parents.size(),
      [&](std::size_t i, ThreadResult& result)
      {
        const Visit& parent = parents[i];
        if (this->Marked[std::size_t(parent.Node)] == 0)
        {
          return;
        }
        const MeasuredCell cell = measure(shape, this->Tree.dimension(), parent.Cell);
        this->forEachChildMet(shape, cell, parent.Node,
          [&](std::int32_t child)
          {
            ++result.Counts[std::size_t(child)];
            result.Visits.push_back({ child, parent.Cell });
          });
      });
    this->sum(results);
    this->takeVisits(std::move(results));
  }

  void sum(const std::vector<ThreadResult>& results)
  {
    this->Counts.resize(this->Tree.size(), 0);
    for (const ThreadResult& result : results)
    {
      for (std::size_t node = 0; node < this->Tree.size(); ++node)
      {
        this->Counts[node] += result.Counts[node];
      }
    }
  }

  void takeVisits(std::vector<ThreadResult> results)
  {
    this->Visits.clear();
    for (ThreadResult& result : results)
    {
      this->Visits.insert(this->Visits.end(), result.Visits.begin(), result.Visits.end());
      std::vector<Visit>().swap(result.Visits);
    }
  }

  RefinementTree& Tree;
  int Threads;
  NodeCounts Counts;
  std::vector<std::uint8_t> Marked; ///< by node: whether it is a leaf to be split
  std::vector<Visit> Visits;        ///< visits of cells to the marked leaves
};

class TreeBuilder
{
public:
  TreeBuilder(const CellSource& cells, const Box3& domain, const TreeOptions& options,
    vtkMultiProcessController* controller)
    : Cells(cells)
    , Domain(BoxTiling::tree(cells.Dimension, domain, { -1 }).domain())
    , Options(options)
    , Team(controller)
    , Share(this->Team.shareOf(cells.Cells))
  {
  }

  BoxTiling run()
  {
    RefinementTree tree(this->Cells.Dimension, this->Domain);
    for (int pass = 1;; ++pass)
    {
      NodeCounts counts;
      std::string structure;
      RefinementTree mine = tree;
      this->Team.attempt(
        [&]
        {
          counts = this->countShare(mine, this->limit(pass));
          structure = mine.structure();
        });
      if (this->isRead())
      {
        return this->finish(mine, counts);
      }
      const std::string merged = this->mergeStructures(structure);
      if (merged != tree.structure())
      {
        tree.refine(merged);
        continue;
      }
      this->Team.sum(counts);
      const std::vector<std::int32_t> large = leavesAbove(tree, counts, this->Options.Threshold);
      if (large.empty())
      {
        return this->finish(tree, counts);
      }
      for (const std::int32_t leaf : large) // the same on all ranks
      {
        tree.split(leaf);
      }
    }
  }

private:
  std::int64_t chunks() const
  {
    const std::int64_t mine = this->Share.second - this->Share.first;
    return (mine + this->Options.ChunkCells - 1) / this->Options.ChunkCells;
  }

  // Whether all cells are in one chunk on one rank: then one pass counts new nodes completely, too.
  bool isRead() const { return this->Team.size() == 1 && this->chunks() <= 1; }

  // The number of cells above which this rank splits a leaf, by its own counts so far. A leaf with
  // more cells than the threshold in total exceeds this on some rank from the second pass on.
  std::int64_t limit(int pass) const
  {
    const std::int64_t all = this->Options.Threshold;
    if (this->isRead())
    {
      return all;
    }
    const std::int64_t part = all / this->Team.size();
    const std::int64_t early = part / BoxTiling::childCount(this->Cells.Dimension, this->Domain);
    return std::max<std::int64_t>(pass == 1 ? early : part, 1);
  }

  NodeCounts countShare(RefinementTree& tree, std::int64_t limit)
  {
    CellCounter counting(tree, this->Options.Threads);
    counting.add({ this->Cells.Dimension, this->Cells.Corners, nullptr, 0 }, 0, limit);
    for (std::int64_t first = this->Share.first; first < this->Share.second;
         first += this->Options.ChunkCells)
    {
      const std::int64_t count = std::min(this->Options.ChunkCells, this->Share.second - first);
      this->readChunk(first, count);
      counting.add({ this->Cells.Dimension, this->Cells.Corners, this->Coordinates.data(),
                     std::size_t(count) },
        first, limit);
    }
    return counting.counts();
  }

  // If the share is one chunk, it stays in memory.
  void readChunk(std::int64_t first, std::int64_t count)
  {
    if (this->InMemory == std::make_pair(first, count))
    {
      return;
    }
    this->Cells.Read(first, count, this->Coordinates);
    this->InMemory = { first, count };
  }

  /// The structure with the splits of all ranks' trees.
  std::string mergeStructures(const std::string& mine)
  {
    return this->Team.broadcast(this->Team.reduce(mine,
      [this](const std::string& a, const std::string& b)
      {
        RefinementTree both(this->Cells.Dimension, this->Domain);
        both.refine(a);
        both.refine(b);
        return both.structure();
      }));
  }

  /// The tiling of the tree without the splits that the counts do not require.
  BoxTiling finish(const RefinementTree& tree, const NodeCounts& counts) const
  {
    return tree.tiling(
      [&](std::int32_t node) { return counts[std::size_t(node)] > this->Options.Threshold; });
  }

  const CellSource& Cells;
  Box3 Domain;
  const TreeOptions& Options;
  Communicator Team;
  std::pair<std::int64_t, std::int64_t> Share;
  std::vector<double> Coordinates;
  std::pair<std::int64_t, std::int64_t> InMemory = { -1, -1 };
};

} // namespace

BoxTiling buildTree(const CellSource& cells, const Box3& domain, const TreeOptions& options,
  vtkMultiProcessController* controller)
{
  try
  {
    return TreeBuilder(cells, domain, options, controller).run();
  }
  catch (const AcceleratorError& error)
  {
    throw IOError(error.what());
  }
}

} // namespace tipp

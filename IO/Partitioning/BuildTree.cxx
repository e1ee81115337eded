// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/BuildTree.h"

#include "Files/IOError.h"
#include "OpenCL/Devices.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
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
  MeasuredCell cell{ static_cast<std::uint32_t>(index), shape.cell(index), {}, 0.0, false };
  cell.IsFinite = shape.bounds(cell.Corners, cell.Bounds);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
  {
    cell.Length = std::max(cell.Length, cell.Bounds.Max[axis] - cell.Bounds.Min[axis]);
  }
  return cell;
}

bool boundsMeet(const Box3& a, const Box3& b)
{
  return a.Min[0] <= b.Max[0] && b.Min[0] <= a.Max[0] && a.Min[1] <= b.Max[1] &&
    b.Min[1] <= a.Max[1] && a.Min[2] <= b.Max[2] && b.Min[2] <= a.Max[2];
}

bool isWithin(const Box3& a, const Box3& b)
{
  return b.Min[0] <= a.Min[0] && a.Max[0] <= b.Max[0] && b.Min[1] <= a.Min[1] &&
    a.Max[1] <= b.Max[1] && b.Min[2] <= a.Min[2] && a.Max[2] <= b.Max[2];
}

bool meetsBox(const CellShape& shape, const MeasuredCell& cell, const Box3& box)
{
  return boundsMeet(cell.Bounds, box) &&
    (isWithin(cell.Bounds, box) || shape.meets(cell.Corners, box));
}

/// Numbers of cells of each node of a tree.
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

/// Counts cells in the nodes of a tree, which grows at the same time: a leaf with more than `limit`
/// fitting cells is split repeatedly, and the chunk's cells are counted in its children. Cells of
/// earlier chunks are not counted in these children.
class CellCounter
{
public:
  CellCounter(RefinementTree& tree, int maxDepth, int threads)
    : Tree(tree)
    , MaxDepth(maxDepth)
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
      std::max(std::size_t(1) << 17, 8 * (static_cast<std::size_t>(firstCell) + chunk.Cells));
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

  /// Calls visit(item, result) for all items, each thread a range of these with a result of its
  /// own. Returns the results in the order of the ranges.
  template <typename VisitItem>
  std::vector<ThreadResult> onThreads(std::size_t items, const VisitItem& visit) const
  {
    const auto count = static_cast<std::size_t>(this->Threads);
    std::vector<ThreadResult> results(count);
    parallelFor(this->Threads, this->Threads,
      [&](std::int64_t thread)
      {
        const auto t = static_cast<std::size_t>(thread);
        results[t].Counts.resize(this->Tree.size());
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
          (!isWithin(cell.Bounds, this->Tree.domain()) &&
            !shape.meets(cell.Corners, this->Tree.domain())))
        {
          throw IOError("Cell " + std::to_string(firstCell + static_cast<std::int64_t>(i)) +
            (cell.IsFinite ? " lies outside the domain that is partitioned."
                           : " has a corner whose coordinates are not finite."));
        }
        this->visitTree(shape, cell, result);
      }));
  }

  void count(std::int32_t node, const MeasuredCell& cell, ThreadResult& result) const
  {
    const auto index = static_cast<std::size_t>(node);
    ++result.Counts.Meeting[index];
    result.Counts.Fitting[index] += cell.Length <= this->Tree.length(node) ? 1 : 0;
  }

  /// Counts the cell in all nodes that it meets. If leaves are marked, records visits to these
  /// only.
  void visitTree(const CellShape& shape, const MeasuredCell& cell, ThreadResult& result) const
  {
    std::array<std::int32_t, 7 * BoxTiling::MaxDepth + 1> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0)
    {
      const std::int32_t node = stack[--size];
      if (this->Marked.empty())
      {
        this->count(node, cell, result);
      }
      else if (this->Marked[static_cast<std::size_t>(node)] != 0)
      {
        result.Visits.push_back({ node, cell.Index });
      }
      this->forEachChildMet(shape, cell, node, [&](std::int32_t child) { stack[size++] = child; });
    }
  }

  /// Calls visit(child) for the node's children that the cell meets.
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
      if (meetsBox(shape, cell, this->Tree.box(child)))
      {
        visit(child);
      }
    }
  }

  bool markSplits(std::int64_t limit)
  {
    this->Marked.assign(this->Tree.size(), 0);
    bool any = false;
    for (std::size_t index = 0; index < this->Tree.size(); ++index)
    {
      const auto node = static_cast<std::int32_t>(index);
      if (this->Counts.Fitting[index] > limit && this->Tree.isLeaf(node) &&
        this->Tree.canSplit(node, this->MaxDepth))
      {
        this->Marked[index] = 1;
        any = true;
      }
    }
    return any;
  }

  /// Splits the marked leaves and counts the cells that visited them in their children.
  void refineOnce(const CellShape& shape)
  {
    for (std::size_t index = 0, end = this->Tree.size(); index < end; ++index)
    {
      if (this->Marked[index] != 0)
      {
        this->Tree.split(static_cast<std::int32_t>(index));
      }
    }
    const std::vector<Visit> parents = std::move(this->Visits);
    const std::vector<ThreadResult> results = this->onThreads(parents.size(),
      [&](std::size_t i, ThreadResult& result)
      {
        const Visit& parent = parents[i];
        if (this->Marked[static_cast<std::size_t>(parent.Node)] == 0)
        {
          return;
        }
        const MeasuredCell cell = measure(shape, this->Tree.dimension(), parent.Cell);
        this->forEachChildMet(shape, cell, parent.Node,
          [&](std::int32_t child)
          {
            this->count(child, cell, result);
            result.Visits.push_back({ child, parent.Cell });
          });
      });
    this->sum(results);
    this->takeVisits(results);
  }

  void sum(const std::vector<ThreadResult>& results)
  {
    this->Counts.resize(this->Tree.size());
    for (const ThreadResult& result : results)
    {
      for (std::size_t node = 0; node < this->Tree.size(); ++node)
      {
        this->Counts.Meeting[node] += result.Counts.Meeting[node];
        this->Counts.Fitting[node] += result.Counts.Fitting[node];
      }
    }
  }

  void takeVisits(const std::vector<ThreadResult>& results)
  {
    this->Visits.clear();
    for (const ThreadResult& result : results)
    {
      this->Visits.insert(this->Visits.end(), result.Visits.begin(), result.Visits.end());
    }
  }

  RefinementTree& Tree;
  int MaxDepth;
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
    , Domain(BoxTiling::tree(options.Dimension, domain, { -1 }).domain())
    , Options(options)
    , Team(controller)
    , Share(this->Team.shareOf(cells.Cells))
    , MaxDepth(std::min(options.MaxDepth, BoxTiling::MaxDepth))
    , ChunkCells(std::min<std::int64_t>(std::max<std::int64_t>(options.ChunkCells, 1), 1 << 30))
  {
  }

  PartitionTree run()
  {
    RefinementTree tree(this->Options.Dimension, this->Domain);
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
        return this->finish(mine, counts, pass);
      }
      const std::string merged = this->mergeStructures(structure);
      if (merged != tree.structure())
      {
        tree.refine(merged);
        continue;
      }
      this->Team.sum(counts.Meeting);
      this->Team.sum(counts.Fitting);
      if (!this->splitLargeLeaves(tree, counts))
      {
        return this->finish(tree, counts, pass);
      }
    }
  }

private:
  std::int64_t chunks() const
  {
    const std::int64_t mine = this->Share.second - this->Share.first;
    return (mine + this->ChunkCells - 1) / this->ChunkCells;
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
    const std::int64_t early = part / BoxTiling::childCount(this->Options.Dimension, this->Domain);
    return std::max<std::int64_t>(pass == 1 ? early : part, 1);
  }

  NodeCounts countShare(RefinementTree& tree, std::int64_t limit)
  {
    CellCounter counting(tree, this->MaxDepth, this->Options.Threads);
    counting.add({ this->Cells.Dimension, this->Cells.Corners, nullptr, 0 }, 0, limit);
    for (std::int64_t first = this->Share.first; first < this->Share.second;
         first += this->ChunkCells)
    {
      const std::int64_t count = std::min(this->ChunkCells, this->Share.second - first);
      this->readChunk(first, count);
      counting.add({ this->Cells.Dimension, this->Cells.Corners, this->Coordinates.data(),
                     static_cast<std::size_t>(count) },
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
    const auto expected = static_cast<std::size_t>(count) *
      static_cast<std::size_t>(this->Cells.Dimension * this->Cells.Corners);
    if (this->Coordinates.size() != expected)
    {
      throw IOError("Reading " + std::to_string(count) + " cells from cell " +
        std::to_string(first) + " on gave " + std::to_string(this->Coordinates.size()) +
        " coordinates in place of " + std::to_string(expected) + ".");
    }
    this->InMemory = { first, count };
  }

  /// The structure with the splits of all ranks' trees.
  std::string mergeStructures(const std::string& mine)
  {
    return this->Team.broadcast(this->Team.reduce(mine,
      [this](const std::string& a, const std::string& b)
      {
        RefinementTree both(this->Options.Dimension, this->Domain);
        both.refine(a);
        both.refine(b);
        return both.structure();
      }));
  }

  // Splits leaves whose total over all ranks exceeds the threshold. The result is the same on all
  // ranks.
  bool splitLargeLeaves(RefinementTree& tree, const NodeCounts& counts) const
  {
    bool any = false;
    for (std::size_t index = 0, end = tree.size(); index < end; ++index)
    {
      const auto node = static_cast<std::int32_t>(index);
      if (tree.isLeaf(node) && counts.Fitting[index] > this->Options.Threshold &&
        tree.canSplit(node, this->MaxDepth))
      {
        tree.split(node);
        any = true;
      }
    }
    return any;
  }

  PartitionTree finish(const RefinementTree& tree, const NodeCounts& counts, int passes) const
  {
    std::vector<std::int32_t> leaves;
    PartitionTree result = {
      tree.tiling([&](std::int32_t node)
        { return counts.Fitting[static_cast<std::size_t>(node)] > this->Options.Threshold; },
        leaves),
      {}, passes
    };
    for (const std::int32_t leaf : leaves)
    {
      result.Cells.push_back(counts.Meeting[static_cast<std::size_t>(leaf)]);
    }
    return result;
  }

  const CellSource& Cells;
  Box3 Domain;
  const TreeOptions& Options;
  Communicator Team;
  std::pair<std::int64_t, std::int64_t> Share;
  int MaxDepth;
  std::int64_t ChunkCells;
  std::vector<double> Coordinates;
  std::pair<std::int64_t, std::int64_t> InMemory = { -1, -1 };
};

} // namespace

PartitionTree buildTree(const CellSource& cells, const Box3& domain, const TreeOptions& options,
  vtkMultiProcessController* controller)
{
  if (options.Threshold < 1)
  {
    throw IOError("A tree of partitions needs a threshold of at least one cell, not " +
      std::to_string(options.Threshold) + ".");
  }
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

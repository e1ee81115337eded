// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/BuildTree.h"

#include "Files/IOError.h"
#include "OpenCL/Devices.h"
#include "Partitioning/CellCounter.h"
#include "Partitioning/Ranks.h"
#include "Partitioning/RefinementTree.h"

#include <algorithm>
#include <string>
#include <utility>

namespace tipp
{
namespace
{

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
        tree = RefinementTree(this->Options.Dimension, this->Domain, merged);
        continue;
      }
      counts.Meeting = this->Team.sum(counts.Meeting);
      counts.Fitting = this->Team.sum(counts.Fitting);
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
  bool isRead() const { return this->Team.count() == 1 && this->chunks() <= 1; }

  // The number of cells above which this rank splits a leaf, by its own counts so far. A leaf with
  // more cells than the threshold in total exceeds this on some rank from the second pass on.
  std::int64_t limit(int pass) const
  {
    const std::int64_t all = this->Options.Threshold;
    if (this->isRead())
    {
      return all;
    }
    const std::int64_t part = all / this->Team.count();
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

  std::string mergeStructures(const std::string& mine) const
  {
    const int childCount = BoxTiling::childCount(this->Options.Dimension, this->Domain);
    return this->Team.broadcast(this->Team.reduce(mine,
      [childCount](const std::string& a, const std::string& b)
      { return RefinementTree::merged(a, b, childCount); }));
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
  Ranks Team;
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

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConflictGraph_h
#define tippConflictGraph_h

#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// An undirected graph: which partitions, or which pieces (sets of partitions), conflict.
class VTKTIPPFILTERS_EXPORT ConflictGraph
{
public:
  using Pair = std::pair<PartitionIndex, PartitionIndex>;

  ConflictGraph() = default;
  /// A graph of `count` nodes without conflicts.
  explicit ConflictGraph(std::size_t count)
    : Ends(count, 0)
  {
  }

  /// Adds conflicts. Both (a, b) and (b, a) must be given; repetitions are allowed.
  void add(const std::vector<Pair>& pairs);

  /// The sum of all nodes' neighbour counts.
  std::size_t neighbourCount() const { return this->Neighbours.size(); }

  std::size_t size() const { return this->Ends.size(); }

  /// @name The neighbours of p, in ascending order
  ///@{
  const PartitionIndex* begin(PartitionIndex p) const
  {
    return this->Neighbours.data() + (p == 0 ? 0 : this->Ends[std::size_t(p) - 1]);
  }
  const PartitionIndex* end(PartitionIndex p) const
  {
    return this->Neighbours.data() + this->Ends[std::size_t(p)];
  }
  PartitionIndex* begin(PartitionIndex p)
  {
    return const_cast<PartitionIndex*>(std::as_const(*this).begin(p));
  }
  PartitionIndex* end(PartitionIndex p)
  {
    return const_cast<PartitionIndex*>(std::as_const(*this).end(p));
  }
  ///@}

  /// Returns each node's colour, counted from 0; conflicting nodes have different colours. Greedy,
  /// nodes with most conflicts first.
  std::vector<std::uint32_t> colours() const;

private:
  std::vector<std::size_t> Ends; ///< one past each node's last entry in Neighbours
  std::vector<PartitionIndex> Neighbours;
};

} // namespace tipp

#endif

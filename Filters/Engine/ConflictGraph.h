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

/// Which of some things conflict: partitions, or pieces of them. Symmetric.
class VTKTIPPFILTERS_EXPORT ConflictGraph
{
public:
  using Pair = std::pair<PartitionIndex, PartitionIndex>;

  ConflictGraph() = default;
  /// Of `count` things, without conflicts so far.
  explicit ConflictGraph(std::size_t count)
    : Ends(count, 0)
  {
  }

  /// Adds conflicts: both (a, b) and (b, a), each as often as you like.
  void add(const std::vector<Pair>& pairs);

  /// How many neighbours all have together.
  std::size_t neighbourCount() const { return this->Neighbours.size(); }

  std::size_t size() const { return this->Ends.size(); }

  /// @name Those that conflict with one
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

  /// Of each thing, a colour that no conflicting one has, counted from 0 on. Greedy: those with
  /// most conflicts first.
  std::vector<std::uint32_t> colours() const;

private:
  std::vector<std::size_t> Ends; ///< of each one's neighbours
  std::vector<PartitionIndex> Neighbours;
};

} // namespace tipp

#endif

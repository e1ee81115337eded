// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMetPartitions_h
#define tippMetPartitions_h

#include "Engine/PartitionIndex.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

/// Stores sets of partitions, each once, and numbers them: many triangles meet the same partitions.
class VTKTIPPFILTERS_EXPORT PartitionSets
{
public:
  /// Returns the set's number, counted from 0; adds the set if it is new.
  std::uint32_t number(const PartitionIndex* first, const PartitionIndex* last);

  std::size_t size() const { return this->Ends.size(); }
  const PartitionIndex* begin(std::uint32_t set) const
  {
    return this->Members.data() + (set == 0 ? 0 : this->Ends[set - 1]);
  }
  const PartitionIndex* end(std::uint32_t set) const
  {
    return this->Members.data() + this->Ends[set];
  }

private:
  std::vector<PartitionIndex> Members; ///< partitions of all sets, concatenated
  std::vector<std::size_t> Ends;       ///< one past each set's last entry in Members
  std::unordered_multimap<std::uint64_t, std::uint32_t> ByHash; ///< numbers
  std::uint32_t Last = 0; ///< the number returned last, often repeated
};

/// The partitions that each of several cells meets. The sets are shared to save memory: for
/// co-circular points there are as many triangles as points, and each meets all partitions.
struct MetPartitions
{
  std::vector<std::uint32_t> SetOf; ///< by cell: its set's number in Sets
  PartitionSets Sets;
  /// The pairs of different sets of cells with a common edge or facet; only of an initial mesh.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> AdjacentSets;

  const PartitionIndex* metBegin(std::size_t i) const { return this->Sets.begin(this->SetOf[i]); }
  const PartitionIndex* metEnd(std::size_t i) const { return this->Sets.end(this->SetOf[i]); }
};

} // namespace tipp

#endif

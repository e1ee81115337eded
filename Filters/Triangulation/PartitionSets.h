// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionSets_h
#define tippPartitionSets_h

#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Stores sets of partitions, each once, and numbers them: many triangles meet the same partitions.
class VTKTIPPFILTERS_EXPORT PartitionSets
{
public:
  void clear();

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
  bool isEqual(std::uint32_t set, const PartitionIndex* first, const PartitionIndex* last) const;
  std::uint32_t& slot(const PartitionIndex* first, const PartitionIndex* last);
  void enlargeTable();

  std::vector<PartitionIndex> Members; ///< of all sets, concatenated
  std::vector<std::size_t> Ends;       ///< one past each set's last entry in Members
  std::vector<std::uint32_t> Table;    ///< hash table of numbers
  std::uint32_t Last = 0;              ///< the number returned last, often repeated
};

} // namespace tipp

#endif

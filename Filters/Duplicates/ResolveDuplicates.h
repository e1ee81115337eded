// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResolveDuplicates_h
#define tippResolveDuplicates_h

#include "Points/PointTable.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Which values are kept if several points coincide.
enum class DuplicateRule
{
  First,   ///< those of the first point
  Lowest,  ///< those of the first point that is lowest by findRankColumn()
  Highest, ///< those of the first point that is highest
  Mean     ///< of each column the mean of the values that there are
};

/// Throws IOError if the rule needs a column that findRankColumn() finds and there is none.
VTKTIPPFILTERS_EXPORT void requireElevation(
  DuplicateRule rule, const std::vector<std::string>& columns);

/// A column of values, one for each point; it does not own them.
struct ValueColumn
{
  double* Values;
  std::size_t Stride;

  double& operator[](std::int64_t point) const
  {
    return this->Values[std::size_t(point) * this->Stride];
  }
};

/// Gives each representative the values that the rule selects among the points that coincide with
/// it. Returns the number of representatives whose coincident points disagree: in the elevation, or
/// in any column if there is none. `elevation` is the index of its column, or the number of
/// columns.
std::int64_t resolveDuplicates(std::vector<Duplicate> duplicates,
  const std::vector<ValueColumn>& columns, std::size_t elevation, DuplicateRule rule);

VTKTIPPFILTERS_EXPORT std::int64_t resolveDuplicates(
  PointTable& points, std::vector<Duplicate> duplicates, DuplicateRule rule);

} // namespace tipp

#endif

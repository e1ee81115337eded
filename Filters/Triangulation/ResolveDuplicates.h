// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResolveDuplicates_h
#define tippResolveDuplicates_h

#include "Points/ReadPoints.h"
#include "Triangulation/Duplicate.h"
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
  First,   ///< the values of the first point
  Lowest,  ///< the values of the first point that is lowest in the column found by findRankColumn()
  Highest, ///< the values of the first point that is highest in it
  Mean     ///< the mean of each column, ignoring values that are not finite
};

/// Throws IOError if the rule needs the column of findRankColumn() and there is none.
VTKTIPPFILTERS_EXPORT void requireElevation(
  DuplicateRule rule, const std::vector<std::string>& columns);

/// A column of values, one for each point; it does not own them.
struct ValueColumn
{
  double* Values;     ///< value of the first point
  std::size_t Stride; ///< distance between the values of successive points, in doubles

  double& operator[](std::int64_t point) const
  {
    return this->Values[std::size_t(point) * this->Stride];
  }
};

/// Sets each representative's values to those that the rule selects among the points that coincide
/// with it. Returns the number of representatives whose coincident points differ in elevation, or
/// in any column if there is no elevation. `elevation` is the index of its column, or the number of
/// columns if there is none.
std::int64_t resolveDuplicates(std::vector<Duplicate> duplicates,
  const std::vector<ValueColumn>& columns, std::size_t elevation, DuplicateRule rule);

VTKTIPPFILTERS_EXPORT std::int64_t resolveDuplicates(
  PointTable& points, std::vector<Duplicate> duplicates, DuplicateRule rule);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankColumn_h
#define tippRankColumn_h

#include "Points/PointTable.h"

namespace tipp
{

/// Returns the index of the column by which the lowest and highest of points are found: the
/// elevation, else the depth, else the only column; the number of columns if there is none.
inline std::size_t findRankColumn(const std::vector<std::string>& columns)
{
  const std::size_t elevation = findElevation(columns);
  if (elevation < columns.size() || columns.size() == 1)
  {
    return elevation < columns.size() ? elevation : 0;
  }
  return std::size_t(std::find(columns.begin(), columns.end(), "depth") - columns.begin());
}

} // namespace tipp

#endif

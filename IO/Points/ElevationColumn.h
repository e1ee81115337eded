// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippElevationColumn_h
#define tippElevationColumn_h

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{

/// The column that is the elevation: z, Z or elevation; the number of columns if there is none.
inline std::size_t findElevation(const std::vector<std::string>& columns)
{
  for (const char* const name : { "z", "Z", "elevation" })
  {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found != columns.end())
    {
      return std::size_t(found - columns.begin());
    }
  }
  return columns.size();
}

} // namespace tipp

#endif

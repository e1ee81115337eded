// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointTable_h
#define tippPointTable_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Points as a file gives them: x and y interleaved, and the further numeric columns by name.
struct PointTable
{
  struct Column
  {
    std::string Name;
    std::vector<double> Values; ///< one a point
  };

  std::vector<double> XY;
  std::vector<Column> Columns;
  std::int64_t LeftOut = 0;    ///< points that the options have left out
  std::int64_t ThinnedOut = 0; ///< points that thinning has left out

  VTKTIPPIO_EXPORT std::size_t size() const;
};

} // namespace tipp

#endif

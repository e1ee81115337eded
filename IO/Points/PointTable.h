// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointTable_h
#define tippPointTable_h

#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{

/// Points as a file gives them: x and y interleaved, and any further columns by name.
struct PointTable
{
  struct Column
  {
    std::string name;
    std::vector<double> values;
  };

  std::vector<double> xy;
  std::vector<Column> columns;

  VTKTIPPIO_EXPORT std::size_t size() const;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippColumnChoice_h
#define tippColumnChoice_h

#include "Points/ReadPoints.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{

struct ColumnChoice
{
  std::size_t X = 0;
  std::size_t Y = 1;
};

/// Finds x and y among a file's columns; `names` is empty or as long as `count`. Throws IOError if
/// there are fewer than two columns or the options ask for one that is not there.
ColumnChoice chooseColumns(const std::string& path, const std::vector<std::string>& names,
  std::size_t count, const PointOptions& options);

} // namespace tipp

#endif

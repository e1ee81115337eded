// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Points/NpyPoints.h"

namespace tipp
{

PointTable readPoints(const std::string& path, const PointOptions& options)
{
  return readNpyPoints(path, options);
}

} // namespace tipp

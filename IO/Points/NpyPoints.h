// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyPoints_h
#define tippNpyPoints_h

#include "Points/ReadPoints.h"

namespace tipp
{

/// Points from an .npy table of two or three columns, named x, y and z.
/// Of its rows, the share that is the part's of so many parts.
PointTable readNpyPoints(
  const std::string& path, const PointOptions& options, int part = 0, int parts = 1);

} // namespace tipp

#endif

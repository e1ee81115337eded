// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyPoints_h
#define tippNpyPoints_h

#include "Points/ReadPoints.h"

namespace tipp
{

/// Points from an .npy table of two or three columns, named x, y and z.
PointTable readNpyPoints(const std::string& path, const PointOptions& options);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasPoints_h
#define tippLasPoints_h

#include "Points/FilePoints.h"

#include <memory>
#include <string>

namespace tipp
{

/// The points of a LAS or LAZ file, read in blocks: x, y, and the columns z, intensity,
/// classification, gps_time, red, green, blue and nir, as far as the file's format has them.
/// Throws IOError.
std::unique_ptr<FilePoints> openLasPoints(const std::string& path, const PointOptions& options);

} // namespace tipp

#endif

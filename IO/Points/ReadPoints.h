// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadPoints_h
#define tippReadPoints_h

#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

#include <string>

namespace tipp
{

/// Which columns are x and y: a name as the file's header gives it, or a number counted from 0.
/// Empty: by the usual names (x, y; lon, lat; longitude, latitude; easting, northing), else the
/// first two.
struct PointOptions
{
  std::string X;
  std::string Y;
};

/// Reads points by the file's extension:
/// .npy (n x 2 or n x 3, float64 or float32); .csv, .txt, .xyz (one point a line, columns parted by
/// comma, semicolon, tab or spaces, with or without a line of names or a line with the count
/// first); .14, .grd (ADCIRC grids: nodes and depth); any format that VTK reads (points and
/// point data, a column for each component). Throws IOError.
VTKTIPPIO_EXPORT PointTable readPoints(const std::string& path, const PointOptions& options = {});

/// A part's share of a file's points, of so many parts: consecutive points where a file can be read
/// from its middle (.npy), else all for part 0 and none for the others. Throws IOError.
VTKTIPPIO_EXPORT PointTable readPointsShare(
  const std::string& path, const PointOptions& options, int part, int parts);

} // namespace tipp

#endif

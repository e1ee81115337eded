// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadPoints_h
#define tippReadPoints_h

#include "Las/LasSelection.h"
#include "Points/PointTable.h"
#include "Points/Thinning.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

class PointStream;

struct PointOptions
{
  /// Which columns are x and y: a name as the file's header gives it, or a number counted from 0.
  /// Empty: by the usual names (x, y; lon, lat; longitude, latitude; easting, northing), else the
  /// first two.
  std::string X;
  std::string Y;
  LasSelection Las = {};
  Thinning Thin = {}; ///< of the points of all files together
  int Threads = 1;    ///< that decode LAS files; 0: OpenMP's choice
  /// The further columns to read, of those that there are; without: all.
  std::optional<std::vector<std::string>> Columns = {};

  bool wants(const std::string& column) const
  {
    return !this->Columns ||
      std::find(this->Columns->begin(), this->Columns->end(), column) != this->Columns->end();
  }
};

/// Reads points by the file's extension:
/// .npy (n x 2 or n x 3, float64 or float32); .csv, .txt, .xyz (one point a line, columns parted by
/// comma, semicolon, tab or spaces, with or without a line of names or a line with the count
/// first); .las, .laz (see LasPoints.h); .14, .grd (ADCIRC grids: nodes and depth); any format that
/// VTK reads (points and point data, a column for each component). Throws IOError.
VTKTIPPIO_EXPORT PointTable readPoints(const std::string& path, const PointOptions& options = {});

/// The points of several files, one after the other. Throws IOError.
VTKTIPPIO_EXPORT PointTable readPoints(
  const std::vector<std::string>& paths, const PointOptions& options);

/// All that is in a stream's limits. Throws IOError.
VTKTIPPIO_EXPORT PointTable readAllPoints(PointStream& stream);

/// A part's share of the files' points, of so many parts: consecutive points where files can be
/// read from their middle (.npy, .las), else all for part 0 and none for the others. Throws
/// IOError.
VTKTIPPIO_EXPORT PointTable readPointsShare(
  const std::vector<std::string>& paths, const PointOptions& options, int part, int parts);

} // namespace tipp

#endif

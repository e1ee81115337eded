// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCheckQuality_h
#define tippCheckQuality_h

#include "Constraints/ReadConstraintFile.h"
#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"

#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// What 'tipp check --quality' checks.
struct QualityArguments
{
  std::string Points; ///< path of the input's points besides those of the constraints; empty: none
  std::string Mesh;   ///< path
  std::vector<std::string> Constraints; ///< paths
  PointOptions Columns;
  std::string MinAngle; ///< in degrees, as it was given
  std::optional<double> MaxArea;
  std::string Size; ///< a number, or the path of a raster; empty: no limit
  std::optional<double> LeastSize;
  std::optional<double> LargestSize;
  bool Geographic = false; ///< x and y are degrees, and sizes are metres
  /// The outer pixel borders of Size if it is an .npy file.
  std::optional<Box2> RasterBounds;
  std::string Listed; ///< path of a file of --stats; empty: none
};

/// Checks a refined mesh, prints the result and returns the exit code. Throws IOError if a file
/// cannot be read, and std::invalid_argument if MinAngle is no angle from 0 to 60 degrees.
int checkQualityOfFiles(const QualityArguments& arguments);

/// Reads files of constraints into one table. `wrap`: PointOptions::Wrap. Throws IOError, also if
/// some files have their own points and others refer to points by their numbers.
ConstraintTable readConstraintFiles(const std::vector<std::string>& paths, int wrap);

} // namespace tipp

#endif

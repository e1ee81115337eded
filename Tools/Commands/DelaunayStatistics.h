// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayStatistics_h
#define tippDelaunayStatistics_h

#include "Distributed/DistributedTriangulation.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <string>

namespace tipp
{

/// What a run of `tipp delaunay` tells about itself.
struct DelaunayRun
{
  std::string Input;
  std::string Output;
  std::int64_t DisagreeingPlaces = 0; ///< of several points with different elevations
  std::int64_t Points = 0;
  double ReadSeconds = 0; ///< all seconds are wall clock
  double TriangulateSeconds = 0;
  double WriteSeconds = 0;
};

/// One line: points, triangles, duplicates, rejected if any, seconds and points per second of the
/// triangulation alone, peak memory of the process.
std::string summarize(const DelaunayRun& run, const Triangulation& result);

/// The same and all of TriangulationStatistics as a JSON file; throws IOError.
void writeStatistics(const std::string& path, const DelaunayRun& run, const Triangulation& result);

///@{
/// The same of a run on ranks.
std::string summarize(
  const DelaunayRun& run, const Triangulation& all, const DistributedStatistics& statistics);
void writeStatistics(
  const std::string& path, const DelaunayRun& run, const DistributedTriangulation& result);
///@}

} // namespace tipp

#endif

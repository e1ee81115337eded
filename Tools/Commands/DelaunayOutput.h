// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayOutput_h
#define tippDelaunayOutput_h

#include "Commands/DelaunayArguments.h"
#include "Distributed/DistributedTriangulation.h"
#include "Files/OutputPath.h"
#include "Points/PointTable.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <string>

namespace tipp
{

/// Whether such an output holds arrays of points and cells; not .npy and .14.
bool holdsArrays(const std::string& path);

/// The whole input, without columns that the output does not keep.
PointTable readPointsFor(const DelaunayArguments& arguments);

/// Throws IOError unless the output files can be written; call it before the work. Returns the
/// state of the output's path; writeResult() replaces nothing else.
PathState requireWritable(const DelaunayArguments& arguments);

/// Returns false if the user interrupted it; then no file is written.
bool writeResult(const DelaunayArguments& arguments, const PointTable& points,
  const Triangulation& result, const PathState& before);

/// What `tipp delaunay` reports of a run besides the result's own statistics.
struct DelaunayRun
{
  std::string Input;
  std::string Output;
  std::int64_t DisagreeingPositions = 0; ///< of several points with different elevations
  std::int64_t Points = 0;
  double ReadSeconds = 0; ///< all times are wall-clock seconds
  double TriangulateSeconds = 0;
  double WriteSeconds = 0;
};

/// One line: points, triangles, duplicates, rejected points if any, seconds and points per second
/// of the triangulation alone, and peak memory of the process.
std::string summarize(const DelaunayRun& run, const Triangulation& result);

/// Writes the same and all of TriangulationStatistics to a JSON file; throws IOError.
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

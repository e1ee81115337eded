// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayOutput_h
#define tippDelaunayOutput_h

#include "Commands/DelaunayArguments.h"
#include "Files/OutputPath.h"
#include "Points/PointTable.h"
#include "Triangulation/Triangulate.h"

namespace tipp
{

/// The whole input, without columns that the output does not keep.
/// Whether such an output holds arrays of points and cells; not .npy and .14.
bool holdsArrays(const std::string& path);

PointTable readPointsFor(const DelaunayArguments& arguments);

/// Throws IOError unless the files to write can be: before hours of work rather than after them.
/// Returns what is at the output's path, which alone writeResult() may replace.
PathState requireWritable(const DelaunayArguments& arguments);

/// False if the user has interrupted it; then there is no file.
bool writeResult(const DelaunayArguments& arguments, const PointTable& points,
  const Triangulation& result, const PathState& before);

void warnOfNoTriangles(const Triangulation& result);

} // namespace tipp

#endif

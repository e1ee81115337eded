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

/// Throws IOError unless the output files can be written; call it before the work. Returns the
/// state of the output's path; writeResult() replaces nothing else.
PathState requireWritable(const DelaunayArguments& arguments);

/// Returns false if the user interrupted it; then no file is written.
bool writeResult(const DelaunayArguments& arguments, const PointTable& points,
  const Triangulation& result, const PathState& before);

void warnOfNoTriangles(const Triangulation& result);

} // namespace tipp

#endif

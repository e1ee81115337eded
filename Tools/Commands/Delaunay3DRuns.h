// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunay3DRuns_h
#define tippDelaunay3DRuns_h

#include "Files/OutputPath.h"
#include "Output/RunStatistics.h"
#include "Points/PointTable.h"
#include "Points/ReadPoints.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

/// The options of `tipp delaunay3d`.
struct Delaunay3DArguments
{
  std::vector<std::string> Inputs;
  std::string Output;
  PointOptions Columns;
  int Threads = 0;
  int Partitions = 0;
  bool MapDuplicates = false;
  bool Neighbors = false;
  std::string Statistics;
  // For a run out of core:
  std::string Memory; ///< empty: not given
  bool Resume = false;
  std::string Scratch;
};

/// Returns the points in space. `elevation`: the index of the column with the third coordinate.
std::vector<Point3> coordinatesOf(const PointTable& table, std::size_t elevation);

/// Writes the tetrahedra, or the triangles of coplanar points. `before`: from requireWritable().
/// Returns false, without a file, if the user interrupted it. Throws IOError.
bool writeResult(const Delaunay3DArguments& arguments, PointTable&& table,
  const Tetrahedralization& mesh, const Triangulation& triangles, const PathState& before);

/// Prints the summary, which ends with `ranks`, and writes the file of statistics, if one is
/// requested.
void report(const Delaunay3DArguments& arguments, const Tetrahedralization& mesh,
  const Triangulation& triangles, std::int64_t points, double seconds,
  const RunStatistics& statistics, const std::string& ranks);

/// Runs `tipp delaunay3d`, in memory, on the ranks of a controller. Every rank reads its share of
/// the points; the first one writes the output and prints messages. Returns the exit code, which is
/// the same on all ranks.
int runDelaunay3DOnRanks(
  const Delaunay3DArguments& arguments, vtkMultiProcessController* controller);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayRuns_h
#define tippDelaunayRuns_h

#include "Constraints/ConstrainedPoints.h"
#include "Constraints/TableConstraints.h"
#include "Distributed/DistributedTriangulation.h"
#include "Duplicates/ResolveDuplicates.h"
#include "Files/OutputPath.h"
#include "Points/PointTable.h"
#include "Points/ReadPoints.h"
#include "Triangulation/Triangulate.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

/// The options of `tipp delaunay`.
struct DelaunayArguments
{
  std::vector<std::string> Inputs;
  std::string Input; ///< the first
  std::string Output;
  PointOptions Columns;
  int Threads = 0;
  std::string Partitions = "auto";
  std::string Order = "dynamic";
  std::string Masters = "auto";
  std::string Major = "auto";
  std::string Minor = "auto";
  std::string Groups = "proportional";
  int InitialPoints = 0;
  double MaximumEdge = 0; ///< 0: not given
  bool MapDuplicates = false;
  DuplicateRule Duplicates = DuplicateRule::First;
  bool Neighbors = false;
  ConstraintFiles Constraints;
  bool MarkConstraints = false;
  std::string Statistics;
  // Of a run out of core:
  std::string Memory; ///< empty: not given
  std::string Sink = "mesh";
  bool Resume = false;
  std::string Scratch;

  /// Whether an option is given that only a run on ranks has; a single rank can run it, too.
  bool isForRanks() const
  {
    return this->Masters != "auto" || this->Major != "auto" || this->Minor != "auto";
  }
};

/// Parses "auto" (no columns and rows) or a grid; nullopt for any other text.
std::optional<GridSize> parseGrid(const std::string& text);

struct MinorChoice
{
  Division Kind = Division::Tree;
  GridSize Grid;
  std::int64_t Threshold = 0;
};
std::optional<MinorChoice> parseMinor(const std::string& text);

DistributedOptions makeDistributedOptions(const DelaunayArguments& arguments);

/// A line of a report.
std::string describeSegments(const ConstraintFigures& figures);

/// What is wrong if constraints add points, but the output holds triangles alone.
std::string describeAdded(std::int64_t points, const DelaunayArguments& arguments);

/// Triangulates with the constraints that --constraints and --boundary name. The points of their
/// files that are not among the points come after these, then the points where constraints cross. A
/// column of the new points is what the constraints' file has as height, if it is named z; else
/// NaN. A column of a crossing is interpolated. `report` becomes a line about the constraints.
/// Throws IOError.
Triangulation triangulateWithConstraints(const DelaunayArguments& arguments, PointTable& points,
  const TriangulationOptions& options, std::string& report);

/// Runs `tipp delaunay` on the ranks of a controller, or on this process alone (null). Every rank
/// reads its share of the points; the first one writes the output and prints messages. Returns the
/// exit code, the same on all ranks.
int runDelaunayOnRanks(const DelaunayArguments& arguments, vtkMultiProcessController* controller);

/// Whether the output is a partitioned mesh, which is computed out of core.
bool isOutOfCore(const DelaunayArguments& arguments);

/// Runs `tipp delaunay` with such an output on the ranks of a controller, or on this process alone
/// (null). Returns the exit code, the same on all ranks.
int runDelaunayOutOfCore(const DelaunayArguments& arguments, vtkMultiProcessController* controller);

/// Returns the given options that are valid only for such an output, if the output is another one;
/// empty if there are none.
std::string misplacedOutOfCoreOption(const DelaunayArguments& arguments);

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

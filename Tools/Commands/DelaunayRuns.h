// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayRuns_h
#define tippDelaunayRuns_h

#include "Commands/PointArguments.h"
#include "Constraints/OnDisk/ConstrainedPoints.h"
#include "Constraints/TableConstraints.h"
#include "Distributed/DistributedTriangulation.h"
#include "Duplicates/ResolveDuplicates.h"
#include "Files/OutputPath.h"
#include "Points/PointTable.h"
#include "Points/ReadPoints.h"
#include "Triangulation/Triangulate.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

/// The options of `tipp delaunay`.
struct DelaunayArguments : RunArguments
{
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
  std::string Sink = "mesh"; ///< of a run out of core

  /// Returns whether an option is given that needs the code for several ranks, even if there is
  /// one.
  bool isForRanks() const
  {
    return this->Masters != "auto" || this->Major != "auto" || this->Minor != "auto";
  }
};

/// Parses "auto", which gives no columns and rows, or a grid such as "8x8"; nullopt for other text.
std::optional<GridSize> parseGrid(const std::string& text);

/// How a major partition is divided into minor ones.
struct MinorChoice
{
  Division Kind = Division::Tree;
  GridSize Grid;
  std::int64_t Threshold = 0;
};
/// Parses "auto", a grid such as "8x8", "auto:T" or "tree:T"; nullopt for other text.
std::optional<MinorChoice> parseMinor(const std::string& text);

/// Returns the options of a run on ranks.
DistributedOptions makeDistributedOptions(const DelaunayArguments& arguments);

/// Returns a line about the constraints, for the report of a run.
std::string describeSegments(const ConstraintFigures& figures);

/// Returns an error message: constraints add points, but the output stores triangles only.
std::string describeAdded(std::int64_t points, const DelaunayArguments& arguments);

/// Triangulates with the constraints that --constraints and --boundary name. Appends to `points`
/// those of their files that are not in it yet, and then the points where constraints cross. In the
/// column z, a new point has the height from the constraints' file; its other columns are NaN.
/// Columns of a crossing are interpolated. Sets `report` to a line about the constraints. Throws
/// IOError.
Triangulation triangulateWithConstraints(const DelaunayArguments& arguments, PointTable& points,
  const TriangulationOptions& options, std::string& report);

/// Runs `tipp delaunay` on the ranks of a controller, or in this process alone (null). Every rank
/// reads its share of the points; the first one writes the output and prints messages. Returns the
/// exit code, which is the same on all ranks.
int runDelaunayOnRanks(const DelaunayArguments& arguments, vtkMultiProcessController* controller);

/// Runs `tipp delaunay` out of core on the ranks of a controller, or in this process alone (null).
/// Returns the exit code, which is the same on all ranks.
int runDelaunayOutOfCore(const DelaunayArguments& arguments, vtkMultiProcessController* controller);

/// Returns whether a file of this kind stores arrays of points and cells; .npy and .14 do not.
bool holdsArrays(const std::string& path);

/// Reads the whole input, without the columns that the output does not store. Throws IOError.
PointTable readPointsFor(const DelaunayArguments& arguments);

/// Throws IOError unless the output files can be written. Call it before the computation. Returns
/// the state of the output's path; writeResult() refuses to replace anything else.
PathState requireWritable(const DelaunayArguments& arguments);

/// Writes the output. Returns false, without a file, if the user interrupted it. Throws IOError.
bool writeResult(const DelaunayArguments& arguments, const PointTable& points,
  const Triangulation& result, const PathState& before);

/// The figures of a run of `tipp delaunay`, besides the result's own statistics.
struct DelaunayRun
{
  std::int64_t DisagreeingPositions = 0; ///< positions whose points have different elevations
  std::int64_t Points = 0;
  double ReadSeconds = 0; ///< all times are wall-clock seconds
  double TriangulateSeconds = 0;
  double WriteSeconds = 0;
};

/// Writes these figures and the run's statistics to the file of --stats, if there is one, and
/// prints a summary, which ends with `more`. Throws IOError.
void reportRun(const DelaunayArguments& arguments, const DelaunayRun& run,
  const nlohmann::ordered_json& statistics, const std::string& more = "");

} // namespace tipp

#endif

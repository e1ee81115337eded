// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryMesh_h
#define tippQueryMesh_h

#include "Files/PendingOutput.h"
#include "Resident/ResidentMesh.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
}

namespace tipp
{

class Communicator;

/// The mesh that a command queries, and how.
struct QueryMeshArguments
{
  std::string Path;
  /// Memory limit for the pieces of a partitioned mesh, as text.
  std::string Memory = "1G";
  /// Time step of arrays that vary in time.
  int Step = 0;
  int Threads = 0;
};

/// Adds --step, --memory and --threads.
void addQueryMeshOptions(CLI::App& command, QueryMeshArguments& arguments);

/// Opens a partitioned mesh, or reads a VTK file of any kind. Throws IOError.
std::unique_ptr<ResidentMesh> openQueryMesh(const QueryMeshArguments& arguments);

/// Runs a collective function on all ranks, until it returns or Ctrl-C is pressed. Prints the
/// message of any exception. Returns the command's exit code.
int runOnRanks(const std::function<void(Communicator&)>& work);

/// Returns a name as a field of a .csv file, in quotes if necessary.
std::string quotedField(const std::string& name);

/// The options of --zones.
struct ZoneArguments
{
  std::string Path;
  std::string Field; ///< the field with the zones' names; empty: zones are numbered
  double Level = 0;  ///< volumes are computed above this value
};

/// The options of --ids.
struct RegionArguments
{
  std::string Ids; ///< "cells" or "points"; empty: not given
  std::vector<double> Bounds;
  std::string Polygons; ///< path of a file
  bool Whole = false;   ///< only cells that lie completely in the region
};

/// Adds --ids and the options that define regions. Returns the option --ids.
CLI::Option* addRegionOptions(CLI::App& command, RegionArguments& arguments);

// Each of these functions queries the mesh, and writes the file on the first rank. `shared`: the
// ranks that share the mesh, all of which must call the function; null: this process alone.
// `before`: the first rank's state of the output's path before the query. They throw IOError.

/// Writes statistics of arrays in the zones of a file, as .csv.
void writeZones(Communicator* shared, const ResidentMesh& mesh, const ZoneArguments& arguments,
  const std::vector<std::string>& arrays, const std::string& output, const PathState& before);

/// Writes the lines of steepest descent from this rank's points, as .vtp.
void writeDescents(Communicator* shared, const ResidentMesh& mesh,
  const std::vector<Point3>& points, const std::string& array, const std::string& output,
  const PathState& before);

/// Writes the ids of the cells or points in a region, as .csv or .npy.
void writeRegion(Communicator* shared, const ResidentMesh& mesh, const RegionArguments& arguments,
  const std::string& output, const PathState& before);

} // namespace tipp

#endif

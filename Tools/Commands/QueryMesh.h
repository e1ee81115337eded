// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryMesh_h
#define tippQueryMesh_h

#include "Files/OutputPath.h"
#include "Query/ResidentMesh.h"

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

/// The mesh that a command queries.
struct QueryMeshArguments
{
  std::string Path;
  std::string Memory = "1G";
  int Step = 0;
  int Threads = 0;
};

/// Adds --step, --memory and --threads.
void addQueryMeshOptions(CLI::App& command, QueryMeshArguments& arguments);

/// Opens a partitioned mesh, or reads any VTK file. Throws IOError.
std::unique_ptr<ResidentMesh> openQueryMesh(const QueryMeshArguments& arguments);

/// Runs a collective function on all ranks, until Ctrl-C; returns the command's exit code. Reports
/// what the function throws.
int runOnRanks(const std::function<void(Communicator&)>& work);

/// A name as a field of a .csv file, in quotes if it needs them.
std::string quotedField(const std::string& name);

struct ZoneArguments
{
  std::string Path;
  std::string Field; ///< with the zones' names; empty: they are numbered
  double Level = 0;  ///< for the volumes above it
};

/// Cells or points in a region.
struct RegionArguments
{
  std::string Ids; ///< "cells" or "points"; empty: not asked
  std::vector<double> Bounds;
  std::string Polygons; ///< a file
  bool Whole = false;   ///< only cells that lie in it
};

/// Adds --ids and the options of regions; returns --ids.
CLI::Option* addRegionOptions(CLI::App& command, RegionArguments& arguments);

// Each function asks the mesh, or if all ranks share it, all of them, and writes the file on the
// first rank; `before` is its own. Collective if shared. They throw IOError.

/// Statistics of arrays in the zones of a file, as .csv.
void writeZones(Communicator* shared, const ResidentMesh& mesh, const ZoneArguments& arguments,
  const std::vector<std::string>& arrays, const std::string& output, const PathState& before);

/// The ways down from this rank's points, as .vtp.
void writeDescents(Communicator* shared, const ResidentMesh& mesh,
  const std::vector<Point3>& points, const std::string& array, const std::string& output,
  const PathState& before);

/// The ids of the cells or points in a region, as .csv or .npy.
void writeRegion(Communicator* shared, const ResidentMesh& mesh, const RegionArguments& arguments,
  const std::string& output, const PathState& before);

} // namespace tipp

#endif

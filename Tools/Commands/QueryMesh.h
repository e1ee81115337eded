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

/// Writes statistics of arrays in the zones of a file as .csv. Throws IOError.
void writeZones(const ResidentMesh& mesh, const ZoneArguments& arguments,
  const std::vector<std::string>& arrays, const std::string& output, const PathState& before);

/// Writes the ways down from points as a .vtp file. Throws IOError.
void writeDescents(const ResidentMesh& mesh, const std::vector<Point3>& points,
  const std::string& array, const std::string& output, const PathState& before);

} // namespace tipp

#endif

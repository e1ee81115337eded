// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryMeshArguments_h
#define tippQueryMeshArguments_h

#include "Files/OutputPath.h"
#include "Query/ResidentMesh.h"

#include <memory>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace tipp
{

/// The mesh of a command that asks it.
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

/// A name as a field of a .csv file.
std::string quotedField(const std::string& name);

struct ZoneArguments
{
  std::string Path;
  std::string Field; ///< that names the zones; empty: their numbers
  double Level = 0;
};

/// Writes statistics of arrays in the zones of a file as .csv. Throws IOError.
void writeZones(const ResidentMesh& mesh, const ZoneArguments& arguments,
  const std::vector<std::string>& arrays, const std::string& output, const PathState& before);

/// Writes the ways down from points as a .vtp file. Throws IOError.
void writeDescents(const ResidentMesh& mesh, const std::vector<Point3>& points,
  const std::string& array, const std::string& output, const PathState& before);

} // namespace tipp

#endif

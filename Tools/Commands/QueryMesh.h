// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryMeshArguments_h
#define tippQueryMeshArguments_h

#include "Query/ResidentMesh.h"

#include <memory>
#include <string>

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

} // namespace tipp

#endif

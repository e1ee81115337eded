// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryMesh_h
#define tippQueryMesh_h

#include "Ranks/Communicator.h"
#include "Resident/ResidentMesh.h"

#include <functional>
#include <memory>
#include <string>

namespace CLI
{
class App;
}

namespace tipp
{

/// The mesh that a command queries, and how.
struct QueryMeshArguments
{
  std::string Path;
  /// Memory limit for the pieces of a partitioned mesh, as text.
  std::string Memory = "1G";
  /// Time step of arrays that vary in time, as text.
  std::string Step;
  int Threads = 0;
};

/// Adds --step, --memory and --threads.
void addQueryMeshOptions(CLI::App& command, QueryMeshArguments& arguments);

/// Opens a partitioned mesh, or reads a VTK file of any kind. Throws IOError.
std::unique_ptr<ResidentMesh> openQueryMesh(const QueryMeshArguments& arguments);

/// Says which time step is evaluated where several are stored and none was asked for, and that
/// missing values are numbers.
void noteStep(const QueryMeshArguments& arguments, const ResidentMesh& mesh);

/// Runs a collective function on all ranks, until it returns or Ctrl-C is pressed. Prints the
/// message of any exception. Returns the command's exit code.
int runOnRanks(const std::function<void(Communicator&)>& work);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/QueryMesh.h"

#include "Commands/Commands.h"
#include "Commands/PointArguments.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Parallel/Poll.h"
#include "Query/DataSetPart.h"
#include "Ranks/Communicator.h"
#include "Vtk/ReadDataSet.h"

#include "vtkDataSet.h"

#include <CLI/CLI.hpp>

#include <malloc.h>

#include <limits>

namespace tipp
{

void addQueryMeshOptions(CLI::App& command, QueryMeshArguments& arguments)
{
  command
    .add_option(
      "--step", arguments.Step, "The time step of arrays that vary in time, counted from 0")
    ->check(CLI::Range(0, std::numeric_limits<int>::max()))
    ->capture_default_str();
  command
    .add_option("--memory", arguments.Memory, "The memory limit for pieces of a partitioned mesh")
    ->check(checkMemorySize)
    ->capture_default_str();
  addThreadsOption(command, arguments.Threads);
}

std::string quotedField(const std::string& name)
{
  if (name.find_first_of(",\"\n") == std::string::npos)
  {
    return name;
  }
  std::string text = "\"";
  for (const char c : name)
  {
    text += c == '"' ? "\"\"" : std::string(1, c);
  }
  return text + "\"";
}

std::unique_ptr<ResidentMesh> openQueryMesh(const QueryMeshArguments& arguments)
{
  ResidentOptions options;
  options.MemoryLimit = *parseMemorySize(arguments.Memory);
  options.Threads = arguments.Threads;
  options.Step = arguments.Step;
  if (isPartitionedMesh(arguments.Path))
  {
    return std::make_unique<ResidentMesh>(arguments.Path, options);
  }
  const vtkSmartPointer<vtkDataSet> data = readDataSet(arguments.Path);
  try
  {
    return std::make_unique<ResidentMesh>(partOf(data, arguments.Threads), options);
  }
  catch (const IOError&)
  {
    throw;
  }
  catch (const std::runtime_error& error)
  {
    throw IOError(arguments.Path, std::string("cannot be used: ") + error.what());
  }
}

int runOnRanks(const std::function<void(Communicator&)>& work)
{
  // With this threshold, large blocks, such as pieces, are returned to the system when they are
  // freed.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  const MpiSession session;
  try
  {
    Communicator ranks(session.controller());
    const PollScope scope(
      [&ranks]()
      {
        if (isInterrupted())
        {
          throw RankFailure(ranks.rank(), true, "The run was stopped.");
        }
        return true;
      });
    ranks.together([&] { work(ranks); });
  }
  catch (const RankFailure& failure)
  {
    return failure.Aborted ? reportInterrupt() : reportFailure();
  }
  catch (const std::exception&)
  {
    return reportFailure();
  }
  return Success;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/QueryMesh.h"

#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/SeriesReport.h"
#include "Commands/VtkFiles.h"
#include "Console/Process.h"
#include "Files/IOError.h"
#include "Files/Platform.h"
#include "Files/TextFile.h"
#include "Parallel/Poll.h"
#include "Series/StepSelection.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace tipp
{
namespace
{

int stepNumber(const std::string& text)
{
  std::int64_t step = 0;
  refuseIf(!text.empty() &&
      (!isOneStep(text) || !parseInteger(text, step) || step > std::numeric_limits<int>::max()),
    "--step", "must be a number for this mesh");
  return int(step);
}

} // namespace

void addQueryMeshOptions(CLI::App& command, QueryMeshArguments& arguments)
{
  addChecked(command, "--step", arguments.Step, checkSteps,
    "The time step of arrays that vary in time, counted from 0; for stations also all, the "
    "default for the output of a model, or FIRST:LAST:STRIDE with LAST included");
  addChecked(command, "--memory", arguments.Memory, checkMemorySize,
    "The memory limit for pieces of a partitioned mesh");
  addThreadsOption(command, arguments.Threads);
}

std::unique_ptr<ResidentMesh> openQueryMesh(const QueryMeshArguments& arguments)
{
  ResidentOptions options;
  options.MemoryLimit = *parseMemorySize(arguments.Memory);
  options.Threads = arguments.Threads;
  options.Step = stepNumber(arguments.Step);
  if (isPartitionedMesh(arguments.Path))
  {
    return std::make_unique<ResidentMesh>(arguments.Path, options);
  }
  parseSteps(arguments.Step, 0, arguments.Path); // throws for any but 0
  try
  {
    return std::make_unique<ResidentMesh>(readVtkPart(arguments.Path, arguments.Threads), options);
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

void noteStep(const QueryMeshArguments& arguments, const ResidentMesh& mesh)
{
  const std::vector<double>& times = mesh.mesh().Times;
  const std::string& units = mesh.mesh().Description.TimeUnits;
  if (times.size() > 1 && arguments.Step.empty())
  {
    fmt::print(stderr,
      "tipp: warning: {}: has {} time steps, and the values are those of the first one, at {}{}; "
      "give --step.\n",
      arguments.Path, times.size(), times.front(), units.empty() ? "" : " " + units);
  }
  const std::string step = arguments.Step.empty() ? "0" : arguments.Step;
  warnOfMissingValues(arguments.Path, mesh.mesh().Description, {},
    [&](double) { return "for values at points without it, give --step " + step + ":" + step; });
}

int runOnRanks(const std::function<void(Communicator&)>& work)
{
  returnLargeBlocks(); // such as pieces
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

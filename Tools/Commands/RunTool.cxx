// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/RunTool.h"

#include "Commands/Commands.h"
#include "Console/Process.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

// Returns one sentence about wrong usage, instead of CLI11's two lines.
std::string describeMisuse(const CLI::App* app, const CLI::Error& error)
{
  const auto chosen = app->get_subcommands();
  const std::string command = chosen.empty() ? "tipp" : "tipp " + chosen.front()->get_name();
  std::string problem = error.what();
  if (chosen.empty())
  {
    const std::vector<std::string> words = app->remaining();
    problem =
      words.empty() ? "a command is required" : "there is no command '" + words.front() + "'";
  }
  return fmt::format("{}: {}; see '{} --help'.\n", command, problem, command);
}

int run(int argc, char** argv)
{
  int exitCode = Success;
  CLI::App app("Exact 2D Delaunay triangulation of large point sets, in parallel", "tipp");
  app.set_version_flag("--version", "tipp " TIPP_VERSION);
  app.require_subcommand(1);
  app.failure_message(describeMisuse);
  app.footer("'tipp COMMAND --help' shows the options of a command, their units and examples.\n");
  for (const auto addCommand : { &addDelaunayCommand, &addDelaunay3DCommand, &addMeshCommand,
         &addDemCommand, &addDevicesCommand, &addFlattenCommand, &addInfoCommand, &addPointsCommand,
         &addResampleCommand, &addRemapCommand, &addVolumeCommand, &addPartitionCommand,
         &addQueryCommand, &addContourCommand, &addCheckCommand })
  {
    addCommand(app, exitCode);
  }
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    if (startedRank() > 0)
    {
      // All ranks have the same arguments, and only the first reports the error. The others must
      // not fail, because mpirun could end the first rank before it has printed.
      return Success;
    }
    return app.exit(error) == 0 ? Success : Usage;
  }
  return exitCode;
}

/// Throws if standard output could not be written, for example on a full disk.
void requireWrittenOutput()
{
  std::cout.flush();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout)
  {
    throw std::runtime_error(
      std::string("the standard output cannot be written (") + std::strerror(errno) + ").");
  }
}

} // namespace

int runTool(int argc, char** argv)
{
  prepareVtk();
  watchForInterrupt(startedRank());
  try
  {
    const int exitCode = run(argc, argv);
    requireWrittenOutput();
    endWatch();
    return exitCode;
  }
  catch (const std::exception&)
  {
    return reportFailure();
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCommands_h
#define tippCommands_h

namespace CLI
{
class App;
}

namespace tipp
{

/// Exit codes of all commands. Usage errors are found while the command line is parsed.
enum ExitCode
{
  Success = 0,
  Failure = 1,
  Usage = 2,
  Undecided = 3 ///< of 'tipp check'
};

/// Adds a subcommand to `app`. When the subcommand has run, `exitCode` is set. It may throw IOError
/// and std::bad_alloc.
using AddCommand = void(CLI::App& app, int& exitCode);
AddCommand addCheckCommand, addContourCommand, addDelaunayCommand, addDelaunay3DCommand,
  addDemCommand, addDevicesCommand, addFlattenCommand, addInfoCommand, addPartitionCommand,
  addPointsCommand, addQueryCommand, addResampleCommand;

} // namespace tipp

#endif

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
  Usage = 2
};

/// Each function adds a subcommand to `app`. When the subcommand has run, `exitCode` is set. It may
/// throw IOError and std::bad_alloc.
void addCheckCommand(CLI::App& app, int& exitCode);
void addContourCommand(CLI::App& app, int& exitCode);
void addDelaunayCommand(CLI::App& app, int& exitCode);
void addDelaunay3DCommand(CLI::App& app, int& exitCode);
void addDemCommand(CLI::App& app, int& exitCode);
void addDevicesCommand(CLI::App& app, int& exitCode);
void addFlattenCommand(CLI::App& app, int& exitCode);
void addInfoCommand(CLI::App& app, int& exitCode);
void addPartitionCommand(CLI::App& app, int& exitCode);
void addPointsCommand(CLI::App& app, int& exitCode);
void addQueryCommand(CLI::App& app, int& exitCode);
void addResampleCommand(CLI::App& app, int& exitCode);

} // namespace tipp

#endif

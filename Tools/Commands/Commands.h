// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCommands_h
#define tippCommands_h

namespace CLI
{
class App;
}

namespace tipp
{

/// Adds a subcommand to `app`. When the subcommand has run, `exitCode` is set. It may throw IOError
/// and std::bad_alloc.
using AddCommand = void(CLI::App& app, int& exitCode);
AddCommand addCheckCommand, addContourCommand, addDelaunayCommand, addDelaunay3DCommand,
  addDemCommand, addDevicesCommand, addFlattenCommand, addInfoCommand, addMeshCommand,
  addPartitionCommand, addPointsCommand, addQueryCommand, addRemapCommand, addResampleCommand,
  addVolumeCommand;

} // namespace tipp

#endif

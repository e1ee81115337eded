// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQuerySeries_h
#define tippQuerySeries_h

#include "Points/ReadPoints.h"

#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The options of 'tipp query' for values at stations through time.
struct StationArguments
{
  std::string Points;
  std::string Mesh;
  std::string Output;
  std::vector<std::string> Arrays; ///< empty: those that vary
  std::vector<std::string> Values; ///< more files with values at the mesh's nodes or cells
  std::string Step;                ///< see parseSteps(); empty: all
  std::optional<double> NoData;    ///< a value that counts as none
  PointOptions Reading;            ///< with Wrap, the mesh's cells are unwrapped, too
  int Threads = 0;
};

/// Whether 'tipp query' of this mesh and these steps is one through time.
bool isStationRun(const StationArguments& arguments);

/// Writes the values at stations through time. Returns the exit code. Throws IOError.
int runStations(const StationArguments& arguments);

} // namespace tipp

#endif

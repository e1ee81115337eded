// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDemRuns_h
#define tippDemRuns_h

#include "Commands/PointArguments.h"
#include "Dem/MakeDem.h"

#include <string>
#include <vector>

namespace tipp
{

/// The options of `tipp dem`.
struct DemArguments : RunArguments
{
  const CLI::App* Command = nullptr; ///< tells which options are given
  DemRequest Request;
  std::vector<double> Bounds;
  std::string Like;
  bool StrictCrs = false; ///< whether a reference system that is not understood is an error
  double NoData = -9999;
  std::string Type = "float32";
  std::string Compression = "deflate";
  bool CloudOptimized = false;
  std::string Breaklines; ///< path of a file; empty: none
  bool Soft = false;      ///< the heights of Breaklines are not used
  std::string Boundary;   ///< path of a file; empty: none

  /// Returns the file of constraints that messages name.
  std::string constraintFile() const
  {
    return this->Breaklines.empty() ? this->Boundary : this->Breaklines;
  }
};

/// Runs `tipp dem` in memory, or with a memory limit, on the ranks that mpirun started. Returns the
/// exit code, which is the same on all ranks.
int runDem(const DemArguments& arguments);

} // namespace tipp

#endif

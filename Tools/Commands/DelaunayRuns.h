// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayRuns_h
#define tippDelaunayRuns_h

#include "Commands/PointArguments.h"
#include "Constraints/TriangulateConstrained.h"
#include "Distributed/DistributedTriangulation.h"
#include "Triangulation/ResolveDuplicates.h"

#include <string>

namespace tipp
{

/// The options of `tipp delaunay`.
struct DelaunayArguments : RunArguments
{
  int Threads = 0;
  std::string Partitions = "auto";
  GridSize Grid;              ///< parsed from Partitions
  DistributedOptions OnRanks; ///< made from the other options
  std::string Order = "dynamic";
  std::string Masters = "auto";
  std::string Major = "auto";
  std::string Minor = "auto";
  std::string Groups = "proportional";
  int InitialPoints = 0;
  double MaximumEdge = 0; ///< 0: not given
  bool MapDuplicates = false;
  DuplicateRule Duplicates = DuplicateRule::First;
  bool Neighbors = false;
  ConstraintFiles Constraints;
  bool MarkConstraints = false;
  std::string Sink = "mesh"; ///< of a run out of core

  /// Returns whether an option is given that needs the code for several ranks, even if there is
  /// one.
  bool isForRanks() const
  {
    return this->Masters != "auto" || this->Major != "auto" || this->Minor != "auto";
  }
};

/// Runs `tipp delaunay` in memory, on the ranks that mpirun started, or out of core. Returns the
/// exit code, which is the same on all ranks.
int runDelaunay(const DelaunayArguments& arguments);

} // namespace tipp

#endif

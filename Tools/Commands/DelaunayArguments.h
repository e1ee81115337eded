// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDelaunayArguments_h
#define tippDelaunayArguments_h

#include "Distributed/DistributedOptions.h"
#include "Duplicates/ResolveDuplicates.h"
#include "Points/ReadPoints.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// The options of `tipp delaunay`.
struct DelaunayArguments
{
  std::vector<std::string> Inputs;
  std::string Input; ///< the first
  std::string Output;
  PointOptions Columns;
  int Threads = 0;
  std::string Partitions = "auto";
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
  std::string Constraints; ///< a file; empty: none
  std::string Boundary;    ///< the same
  bool RefuseCrossings = false;
  std::vector<std::pair<double, double>> Holes; ///< x and y of points in holes
  std::string Statistics;
  // Of a run out of core:
  std::string Memory; ///< empty: not given
  std::string Sink = "mesh";
  bool Resume = false;
  std::string Scratch;

  /// Whether an option is given that only a run on ranks has; a single rank can run it, too.
  bool isForRanks() const
  {
    return this->Masters != "auto" || this->Major != "auto" || this->Minor != "auto";
  }
};

/// Parses "auto" (no columns and rows) or a grid; nullopt for any other text.
std::optional<GridSize> parseGrid(const std::string& text);

struct MinorChoice
{
  Division Kind = Division::Tree;
  GridSize Grid;
  std::int64_t Threshold = 0;
};
std::optional<MinorChoice> parseMinor(const std::string& text);

DistributedOptions makeDistributedOptions(const DelaunayArguments& arguments);

} // namespace tipp

#endif

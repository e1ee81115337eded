// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAdcircBoundaries_h
#define tippAdcircBoundaries_h

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// The boundaries of a new grid for ADCIRC or SCHISM, as lists of node indices from 0. The mesh is
/// on the left of each list: lists run counter-clockwise along outer borders, and clockwise around
/// islands (https://adcirc.org/home/documentation/users-manual-v53, NBDV and NBVV).
struct AdcircBoundaries
{
  /// A boundary with or without flow.
  struct LandBoundary
  {
    std::int64_t Kind; ///< IBTYPE, such as 20 for mainland and 21 for islands
    /// The first node is repeated at the end if a mainland is closed; it is not repeated for
    /// islands, which are closed without.
    std::vector<std::int64_t> Nodes;
  };

  std::vector<std::vector<std::int64_t>> Open; ///< boundaries with given water levels
  std::vector<LandBoundary> Land;
};

/// The lines that follow the elements in a fort.14 or .gr3 file. `numberOf` returns the number of a
/// node in the file.
std::string boundaryLines(const AdcircBoundaries& boundaries,
  const std::function<std::int64_t(std::int64_t node)>& numberOf);

} // namespace tipp

#endif

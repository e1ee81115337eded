// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSplitStored_h
#define tippSplitStored_h

#include "Constraints/OnDisk/StoredConstraints.h"
#include "Constraints/ResolveCrossings.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// The result of splitting constraints on disk where they cross.
struct SplitConstraints
{
  /// A part of a constraint.
  struct Part
  {
    std::int64_t Number; ///< number of the constraint
    Point2 A;
    Point2 B;
  };
  std::vector<Part> Parts;                 ///< of split constraints, by number, then along them
  std::vector<Point2> Crossings;           ///< the new points
  std::vector<std::vector<double>> Values; ///< per column, a value for each of these
  int Rounds = 0;                          ///< of splitting
};

/// Splits constraints where they cross, with the result of resolveCrossings() for all of them.
/// Finds the constraints that cross others, tile by tile. Only these, and constraints so near that
/// rounding may matter, are then passed to resolveCrossings(). Omits constraints with an end that
/// is not finite, or with equal ends. Throws as resolveCrossings() does.
SplitConstraints splitStored(const StoredConstraints& constraints, CrossingRule rule,
  std::size_t columns, const DiskWork& work);

} // namespace tipp

#endif

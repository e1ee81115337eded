// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSplitStored_h
#define tippSplitStored_h

#include "Constraints/ResolveCrossings.h"
#include "Constraints/StoredConstraints.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Constraints on disk that are split where they cross.
struct SplitConstraints
{
  /// A part of a constraint.
  struct Part
  {
    std::int64_t Number; ///< of the constraint
    Point2 A;
    Point2 B;
  };
  std::vector<Part> Parts;                 ///< of those that are split, in their order
  std::vector<Point2> Crossings;           ///< the new points
  std::vector<std::vector<double>> Values; ///< of each column, at these
  int Rounds = 0;                          ///< of splitting
};

/// What resolveCrossings() would do with all of them: by tiles, those that cross others are found;
/// it then gets these and all that come so near to them that rounding may matter. Constraints whose
/// ends are not finite, or are one, are left out. Throws as it does.
SplitConstraints splitStored(const StoredConstraints& constraints, CrossingRule rule,
  std::size_t columns, const DiskWork& work);

} // namespace tipp

#endif

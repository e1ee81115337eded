// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUncoveredSegments_h
#define tippUncoveredSegments_h

#include "Constraints/ConstraintSegments.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// The segments of a source without the parts of lines that lie on other segments. These parts are
/// edges anyway, and many overlapping segments would need much memory, because each of them is
/// split at all points on it.
class VTKTIPPFILTERS_EXPORT UncoveredSegments
{
public:
  /// Paths of temporary files begin with `file`. `memory`: in bytes; about an eighth of it is used.
  /// The source must outlive this object. Throws IOError.
  UncoveredSegments(
    const std::string& file, SegmentSource& segments, std::uint64_t memory, int threads);

  void forEach(const VisitSegment& visit) const;

private:
  SegmentSource& All;
  /// The index of a segment, and the end of the part that others cover; ascending.
  std::vector<std::pair<std::int64_t, Point2>> Covered;
};

} // namespace tipp

#endif

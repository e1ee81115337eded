// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUncoveredSegments_h
#define tippUncoveredSegments_h

#include "Constraints/ConstraintSegments.h"
#include "Constraints/OnDisk/ConstrainedStream.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <string>

namespace tipp
{

/// Visits the segments of a stream without the parts of lines that lie on other segments. These
/// parts are edges anyway, and many overlapping segments would need much memory, because each of
/// them is split at all points on it. Paths of temporary files begin with `file`. `memory`: in
/// bytes; about an eighth of it is used. Throws IOError.
VTKTIPPFILTERS_EXPORT void visitUncovered(const std::string& file,
  const ConstrainedStream& segments, std::uint64_t memory, int threads, const VisitSegment& visit);

} // namespace tipp

#endif

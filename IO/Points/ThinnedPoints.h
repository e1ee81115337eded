// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippThinnedPoints_h
#define tippThinnedPoints_h

#include "Points/PointStream.h"
#include "Points/Thinning.h"

#include <memory>

namespace tipp
{

/// The points of a stream that thinning keeps, in their order. Of equally good points the first one
/// is kept, and all points that are not finite are. The first pass reads the stream twice. Takes
/// one bit a point, besides the squares. Throws IOError if there is no elevation and the rule needs
/// one.
std::unique_ptr<PointStream> thinPoints(
  std::unique_ptr<PointStream> points, const Thinning& thinning);

} // namespace tipp

#endif

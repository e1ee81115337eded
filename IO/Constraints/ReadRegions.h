// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadRegions_h
#define tippReadRegions_h

#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// A point in a region of a domain, and the largest area of triangles there.
struct RegionLimit
{
  Point2 Seed;
  double LargestArea; ///< above 0, in the square of the coordinates' unit; infinity: no limit
};

/// Reads regions, in the file's order. A .poly file of Triangle lists them after the holes: x, y,
/// an attribute, which is ignored, and the largest area; as in Triangle, the attribute is the area
/// if there is no other number, and an area that is not above 0 is no limit. Other files have
/// points (PointStream) with a column `area`, or `size`: the side of the equilateral triangle that
/// is allowed. Throws IOError, also if there is no region, or if an area or size of points is not
/// above 0.
VTKTIPPIO_EXPORT std::vector<RegionLimit> readRegions(const std::string& path);

} // namespace tipp

#endif

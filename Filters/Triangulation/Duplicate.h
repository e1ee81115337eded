// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDuplicate_h
#define tippDuplicate_h

#include <cstdint>

namespace tipp
{

/// A point's id: an index into the input points, or a global id of the caller, as stated at each
/// use.
using PointId = std::int64_t;

/// A point that coincides with another one, its representative. Both are input point ids.
struct Duplicate
{
  PointId Point;          ///< id of the duplicate
  PointId Representative; ///< the lowest id with the same coordinates

  bool operator<(const Duplicate& other) const { return this->Point < other.Point; }
};

} // namespace tipp

#endif

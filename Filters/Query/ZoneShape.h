// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippZoneShape_h
#define tippZoneShape_h

#include "Gis/GisFiles.h"
#include "Locate/BoxTree.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace tipp
{

/// A zone prepared for many queries. Whether rings touch, or lie on, edges and corners is decided
/// exactly. Thread-safe.
class VTKTIPPFILTERS_EXPORT ZoneShape
{
public:
  /// Rings may have any orientation; IsHole tells holes from outer rings. `number` is the zone's
  /// index, for messages. Throws IOError if a corner is not finite, or if edges cross.
  ZoneShape(const Zone& zone, std::size_t number);

  const Box2& bounds() const { return this->Bounds; }

  /// Whether the point is inside the zone or on its border.
  bool holds(Point2 point) const;

  enum class Relation
  {
    Apart,   ///< no point in common
    Touches, ///< only border points in common
    Cut,     ///< a part of the triangle is inside
    Inside   ///< the whole triangle is inside
  };
  Relation relationTo(const Point2 (&triangle)[3]) const;

  /// Integrals of linear fields over the parts of triangles in a zone.
  struct Integral
  {
    double Area = 0;
    double Sum = 0; ///< integral of the field
    double Low = std::numeric_limits<double>::infinity();
    double High = -std::numeric_limits<double>::infinity();
    bool IsMet = false; ///< whether any triangle has an area in the zone
  };
  /// Adds the part of a triangle that is in the zone. The field is linear, with these values at the
  /// corners. Triangles without area are ignored. The error is a few roundings of the triangle's
  /// own integral, and does not depend on the order of its corners.
  void integrate(const Point2 (&triangle)[3], const double (&values)[3], Integral& integral) const;

private:
  struct Edge
  {
    Point2 From; ///< the zone is on the left
    Point2 To;
  };

  void addRing(const ZoneRing& ring);
  void refuseCrossings(std::size_t number) const;
  int windingBeside(Point2 a, Point2 b) const;
  template <typename Visit>
  void visitNear(const Box2& box, const Visit& visit) const;

  class CutTriangle;

  std::vector<Edge> Edges;
  Box2 Bounds = Box2::empty();
  BoxTree<2> Tree;
};

} // namespace tipp

#endif

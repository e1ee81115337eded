// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippZoneShape_h
#define tippZoneShape_h

#include "Locate/BoxTree.h"
#include "Predicates/Points.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tipp
{

/// A closed line of x and y; the last corner is joined to the first one, or equals it.
struct ZoneRing
{
  std::vector<Point2> Corners;
  bool IsHole = false;
};

template <typename Archive>
void serialize(Archive& archive, ZoneRing& ring)
{
  archive(ring.Corners, ring.IsHole);
}

/// One or several polygons with holes.
using Zone = std::vector<ZoneRing>;

/// A zone prepared for many questions. Where rings lie on, or touch, edges and corners is decided
/// exactly. Several threads may use it.
class VTKTIPPIO_EXPORT ZoneShape
{
public:
  /// Outer rings may turn either way, and holes, too. `number` is the zone's, for errors. Throws
  /// IOError if a corner is not finite, or if edges cross.
  ZoneShape(const Zone& zone, std::size_t number);

  const Box<2>& bounds() const { return this->Bounds; }

  /// Whether the zone, with its border, has a point.
  bool holds(Point2 point) const;

  enum class Relation
  {
    Apart,   ///< they have no point in common
    Touches, ///< only points of their borders
    Cut,     ///< a part of the triangle, but not all
    Inside   ///< all of the triangle
  };
  Relation relationTo(const Point2 (&triangle)[3]) const;

  /// What a zone has of linear fields on triangles.
  struct Integral
  {
    double Area = 0;
    double Sum = 0; ///< the field's integral
    double Low = std::numeric_limits<double>::infinity();
    double High = -std::numeric_limits<double>::infinity();
    bool IsMet = false; ///< whether the zone has an area of a triangle
  };
  /// Adds the part of a triangle in the zone, whose field is linear from the corners' values.
  /// Triangles without an area have none. Accurate to roundings of the triangle's own area, without
  /// regard to the order of its corners.
  void integrate(const Point2 (&triangle)[3], const double (&values)[3], Integral& integral) const;

private:
  struct Edge
  {
    Point2 From; ///< with the zone on its left
    Point2 To;
  };

  void addRing(const ZoneRing& ring);
  void refuseCrossings(std::size_t number) const;
  int windingBeside(Point2 a, Point2 b) const;
  template <typename Visit>
  void visitNear(const Box<2>& box, const Visit& visit) const;

  class CutTriangle;

  std::vector<Edge> Edges;
  Box<2> Bounds = Box<2>::empty();
  BoxTree<2> Tree;
};

} // namespace tipp

#endif

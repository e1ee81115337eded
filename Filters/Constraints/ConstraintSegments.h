// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintSegments_h
#define tippConstraintSegments_h

#include "Constraints/SegmentTree.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// The kind of line that a segment belongs to.
enum class SegmentRole : std::int64_t
{
  Line,
  Polygon,  ///< see Cuts::Polygons
  Boundary, ///< see Cuts::Boundary
  Hole      ///< not a constraint: triangles inside an odd number of such loops are removed
};

/// A segment that must be an edge of the triangulation, or a chain of edges. Its ends are vertices,
/// identified by their coordinates.
struct ConstraintSegment
{
  Point2 A;
  Point2 B;
  SegmentRole Role;
};

using VisitSegment = std::function<void(const ConstraintSegment&)>;

/// All segments that constrain a triangulation whose points and triangles are distributed. Segments
/// cross only at common ends.
class VTKTIPPFILTERS_EXPORT ConstraintSegments
{
public:
  /// If `indices` is not null, it gets the index in `segments` of each item of the tree.
  explicit ConstraintSegments(
    const std::vector<ConstraintSegment>& segments, std::vector<std::int64_t>* indices = nullptr);

  /// A subset of the segments, without roles, so that it does not remove triangles. `names` has the
  /// index of each among all segments.
  ConstraintSegments(
    const std::vector<ConstraintSegment>& segments, const std::vector<std::int64_t>& names);

  /// All segments, in the order of the trees.
  std::vector<ConstraintSegment> list() const;

  /// A tree of the constraints. An item's Id is its index among the items.
  const SegmentTree& tree() const { return this->All; }
  const SegmentTree::Item& at(std::int64_t segment) const
  {
    return this->All.items()[std::size_t(segment)];
  }
  /// The index of an item among all segments; if this has all segments, the item's own index.
  std::int64_t nameOf(std::int64_t segment) const
  {
    return this->Names.empty() ? segment : this->Names[std::size_t(segment)];
  }

  /// Whether there are polygons, a boundary or holes, so that triangles may be removed.
  bool cuts() const { return this->HasPolygons || this->HasBoundary || this->Holes.groups() > 0; }

  /// Whether no edge of a polygon, boundary or hole can meet the box. Then either all triangles in
  /// the box are kept or none.
  bool isUncut(const Box2& box) const;

  /// Whether polygons, boundary and holes keep a triangle. It must be counter-clockwise and cross
  /// none of their edges. Exact.
  bool keeps(const std::array<Point2, 3>& triangle) const;

private:
  SegmentRole roleOf(const SegmentTree::Item& item) const
  {
    return static_cast<SegmentRole>(this->Roles[std::size_t(item.Id)]);
  }
  bool has(SegmentRole role) const;
  bool haveInside() const;

  SegmentTree All;
  SegmentTree Holes;
  std::vector<std::uint8_t> Roles; ///< per item of All
  std::vector<std::int64_t> Names; ///< index of each item among all segments; empty if this has all
  bool HasPolygons = false;
  bool HasBoundary = false;
  bool OnlyHoles = false; ///< polygons have no positive winding number anywhere, so all are holes
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintSegments_h
#define tippConstraintSegments_h

#include "Constraints/SegmentTree.h"
#include "Predicates/Points.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tipp
{

/// What a segment is an edge of.
enum class SegmentRole : std::int64_t
{
  Line,
  Polygon,  ///< see Cuts::Polygons
  Boundary, ///< see Cuts::Boundary
  Hole      ///< no constraint: an odd number of these goes round triangles that are removed
};

/// A segment that has to be an edge of the triangulation, or a chain of edges. Its ends are
/// vertices, known by their coordinates.
struct ConstraintSegment
{
  Point2 A;
  Point2 B;
  SegmentRole Role;
};

using VisitSegment = std::function<void(const ConstraintSegment&)>;

/// Gives the segments that constrain a triangulation out of core, none crossing another, after the
/// first pass over its points. They need not fit in memory. All methods throw IOError.
class SegmentSource
{
public:
  virtual ~SegmentSource() = default;

  /// Before the first pass. The paths of temporary files begin with `files`; `memory` is what the
  /// run may take, in bytes.
  virtual void begin(const std::string& files, std::uint64_t memory) = 0;

  /// @name After the first pass
  ///@{
  virtual std::int64_t count() const = 0;
  /// Visits all segments, in an order that is always the same.
  virtual void forEach(const VisitSegment& visit) = 0;
  /// Frees what only the segments need.
  virtual void end() = 0;
  ///@}
};

/// All segments that constrain a triangulation of which no process may hold all points or
/// triangles. None crosses another, except at ends.
class VTKTIPPFILTERS_EXPORT ConstraintSegments
{
public:
  /// `indices` gets, for each item of the tree, its index in `segments`.
  explicit ConstraintSegments(
    const std::vector<ConstraintSegment>& segments, std::vector<std::int64_t>* indices = nullptr);

  /// Some of all segments, without their roles: they cut nothing. `names` has for each its number
  /// among all.
  ConstraintSegments(const std::vector<ConstraintSegment>& segments,
    const std::vector<std::int64_t>& names, std::vector<std::int64_t>* indices = nullptr);

  /// All segments again, in the order of the trees.
  std::vector<ConstraintSegment> list() const;

  /// The constraints by where they lie. An item's Id is its index among the items.
  const SegmentTree& tree() const { return this->All; }
  const SegmentTree::Item& at(std::int64_t segment) const
  {
    return this->All.items()[std::size_t(segment)];
  }
  /// An item's number among all segments: its index, if these are all.
  std::int64_t nameOf(std::int64_t segment) const
  {
    return this->Names.empty() ? segment : this->Names[std::size_t(segment)];
  }

  /// Whether polygons, a boundary or holes tell which triangles are kept.
  bool cuts() const { return this->HasPolygons || this->HasBoundary || this->Holes.groups() > 0; }

  /// Whether no edge of a polygon, boundary or hole may meet the box: then all triangles in it are
  /// kept, or none is.
  bool isUncut(const Box2& box) const;

  /// Whether polygons, boundary and holes keep the triangle, which is counter-clockwise and crosses
  /// no edge of theirs. Exact.
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
  std::vector<std::uint8_t> Roles; ///< of the items of All
  std::vector<std::int64_t> Names; ///< of these; empty: their indices
  bool HasPolygons = false;
  bool HasBoundary = false;
  bool OnlyHoles = false; ///< no polygon goes round anything counter-clockwise
};

} // namespace tipp

#endif

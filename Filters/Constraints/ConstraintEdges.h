// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintEdges_h
#define tippConstraintEdges_h

#include "Triangulation/Duplicate.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// A line between two points (point ids) that must be an edge of the triangulation, or a chain of
/// edges.
struct Constraint
{
  PointId A;
  PointId B;
};

/// A segment: a part of a constraint between two points (point ids), directed like the constraint.
/// Where points have no common ids, a ConstraintSegment has their positions.
struct IdSegment
{
  PointId A;
  PointId B;
  std::int64_t Constraint; ///< index of the constraint
};

/// Returns the segments of constraints [begin, end).
VTKTIPPFILTERS_EXPORT std::vector<IdSegment> segmentsOf(
  const std::vector<IdSegment>& segments, std::size_t begin, std::size_t end);

/// A set of constraint edges to be found by their ends.
class VTKTIPPFILTERS_EXPORT ConstraintEdges
{
public:
  explicit ConstraintEdges(const std::vector<IdSegment>& segments);

  bool contains(PointId a, PointId b) const { return this->count(a, b) > 0; }

  /// The number of constraints from a to b minus the number from b to a.
  int balance(PointId a, PointId b) const;

  /// The number of constraints between a and b.
  int count(PointId a, PointId b) const;

private:
  using Ends = std::pair<PointId, PointId>; ///< the lower id first
  struct Edge
  {
    Ends Ids;
    int Direction; ///< 1 from the lower id to the higher, -1 for the opposite
  };

  using Iterator = std::vector<Edge>::const_iterator;
  std::pair<Iterator, Iterator> between(PointId a, PointId b) const;

  std::vector<Edge> Edges;   ///< sorted by ends
  std::vector<char> IsLower; ///< by low bits of ids: whether one is a lower end
};

} // namespace tipp

#endif

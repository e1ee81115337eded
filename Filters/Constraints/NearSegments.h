// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearSegments_h
#define tippNearSegments_h

#include "Constraints/SegmentTree.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/PointsView.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace tipp
{

/// Finds the segments that pass through a point or near it. A long segment is stored as parts with
/// small bounding boxes, so that a point is compared with few segments.
class VTKTIPPFILTERS_EXPORT NearSegments
{
public:
  /// Segments nearer to a point than `margin` are near it. Their ends must be finite.
  explicit NearSegments(std::vector<SegmentTree::Item> segments, int threads, double margin = 0);

  const std::vector<SegmentTree::Item>& segments() const { return this->Segments; }

  /// Calls visit(index) for each segment that has the point exactly on it, or as an end. May visit
  /// a segment several times.
  template <typename Visit>
  void visitOn(Point2 p, const Visit& visit) const
  {
    this->visitParts(p,
      [&](std::size_t i)
      {
        const SegmentTree::Item& segment = this->Segments[i];
        if (segment.box().contains(p) && orientation(segment.A, segment.B, p) == 0)
        {
          visit(i);
        }
        return true;
      });
  }

  /// Whether a segment is near the point. May also be true if one is a little farther away.
  bool isNear(Point2 p) const
  {
    bool isNear = false;
    const Box2 box = expanded(Box2::of(p), this->Margin);
    this->visitParts(p,
      [&](std::size_t i)
      {
        const SegmentTree::Item& segment = this->Segments[i];
        isNear = box.meets(segment.box()) && lineMayMeet(segment.A, segment.B, box);
        return !isNear;
      });
    return isNear;
  }

private:
  template <typename Visit>
  void visitParts(Point2 p, const Visit& visit) const
  {
    this->Parts.visitNear(expanded(Box2::of(p), this->Slack),
      [&visit](const SegmentTree::Item& part) { return visit(std::size_t(part.Id)); });
  }

  std::vector<SegmentTree::Item> Segments;
  double Margin;
  double Slack;      ///< Margin, and how far rounding may move the ends of parts
  SegmentTree Parts; ///< Id: the index of the segment
};

/// Returns the index of a segment and of a point for each point that lies exactly on a segment,
/// between its ends; unsorted, perhaps repeated. The segments' ends must be finite.
std::vector<std::pair<std::size_t, std::size_t>> findPointsOn(
  std::vector<SegmentTree::Item> segments, PointsView points, int threads);

} // namespace tipp

#endif

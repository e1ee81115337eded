// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCrossedTriangles_h
#define tippCrossedTriangles_h

#include "Constraints/SegmentTree.h"
#include "Kernel/Pairs.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/Duplicate.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace tipp
{

/// The triangles that segments of constraints cross, and the vertices on segments.
struct CrossedTriangles
{
  /// A triangle whose interior a segment meets.
  struct Crossing
  {
    std::int64_t Triangle;
    std::int64_t Segment;

    bool operator<(const Crossing& other) const
    {
      return std::tie(this->Triangle, this->Segment) < std::tie(other.Triangle, other.Segment);
    }
    bool operator==(const Crossing& other) const
    {
      return this->Triangle == other.Triangle && this->Segment == other.Segment;
    }
  };
  /// A vertex in the interior of a segment.
  struct Touch
  {
    std::int64_t Segment;
    PointId Vertex;

    bool operator<(const Touch& other) const
    {
      return std::tie(this->Segment, this->Vertex) < std::tie(other.Segment, other.Vertex);
    }
    bool operator==(const Touch& other) const
    {
      return this->Segment == other.Segment && this->Vertex == other.Vertex;
    }
  };

  std::vector<std::int64_t> Triangles; ///< crossed triangles, ascending
  std::vector<std::int64_t> Starts;    ///< start of each triangle's range in Segments, and the end
  std::vector<std::int64_t> Segments;
  std::vector<Touch> Touches; ///< sorted by segment and vertex, without repetition

  /// The segments that cross a triangle are in [begin(t), begin(t + 1)), where t is its index in
  /// Triangles.
  const std::int64_t* begin(std::int64_t triangle) const
  {
    return this->Segments.data() + this->Starts[std::size_t(triangle)];
  }
};

/// The results of a scan.
struct ScannedTriangles
{
  /// An edge of a triangle that is on a segment.
  struct Edge
  {
    std::int64_t Triangle;
    std::size_t From;     ///< the corner where the edge starts, 0 to 2
    std::int64_t Segment; ///< Id of the segment
  };
  std::vector<CrossedTriangles::Crossing> Crossings;
  std::vector<CrossedTriangles::Touch> Touches;
  std::vector<Edge> Edges; ///< of crossed triangles, or of all triangles
};

/// A raster over some triangles, whose cells list the segments near them.
class SegmentRaster
{
public:
  void fill(const Box2& box, const std::vector<const SegmentTree::Item*>& segments)
  {
    this->X = Axis(box.Min.x, box.Max.x);
    this->Y = Axis(box.Min.y, box.Max.y);
    this->Near.clear();
    for (std::size_t s = 0; s < segments.size(); ++s)
    {
      const SegmentTree::Item& segment = *segments[s];
      const Box2 bounds = segment.box();
      const int xEnd = this->X.cellOf(bounds.Max.x);
      const int yEnd = this->Y.cellOf(bounds.Max.y);
      for (int y = this->Y.cellOf(bounds.Min.y); y <= yEnd; ++y)
      {
        for (int x = this->X.cellOf(bounds.Min.x); x <= xEnd; ++x)
        {
          const Box2 cell{ { this->X.begin(x), this->Y.begin(y) },
            { this->X.end(x), this->Y.end(y) } };
          if (lineMayMeet(segment.A, segment.B, cell))
          {
            this->Near.push_back({ y * Cells + x, std::int32_t(s) });
          }
        }
      }
    }
    // Counting sort by cell.
    this->Starts.fill(0);
    this->Used.fill(0);
    for (const auto& entry : this->Near)
    {
      ++this->Starts[std::size_t(entry.Cell) + 1];
      this->Used[std::size_t(entry.Cell / Cells)] |= 1U << (entry.Cell % Cells);
    }
    std::partial_sum(this->Starts.begin(), this->Starts.end(), this->Starts.begin());
    this->Sorted.resize(this->Near.size());
    auto next = this->Starts;
    for (const auto& entry : this->Near)
    {
      this->Sorted[std::size_t(next[std::size_t(entry.Cell)]++)] = entry.Segment;
    }
  }

  /// Calls visit(segment) for all segments near a box. A segment may be visited several times.
  template <typename Visit>
  void visitNear(const Box2& box, const Visit& visit) const
  {
    const int xBegin = this->X.cellOf(box.Min.x);
    const int xEnd = this->X.cellOf(box.Max.x);
    const std::uint32_t columns = (~0U << xBegin) & (~0U >> (Cells - 1 - xEnd));
    const int yEnd = this->Y.cellOf(box.Max.y);
    for (int y = this->Y.cellOf(box.Min.y); y <= yEnd; ++y)
    {
      if ((this->Used[std::size_t(y)] & columns) == 0)
      {
        continue; // most triangles have no segment nearby
      }
      const auto* const starts = &this->Starts[std::size_t(y) * Cells];
      for (auto i = starts[xBegin]; i < starts[xEnd + 1]; ++i)
      {
        visit(std::size_t(this->Sorted[std::size_t(i)]));
      }
    }
  }

private:
  static constexpr int Cells = 32; ///< cells per axis; also the bits of a row of Used

  struct CellSegment
  {
    std::int32_t Cell;
    std::int32_t Segment;
  };

  /// The cells along an axis. If cells would be too small or too large for doubles, only the first
  /// one is used.
  struct Axis
  {
    Axis() = default;
    Axis(double low, double high)
      : Low(low)
      , High(high)
    {
      const double length = high - low;
      constexpr double shortest = 1e-280;
      if (length > shortest && std::isfinite(length))
      {
        this->Step = length / Cells;
        this->Scale = Cells / length;
        constexpr double part = 0.01;
        constexpr double relative = 1e-15;
        this->Margin = part * this->Step + relative * std::max(std::fabs(low), std::fabs(high));
      }
    }

    /// The cell of a coordinate; never decreases with it.
    int cellOf(double value) const
    {
      const double cell = (value - this->Low) * this->Scale;
      return cell > 0 ? int(std::min(cell, double(Cells - 1))) : 0;
    }
    ///@{
    /// Bounds of a cell, with a margin for rounding.
    double begin(int cell) const
    {
      return this->Scale > 0 ? this->Low + cell * this->Step - this->Margin : this->Low;
    }
    double end(int cell) const
    {
      return this->Scale > 0 ? this->Low + (cell + 1) * this->Step + this->Margin : this->High;
    }
    ///@}

    double Low = 0;
    double High = 0;
    double Step = 0;
    double Scale = 0;
    double Margin = 0;
  };

  Axis X;
  Axis Y;
  std::vector<CellSegment> Near;
  std::array<std::int32_t, std::size_t(Cells) * Cells + 1> Starts{};
  std::array<std::uint32_t, Cells> Used{}; ///< per row: a bit for each cell with segments nearby
  std::vector<std::int32_t> Sorted;
};

/// Finds the triangles that segments cross, a few triangles at a time. The ends of segments are
/// vertices, identified by their coordinates.
template <typename Id>
class TriangleScan
{
public:
  static constexpr std::size_t MostTriangles = 2048;

  /// Which edges on segments are recorded.
  enum class NotedEdges
  {
    OfCrossed,
    OfAll
  };

  TriangleScan(PointsView points, const SegmentTree& tree, NotedEdges noted = NotedEdges::OfCrossed)
    : Points(points)
    , Tree(tree)
    , Noted(noted)
  {
  }

  /// Scans the triangles [begin, end), at most MostTriangles.
  void scan(const Id* corners, std::size_t begin, std::size_t end, ScannedTriangles& found)
  {
    const Box2 box = this->load(corners, begin, end);
    this->Segments.clear();
    this->Tree.visitNear(box,
      [&](const SegmentTree::Item& item)
      {
        if (lineMayMeet(item.A, item.B, box))
        {
          this->Segments.push_back(&item);
        }
        return true;
      });
    if (this->Segments.empty())
    {
      return;
    }
    this->Raster.fill(box, this->Segments);
    this->LastTriangle.assign(this->Segments.size(), end);
    for (std::size_t t = begin; t < end; ++t)
    {
      this->scanTriangle(t, corners + 3 * t, &this->Positions[3 * (t - begin)], found);
    }
  }

private:
  Box2 load(const Id* corners, std::size_t begin, std::size_t end)
  {
    // Points are anywhere in memory: loads that do not depend on each other are done at the same
    // time.
    this->Positions.resize(3 * (end - begin));
    std::transform(corners + 3 * begin, corners + 3 * end, this->Positions.begin(),
      [this](Id id) { return this->Points[std::size_t(id)]; });
    return extentOf(this->Positions.data(), this->Positions.size()).Bounds;
  }

  void scanTriangle(std::size_t t, const Id* ids, const Point2* p, ScannedTriangles& found)
  {
    const Pair a = pairAt(&p[0].x);
    const Pair b = pairAt(&p[1].x);
    const Pair c = pairAt(&p[2].x);
    const Pair low = lower(lower(a, b), c);
    const Pair high = higher(higher(a, b), c);
    const Box2 box{ { low[0], low[1] }, { high[0], high[1] } };
    const std::size_t edgesBefore = found.Edges.size();
    bool isCrossed = false;
    this->Raster.visitNear(box,
      [&](std::size_t s)
      {
        const SegmentTree::Item& segment = *this->Segments[s];
        if (this->LastTriangle[s] != t && box.meets(segment.box()))
        {
          this->LastTriangle[s] = t;
          if (crosses(segment, t, ids, p, found))
          {
            isCrossed = true;
            found.Crossings.push_back({ std::int64_t(t), segment.Id });
          }
        }
      });
    if (!isCrossed && this->Noted == NotedEdges::OfCrossed)
    {
      found.Edges.resize(edgesBefore);
    }
  }

  /// Whether the segment meets the triangle's interior. Records corners inside the segment, and an
  /// edge on it.
  static bool crosses(const SegmentTree::Item& segment, std::size_t t, const Id* ids,
    const Point2* p, ScannedTriangles& found)
  {
    std::array<int, 3> side;
    std::array<bool, 3> isOn;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const bool isEnd = p[i] == segment.A || p[i] == segment.B;
      side[i] = isEnd ? 0 : orientation(segment.A, segment.B, p[i]);
      const bool isTouch = side[i] == 0 && !isEnd && isBetween(segment.A, p[i], segment.B);
      isOn[i] = isEnd || isTouch;
      if (isTouch)
      {
        found.Touches.push_back({ segment.Id, PointId(ids[i]) });
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t next = (i + 1) % 3;
      if (side[i] * side[next] < 0)
      {
        // The line passes through the interior and leaves it across this edge. No end of the
        // segment is in the interior, since ends are vertices.
        return orientation(p[i], p[next], segment.A) * orientation(p[i], p[next], segment.B) < 0;
      }
      if (isOn[i] && isOn[next])
      {
        found.Edges.push_back({ std::int64_t(t), i, segment.Id });
        return false;
      }
    }
    return false;
  }

  PointsView Points;
  const SegmentTree& Tree;
  const NotedEdges Noted;
  std::vector<Point2> Positions;
  std::vector<const SegmentTree::Item*> Segments;
  std::vector<std::size_t> LastTriangle; ///< the triangle that each segment was last tested with
  SegmentRaster Raster;
};

} // namespace tipp

#endif

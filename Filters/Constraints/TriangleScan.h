// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleScan_h
#define tippTriangleScan_h

#include "Constraints/CrossedTriangles.h"
#include "Constraints/SegmentTree.h"
#include "Kernel/Lanes.h"
#include "Predicates/ExactPredicates.h"
#include "Triangulation/PointsView.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The results of a scan.
struct ScannedTriangles
{
  struct Crossing
  {
    std::int64_t Triangle;
    std::int64_t Piece;

    bool operator<(const Crossing& other) const
    {
      return this->Triangle != other.Triangle ? this->Triangle < other.Triangle
                                              : this->Piece < other.Piece;
    }
  };
  /// An edge of a triangle that is on a segment.
  struct Edge
  {
    std::int64_t Triangle;
    std::size_t From;     ///< the corner where the edge starts, 0 to 2
    std::int64_t Segment; ///< Id of the segment
  };
  std::vector<Crossing> Crossings;
  std::vector<CrossedTriangles::Touch> Touches;
  std::vector<Edge> Edges; ///< of crossed triangles, or of all triangles
};

/// A raster over some triangles. Its rows list the segments near them.
class SegmentRaster
{
public:
  void fill(const Box2& box, const std::vector<SegmentTree::Item>& segments)
  {
    this->X = Axis(box.xmin, box.xmax);
    this->Y = Axis(box.ymin, box.ymax);
    for (Row& row : this->Rows)
    {
      row.Columns = 0;
      row.Entries.clear();
    }
    for (const SegmentTree::Item& segment : segments)
    {
      const Box2 its = boxOf(segment.A, segment.B);
      const Columns columns = this->columnsOf(its);
      const std::size_t first = this->Y.cellOf(its.ymin);
      for (std::size_t y = first; y <= this->Y.cellOf(its.ymax); ++y)
      {
        this->Rows[y].Columns |= columns;
        this->Rows[y].Entries.push_back({ columns, first, its, &segment });
      }
    }
  }

  /// Calls visit(segment) for each segment whose bounding box overlaps the box.
  template <typename Visit>
  void visitNear(const Box2& box, const Visit& visit) const
  {
    const Columns columns = this->columnsOf(box);
    const std::size_t begin = this->Y.cellOf(box.ymin);
    const std::size_t end = this->Y.cellOf(box.ymax);
    for (std::size_t y = begin; y <= end; ++y)
    {
      if ((this->Rows[y].Columns & columns) == 0)
      {
        continue; // most triangles have no segment nearby
      }
      for (const Entry& entry : this->Rows[y].Entries)
      {
        const bool isNear = (entry.Columns & columns) != 0 && y == std::max(begin, entry.First);
        isNear&& overlap(box, entry.Box) ? visit(*entry.Segment) : void();
      }
    }
  }

private:
  using Columns = std::uint64_t;           ///< a bit for each column
  static constexpr std::size_t Cells = 64; ///< cells per axis

  struct Entry
  {
    SegmentRaster::Columns Columns; ///< that the segment's bounding box meets
    std::size_t First;              ///< the first row that it meets
    Box2 Box;
    const SegmentTree::Item* Segment;
  };
  struct Row
  {
    SegmentRaster::Columns Columns = 0; ///< of all entries
    std::vector<Entry> Entries;
  };

  /// The cells along an axis. If cells would be too small or too large for doubles, only the first
  /// one is used.
  struct Axis
  {
    Axis() = default;
    Axis(double low, double high)
      : Low(low)
    {
      constexpr double shortest = 1e-280;
      const double length = high - low;
      this->Scale = length > shortest && std::isfinite(length) ? double(Cells) / length : 0;
    }

    /// The cell of a coordinate; never decreases with it.
    std::size_t cellOf(double value) const
    {
      const double cell = (value - this->Low) * this->Scale;
      return cell > 0 ? std::size_t(std::min(cell, double(Cells - 1))) : 0;
    }

    double Low = 0;
    double Scale = 0;
  };

  Columns columnsOf(const Box2& box) const
  {
    constexpr Columns all = ~Columns(0);
    return all << this->X.cellOf(box.xmin) & all >> (Cells - 1 - this->X.cellOf(box.xmax));
  }

  Axis X;
  Axis Y;
  std::array<Row, Cells> Rows;
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
        lineMayMeet(item.A, item.B, box) ? this->Segments.push_back(item) : void();
        return true;
      });
    if (this->Segments.empty())
    {
      return;
    }
    this->Raster.fill(box, this->Segments);
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
    return extentOf(this->Positions.data(), this->Positions.size()).box();
  }

  void scanTriangle(std::size_t t, const Id* ids, const Point2* p, ScannedTriangles& found)
  {
    const Pair a = pairAt(&p[0].x);
    const Pair b = pairAt(&p[1].x);
    const Pair c = pairAt(&p[2].x);
    const Pair low = lower(lower(a, b), c);
    const Pair high = higher(higher(a, b), c);
    const Box2 box{ low[0], low[1], high[0], high[1] };
    const std::size_t edgesBefore = found.Edges.size();
    bool isCrossed = false;
    this->Raster.visitNear(box,
      [&](const SegmentTree::Item& segment)
      {
        if (crosses(segment, t, ids, p, found))
        {
          isCrossed = true;
          found.Crossings.push_back({ std::int64_t(t), segment.Id });
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
  std::vector<SegmentTree::Item> Segments;
  SegmentRaster Raster;
};

} // namespace tipp

#endif

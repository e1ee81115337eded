// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/CrossedTriangles.h"

#include "Constraints/PartitionConstraints.h"
#include "Constraints/SegmentTree.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Orientation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tipp
{
namespace
{

struct TriangleRange
{
  std::size_t Begin;
  std::size_t End;
  PartitionIndex Partition; ///< whose interior triangles they are, or -1
};

/// What a scan finds.
struct Found
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
    bool operator==(const Crossing& other) const
    {
      return this->Triangle == other.Triangle && this->Piece == other.Piece;
    }
  };
  std::vector<Crossing> Crossings;
  std::vector<CrossedTriangles::Touch> Touches;
};

/// A raster over some triangles: which segments are near each of its cells.
class SegmentRaster
{
public:
  void fill(const Box2& box, const std::vector<const SegmentTree::Item*>& segments)
  {
    this->X = Axis(box.xmin, box.xmax);
    this->Y = Axis(box.ymin, box.ymax);
    this->Near.clear();
    for (std::size_t s = 0; s < segments.size(); ++s)
    {
      const SegmentTree::Item& segment = *segments[s];
      this->forCells(boxOf(segment.A, segment.B),
        [&](int x, int y)
        {
          if (lineMayMeet(segment.A, segment.B, this->cell(x, y)))
          {
            this->Near.push_back({ y * Cells + x, std::int32_t(s) });
          }
        });
    }
    // A counting sort by cell.
    this->Starts.fill(0);
    for (const auto& entry : this->Near)
    {
      ++this->Starts[std::size_t(entry.Cell) + 1];
    }
    for (std::size_t c = 1; c < this->Starts.size(); ++c)
    {
      this->Starts[c] += this->Starts[c - 1];
    }
    this->Sorted.resize(this->Near.size());
    auto next = this->Starts;
    for (const auto& entry : this->Near)
    {
      this->Sorted[std::size_t(next[std::size_t(entry.Cell)]++)] = entry.Segment;
    }
  }

  /// visit(segment) for all near a box, some of them several times.
  template <typename Visit>
  void visitNear(const Box2& box, const Visit& visit) const
  {
    this->forCells(box,
      [&](int x, int y)
      {
        const std::size_t cell = std::size_t(y * Cells + x);
        for (auto i = this->Starts[cell]; i < this->Starts[cell + 1]; ++i)
        {
          visit(std::size_t(this->Sorted[std::size_t(i)]));
        }
      });
  }

private:
  static constexpr int Cells = 32; ///< along each axis

  struct Entry
  {
    std::int32_t Cell;
    std::int32_t Segment;
  };

  /// Cells along an axis; all of it is the first one if they would be too small or too large for
  /// doubles.
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

    /// Monotone.
    int cellOf(double value) const
    {
      const double cell = (value - this->Low) * this->Scale;
      return cell > 0 ? int(std::min(cell, double(Cells - 1))) : 0;
    }
    double begin(int cell) const
    {
      return this->Scale > 0 ? this->Low + cell * this->Step - this->Margin : this->Low;
    }
    double end(int cell) const
    {
      return this->Scale > 0 ? this->Low + (cell + 1) * this->Step + this->Margin : this->High;
    }

    double Low = 0;
    double High = 0;
    double Step = 0;
    double Scale = 0;
    double Margin = 0;
  };

  /// A box that holds all points of a cell, in spite of rounding.
  Box2 cell(int x, int y) const
  {
    return { this->X.begin(x), this->Y.begin(y), this->X.end(x), this->Y.end(y) };
  }

  template <typename Visit>
  void forCells(const Box2& box, const Visit& visit) const
  {
    const int xEnd = this->X.cellOf(box.xmax);
    const int yEnd = this->Y.cellOf(box.ymax);
    for (int y = this->Y.cellOf(box.ymin); y <= yEnd; ++y)
    {
      for (int x = this->X.cellOf(box.xmin); x <= xEnd; ++x)
      {
        visit(x, y);
      }
    }
  }

  Axis X;
  Axis Y;
  std::vector<Entry> Near;
  std::array<std::int32_t, std::size_t(Cells) * Cells + 1> Starts{};
  std::vector<std::int32_t> Sorted;
};

/// Looks at some triangles at a time.
template <typename Id>
class Scan
{
public:
  static constexpr std::size_t MostTriangles = 2048;

  Scan(PointsView points, const Id* corners, const std::vector<ConstraintPiece>& pieces,
    const SegmentTree& tree, const PartitionConstraints& inserted)
    : Points(points)
    , Corners(corners)
    , Pieces(pieces)
    , Tree(tree)
    , Inserted(inserted)
  {
  }

  void scan(TriangleRange range, Found& found)
  {
    const Box2 box = this->load(range);
    this->Segments.clear();
    this->Tree.visitNear(box,
      [&](const SegmentTree::Item& item)
      {
        if (!this->Inserted.isKnown(item.Id, range.Partition) && lineMayMeet(item.A, item.B, box))
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
    this->LastTriangle.assign(this->Segments.size(), range.End);
    for (std::size_t t = range.Begin; t < range.End; ++t)
    {
      this->scanTriangle(t, &this->Positions[3 * (t - range.Begin)], found);
    }
  }

private:
  Box2 load(TriangleRange range)
  {
    this->Positions.resize(3 * (range.End - range.Begin));
    Box2 box{ HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    const Id* corner = this->Corners + 3 * range.Begin;
    for (Point2& position : this->Positions)
    {
      position = this->Points[std::size_t(*corner++)];
      box.xmin = std::min(box.xmin, position.x);
      box.ymin = std::min(box.ymin, position.y);
      box.xmax = std::max(box.xmax, position.x);
      box.ymax = std::max(box.ymax, position.y);
    }
    return box;
  }

  void scanTriangle(std::size_t t, const Point2* p, Found& found)
  {
    const Box2 box{ std::min({ p[0].x, p[1].x, p[2].x }), std::min({ p[0].y, p[1].y, p[2].y }),
      std::max({ p[0].x, p[1].x, p[2].x }), std::max({ p[0].y, p[1].y, p[2].y }) };
    this->Raster.visitNear(box,
      [&](std::size_t s)
      {
        const SegmentTree::Item& segment = *this->Segments[s];
        if (this->LastTriangle[s] != t && overlap(box, boxOf(segment.A, segment.B)))
        {
          this->LastTriangle[s] = t;
          if (this->crosses(segment, this->Corners + 3 * t, p, found.Touches))
          {
            found.Crossings.push_back({ std::int64_t(t), segment.Id });
          }
        }
      });
  }

  /// Whether the segment, whose ends are vertices, meets the triangle's interior; and corners
  /// inside the segment.
  bool crosses(const SegmentTree::Item& segment, const Id* ids, const Point2* p,
    std::vector<CrossedTriangles::Touch>& touches) const
  {
    const ConstraintPiece& piece = this->Pieces[std::size_t(segment.Id)];
    std::array<int, 3> side;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const bool isEnd = PointId(ids[i]) == piece.A || PointId(ids[i]) == piece.B;
      side[i] = isEnd ? 0 : orientation(segment.A, segment.B, p[i]);
      if (side[i] == 0 && !isEnd && isBetween(segment, p[i]))
      {
        touches.push_back({ segment.Id, PointId(ids[i]) });
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t next = (i + 1) % 3;
      if (side[i] * side[next] < 0)
      {
        // The line passes through the interior, and leaves it by this edge. The ends of the segment
        // are vertices, so they are not in between.
        return orientation(p[i], p[next], segment.A) * orientation(p[i], p[next], segment.B) < 0;
      }
    }
    return false;
  }

  /// Of a point on the segment's line.
  static bool isBetween(const SegmentTree::Item& segment, Point2 p)
  {
    return lexicographicLess(segment.A, segment.B)
      ? lexicographicLess(segment.A, p) && lexicographicLess(p, segment.B)
      : lexicographicLess(segment.B, p) && lexicographicLess(p, segment.A);
  }

  PointsView Points;
  const Id* Corners;
  const std::vector<ConstraintPiece>& Pieces;
  const SegmentTree& Tree;
  const PartitionConstraints& Inserted;
  std::vector<Point2> Positions;
  std::vector<const SegmentTree::Item*> Segments;
  std::vector<std::size_t> LastTriangle; ///< that each segment was tested with
  SegmentRaster Raster;
};

/// The triangles in ranges of a few, without blocks that only known pieces are near, or none.
std::vector<TriangleRange> makeRanges(std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const SegmentTree& tree,
  const PartitionConstraints& inserted)
{
  constexpr std::size_t most = Scan<std::int32_t>::MostTriangles;
  std::vector<TriangleRange> ranges;
  const auto append = [&ranges](std::size_t begin, std::size_t end, PartitionIndex partition)
  {
    for (std::size_t i = begin; i < end; i += most)
    {
      ranges.push_back({ i, std::min(i + most, end), partition });
    }
  };
  constexpr PartitionIndex none = -1;
  std::size_t done = 0;
  for (const TriangleBlock& block : blocks)
  {
    append(done, block.Begin, none);
    bool isNear = false;
    tree.visitNear(block.Box,
      [&](const SegmentTree::Item& item)
      {
        isNear =
          !inserted.isKnown(item.Id, block.Partition) && lineMayMeet(item.A, item.B, block.Box);
        return !isNear;
      });
    if (isNear)
    {
      append(block.Begin, block.End, block.Partition);
    }
    done = block.End;
  }
  append(done, triangles, none);
  return ranges;
}

/// The noted crossings of triangles in blocks; the other triangles have been scanned.
void addNoted(
  const PartitionConstraints& inserted, const std::vector<TriangleBlock>& blocks, Found& found)
{
  for (const PartitionConstraints::Crossing& crossing : inserted.crossings())
  {
    const auto block = std::lower_bound(blocks.begin(), blocks.end(), crossing.Partition,
      [](const TriangleBlock& one, PartitionIndex wanted) { return one.Partition < wanted; });
    if (block != blocks.end() && block->Partition == crossing.Partition &&
      block->Begin + crossing.Triangle < block->End)
    {
      found.Crossings.push_back({ std::int64_t(block->Begin + crossing.Triangle), crossing.Piece });
    }
  }
}

/// By triangle; each once.
CrossedTriangles sorted(Found& found)
{
  std::vector<Found::Crossing>& crossings = found.Crossings;
  std::sort(crossings.begin(), crossings.end());
  crossings.erase(std::unique(crossings.begin(), crossings.end()), crossings.end());
  CrossedTriangles all;
  for (const Found::Crossing& crossing : crossings)
  {
    if (all.Triangles.empty() || all.Triangles.back() != crossing.Triangle)
    {
      all.Triangles.push_back(crossing.Triangle);
      all.Starts.push_back(std::int64_t(all.Pieces.size()));
    }
    all.Pieces.push_back(crossing.Piece);
  }
  all.Starts.push_back(std::int64_t(all.Pieces.size()));
  all.Touches = std::move(found.Touches);
  using Touch = CrossedTriangles::Touch;
  std::sort(all.Touches.begin(), all.Touches.end(),
    [](const Touch& a, const Touch& b)
    { return a.Piece < b.Piece || (a.Piece == b.Piece && a.Vertex < b.Vertex); });
  all.Touches.erase(
    std::unique(all.Touches.begin(), all.Touches.end(),
      [](const Touch& a, const Touch& b) { return a.Piece == b.Piece && a.Vertex == b.Vertex; }),
    all.Touches.end());
  return all;
}

/// The segments of pieces that were not inserted; their Ids are those of pieces.
SegmentTree treeOfOthers(PointsView points, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted)
{
  std::vector<SegmentTree::Item> items;
  for (std::size_t p = 0; p < pieces.size(); ++p)
  {
    if (!inserted.isDone(p))
    {
      items.push_back(
        { points[std::size_t(pieces[p].A)], points[std::size_t(pieces[p].B)], std::int64_t(p) });
    }
  }
  return SegmentTree(std::move(items));
}

} // namespace

template <typename Id>
CrossedTriangles findCrossedTriangles(PointsView points, const Id* corners, std::size_t triangles,
  const std::vector<TriangleBlock>& blocks, const std::vector<ConstraintPiece>& pieces,
  const PartitionConstraints& inserted, int threads)
{
  const SegmentTree tree = treeOfOthers(points, pieces, inserted);
  const std::vector<TriangleRange> ranges = makeRanges(triangles, blocks, tree, inserted);
  std::vector<Scan<Id>> scans(
    std::size_t(threads), Scan<Id>(points, corners, pieces, tree, inserted));
  std::vector<Found> parts(static_cast<std::size_t>(threads));
  forChunks(std::int64_t(ranges.size()), 1, threads, {},
    [&](std::int64_t i, std::int64_t, int thread)
    { scans[std::size_t(thread)].scan(ranges[std::size_t(i)], parts[std::size_t(thread)]); });
  Found all;
  all.Touches = inserted.touches();
  addNoted(inserted, blocks, all);
  for (const Found& part : parts)
  {
    all.Crossings.insert(all.Crossings.end(), part.Crossings.begin(), part.Crossings.end());
    all.Touches.insert(all.Touches.end(), part.Touches.begin(), part.Touches.end());
  }
  return sorted(all);
}

template CrossedTriangles findCrossedTriangles(PointsView, const std::int32_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, int);
template CrossedTriangles findCrossedTriangles(PointsView, const std::int64_t*, std::size_t,
  const std::vector<TriangleBlock>&, const std::vector<ConstraintPiece>&,
  const PartitionConstraints&, int);

} // namespace tipp

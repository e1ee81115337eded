// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleRows_h
#define tippTriangleRows_h

#include "Predicates/ExactPredicates.h"
#include "Resample/Lanes.h"
#include "Resample/Lattice.h"

#include <utility>

namespace tipp
{

/// The samples of a 2D lattice that a triangle claims after the move by (e, e^2).
///
/// A row crosses two edges. The samples strictly to the left of an edge are counted by evaluating
/// the crossing; if rounding could change the count, the one sample in doubt is decided by an exact
/// predicate. Both triangles at an edge count the same samples, so exactly one of them claims each.
///
/// TriangleLanes decides most rows; this decides those that need exact tests, and large triangles.
class TriangleRows
{
public:
  TriangleRows(const LatticeAxis& u, const LatticeAxis& v)
    : U(u)
    , V(v)
  {
  }

  /// Sets the triangle. Returns whether its box has a sample and it is finite and not degenerate.
  [[gnu::always_inline]] bool set(const Point2 (&p)[3])
  {
    const double left = std::min(std::min(p[0].x, p[1].x), p[2].x);
    const double right = std::max(std::max(p[0].x, p[1].x), p[2].x);
    this->Error = this->U.error(std::max(-left, right));
    this->Columns = this->U.range(left, right, this->Error);
    if (this->Columns.empty())
    {
      return false;
    }
    Point2 a = p[0];
    Point2 b = p[1];
    Point2 c = p[2];
    lowFirst(a, b);
    lowFirst(b, c);
    lowFirst(a, b);
    this->Rows = this->V.range(a.y, c.y, this->V.error(std::max(-a.y, c.y)));
    return !this->Rows.empty() && this->setEdges(a, b, c);
  }

  IndexRange columns() const { return this->Columns; }
  IndexRange rows() const { return this->Rows; }
  /// The plane counts as the only layer of a 3D lattice.
  static IndexRange layers() { return { 0, 1 }; }

  RowSpan span(int row, int) const
  {
    const double y = this->V[row];
    if (y >= this->Long.High.y)
    {
      return this->top();
    }
    const RowCrossing atLong = this->crossing(this->Long, y);
    const RowCrossing atShort = this->crossing(this->Short[y >= this->Middle], y);
    const RowCrossing& left = this->LongIsLeft ? atLong : atShort;
    const RowCrossing& right = this->LongIsLeft ? atShort : atLong;
    return { left.Before, right.Before, right.WithOn };
  }

  /// Number of exact tests so far.
  std::int64_t exactTests() const { return this->ExactTests; }

private:
  /// Low.y < High.y.
  struct Edge
  {
    Point2 Low;
    Point2 High;
    double Slope;
  };

  static Edge edge(Point2 low, Point2 high)
  {
    return { low, high, (high.x - low.x) / (high.y - low.y) };
  }

  static void lowFirst(Point2& a, Point2& b) { b.y < a.y ? std::swap(a, b) : void(); }

  [[gnu::always_inline]] bool setEdges(Point2 a, Point2 b, Point2 c)
  {
    // NaN if a coordinate is infinite or NaN, or if a difference overflows.
    const double width = (b.x - a.x) + (c.x - a.x) + (c.y - a.y);
    const int side = width - width == 0 || finite(a, b, c) ? orientation(a, c, b) : 0;
    this->LongIsLeft = side < 0;
    this->Middle = b.y;
    this->Long = edge(a, c);
    this->Short[0] = edge(a, b); // unused if level: no row is below b then
    this->Short[1] = edge(b, c); // likewise
    // Without an overflow a slope is at most the quotient of the largest and the smallest step.
    if (!(std::fabs(this->Long.Slope) + this->slopeInUse(0) + this->slopeInUse(1) < HUGE_VAL))
    {
      this->Error = HUGE_VAL;
    }
    return side != 0;
  }

  double slopeInUse(int i) const
  {
    const Edge& edge = this->Short[i];
    return edge.Low.y < edge.High.y ? std::fabs(edge.Slope) : 0;
  }

  static bool finite(Point2 a, Point2 b, Point2 c)
  {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(b.y) &&
      std::isfinite(c.x) && std::isfinite(c.y);
  }

  /// The span of the highest row if it is at the height of the highest corner: its samples are
  /// outside after the move, so they are only touched.
  RowSpan top() const
  {
    const Point2 c = this->Long.High;
    const Point2 b = this->Short[1].Low;
    const double other = b.y < c.y ? c.x : b.x;
    const IndexRange touched =
      this->U.range(std::min(c.x, other), std::max(c.x, other), this->Error);
    return { touched.Begin, touched.Begin, touched.End };
  }

  /// The samples of row y to the left of the edge.
  RowCrossing crossing(const Edge& edge, double y) const
  {
    const double position = this->U.position(edge.Low.x + (y - edge.Low.y) * edge.Slope);
    return this->U.crossing(position, this->Error, this->Columns,
      [&](int i)
      {
        ++this->ExactTests;
        return orientation(edge.Low, edge.High, { this->U[i], y });
      });
  }

  const LatticeAxis& U;
  const LatticeAxis& V;
  Edge Long;
  Edge Short[2]; ///< below and above the middle corner
  double Middle;
  double Error;
  bool LongIsLeft;
  IndexRange Columns;
  IndexRange Rows;
  mutable std::int64_t ExactTests = 0;
};

/// TriangleRows for four triangles at a time. It handles only the rows whose result rounding errors
/// cannot change; the others are marked as doubtful.
class TriangleLanes
{
public:
  TriangleLanes(const LatticeAxis& u, const LatticeAxis& v)
    : U(u)
    , V(v)
  {
  }

  /// Loads four cells, from `first` on.
  template <typename Access>
  [[gnu::always_inline]] void set(const Access& cells, std::int64_t first)
  {
    const LaneCorners<Point2, 3> p(cells, first);
    Lanes x[3] = {};
    Lanes y[3] = {};
    for (int i = 0; i < 3; ++i)
    {
      x[i] = p.get(i, &Point2::x);
      y[i] = p.get(i, &Point2::y);
    }
    this->Columns = { this->U, least(least(x[0], x[1]), x[2]), most(most(x[0], x[1]), x[2]) };
    order(x, y, 0, 1);
    order(x, y, 1, 2);
    order(x, y, 0, 1);
    this->Rows = { this->V, y[0], y[2] };
    this->Nothing = this->Columns.Empty | this->Rows.Empty;
    this->setEdges(x, y);
  }

  /// Whether nothing(lane) is true for all.
  bool nothing() const { return !any(~this->Nothing); }
  /// Whether the triangle's box certainly has no sample.
  bool nothing(int lane) const { return this->Nothing[lane] != 0; }
  /// Whether the triangle is certainly finite and not degenerate.
  bool fast(int lane) const { return this->Fast[lane] != 0; }

  IndexRange columns(int lane) const { return this->Columns.range(lane); }
  IndexRange rows(int lane) const { return this->Rows.range(lane); }
  static IndexRange layers(int) { return { 0, 1 }; }

  static void prepareRows() {}

  /// Four rows of a fast() triangle, from its row `first` on.
  [[gnu::always_inline]] RowSpans<laneCount> spans(int lane, int first) const
  {
    const IndexRange rows = this->rows(lane);
    const int row = rows.Begin + first;
    const LaneMask wanted = firstLanes(rows.End - row);
    const Lanes y = this->V.coordinates(row);
    const LaneMask upper = y >= this->Y[1][lane];
    const Lanes lowX = upper ? allLanes(this->X[1][lane]) : allLanes(this->X[0][lane]);
    const Lanes lowY = upper ? allLanes(this->Y[1][lane]) : allLanes(this->Y[0][lane]);
    const Lanes slope = upper ? allLanes(this->Slopes[2][lane]) : allLanes(this->Slopes[1][lane]);
    const Lanes atLong =
      this->U.position(this->X[0][lane] + (y - this->Y[0][lane]) * this->Slopes[0][lane]);
    const Lanes atShort = this->U.position(lowX + (y - lowY) * slope);
    const Lanes error = allLanes(this->Columns.Error[lane]);
    const Lanes wholeLong = whole(atLong);
    const Lanes wholeShort = whole(atShort);
    const LaneMask certain = AxisLanes::certain(atLong, wholeLong, error) &
      AxisLanes::certain(atShort, wholeShort, error) & (y < this->Y[2][lane]);
    const LaneMask longIsLeft = LaneMask{} + this->LongIsLeft[lane];
    const Lanes begin = longIsLeft ? wholeLong : wholeShort;
    const Lanes end = longIsLeft ? wholeShort : wholeLong;
    RowSpans<laneCount> spans;
    spans.Open = laneBits((begin < end) & wanted);
    spans.Doubtful = laneBits(~certain & wanted);
    const LaneInts begins = __builtin_convertvector(begin, LaneInts);
    spans.set(begins, __builtin_convertvector(end, LaneInts) - begins, LaneInts{ 0, 1, 2, 3 } + row,
      LaneInts{});
    return spans;
  }

private:
  /// Exchanges corners so that i is not above j.
  [[gnu::always_inline]] static void order(Lanes (&x)[3], Lanes (&y)[3], int i, int j)
  {
    const LaneMask swap = y[j] < y[i];
    const Lanes xi = swap ? x[j] : x[i];
    const Lanes yi = swap ? y[j] : y[i];
    x[j] = swap ? x[i] : x[j];
    y[j] = swap ? y[i] : y[j];
    x[i] = xi;
    y[i] = yi;
  }

  /// Computes the edges of corners sorted from low to high.
  [[gnu::always_inline]] void setEdges(const Lanes (&x)[3], const Lanes (&y)[3])
  {
    // NaN if a coordinate is infinite or NaN, or if a difference overflows.
    const Lanes width = (x[1] - x[0]) + (x[2] - x[0]) + (y[2] - y[0]);
    // orientation(low, high, middle) with its filter: see ExactPredicates.h.
    const Lanes left = (x[0] - x[1]) * (y[2] - y[1]);
    const Lanes right = (y[0] - y[1]) * (x[2] - x[1]);
    const Lanes determinant = left - right;
    const Lanes bound = 3.3306690738754716e-16 * (absolute(left) + absolute(right)) + 1e-300;
    this->LongIsLeft = determinant < 0;
    this->Slopes[0] = (x[2] - x[0]) / (y[2] - y[0]);
    this->Slopes[1] = (x[1] - x[0]) / (y[1] - y[0]); // unused if level
    this->Slopes[2] = (x[2] - x[1]) / (y[2] - y[1]); // likewise
    const Lanes none = allLanes(0);
    const Lanes lower = y[0] < y[1] ? absolute(this->Slopes[1]) : none;
    const Lanes upper = y[1] < y[2] ? absolute(this->Slopes[2]) : none;
    const Lanes slopes = absolute(this->Slopes[0]) + lower + upper;
    this->Fast = (absolute(determinant) > bound) & (width - width == 0) & (slopes < HUGE_VAL);
    for (int i = 0; i < 3; ++i)
    {
      this->X[i] = x[i];
      this->Y[i] = y[i];
    }
  }

  AxisLanes U;
  AxisLanes V;
  LaneMask Nothing;
  LaneMask Fast;
  LaneMask LongIsLeft;
  Lanes X[3]; ///< the corners' coordinates, from the lowest corner to the highest
  Lanes Y[3];
  Lanes Slopes[3]; ///< of the longest edge in v, and of those below and above the middle corner
  RangeLanes Columns;
  RangeLanes Rows;
};

} // namespace tipp

#endif

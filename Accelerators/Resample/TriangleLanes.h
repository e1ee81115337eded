// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleLanes_h
#define tippTriangleLanes_h

#include "Resample/Lanes.h"
#include "Resample/TriangleRows.h"

namespace tipp
{

/// TriangleRows for four triangles at a time, for rows that rounding leaves decided.
class TriangleLanes
{
public:
  TriangleLanes(const LatticeAxis& u, const LatticeAxis& v)
    : U(u)
    , V(v)
  {
  }

  /// Takes the cells from `first` on.
  template <typename Access>
  [[gnu::always_inline]] void set(const Access& cells, std::int64_t first)
  {
    Point2 p[laneCount][3];
    for (int lane = 0; lane < laneCount; ++lane)
    {
      cells.corners(first + lane, p[lane]);
    }
    Lanes x[3] = {};
    Lanes y[3] = {};
    for (int i = 0; i < 3; ++i)
    {
      x[i] = Lanes{ p[0][i].x, p[1][i].x, p[2][i].x, p[3][i].x };
      y[i] = Lanes{ p[0][i].y, p[1][i].y, p[2][i].y, p[3][i].y };
    }
    const RangeLanes columns(this->U, least(least(x[0], x[1]), x[2]), most(most(x[0], x[1]), x[2]));
    order(x, y, 0, 1);
    order(x, y, 1, 2);
    order(x, y, 0, 1);
    const RangeLanes rows(this->V, y[0], y[2]);
    this->Nothing = columns.Empty | rows.Empty;
    this->setEdges(x, y);
    this->Error = columns.Error;
    this->Columns = { columns.Begin, columns.End };
    this->Rows = { rows.Begin, rows.End };
  }

  /// Whether that holds for all.
  bool nothing() const { return !any(~this->Nothing); }
  /// Whether the triangle's box certainly has no sample.
  bool nothing(int lane) const { return this->Nothing[lane] != 0; }
  /// Whether the triangle certainly is finite and has an area.
  bool fast(int lane) const { return this->Fast[lane] != 0; }

  IndexRange columns(int lane) const { return this->Columns.range(lane); }
  IndexRange rows(int lane) const { return this->Rows.range(lane); }
  static IndexRange layers(int) { return { 0, 1 }; }

  static void prepareRows() {}

  /// Four rows of a fast triangle, from its row `first` on.
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
    const Lanes error = allLanes(this->Error[lane]);
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
  struct Ranges
  {
    IndexRange range(int lane) const { return { int(this->Begin[lane]), int(this->End[lane]) }; }
    Lanes Begin;
    Lanes End;
  };

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

  /// Of the corners from low to high.
  [[gnu::always_inline]] void setEdges(const Lanes (&x)[3], const Lanes (&y)[3])
  {
    // An infinite coordinate, or NaN, makes NaN of this; so does the overflow of a difference.
    const Lanes width = (x[1] - x[0]) + (x[2] - x[0]) + (y[2] - y[0]);
    // orientation(low, high, middle) with its filter: see Orientation.h.
    const Lanes left = (x[0] - x[1]) * (y[2] - y[1]);
    const Lanes right = (y[0] - y[1]) * (x[2] - x[1]);
    const Lanes determinant = left - right;
    const Lanes bound = 3.3306690738754716e-16 * (absolute(left) + absolute(right)) + 1e-300;
    this->LongIsLeft = determinant < 0;
    this->Slopes[0] = (x[2] - x[0]) / (y[2] - y[0]);
    this->Slopes[1] = (x[1] - x[0]) / (y[1] - y[0]); // not asked for if level
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
  Lanes X[3]; ///< of the corners, from the lowest to the highest
  Lanes Y[3];
  Lanes Slopes[3]; ///< from the lowest to the highest corner, and of the edges below and above the
                   ///< other
  Lanes Error;
  Ranges Columns;
  Ranges Rows;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellLanes_h
#define tippCellLanes_h

#include "Resample/Lanes.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"

#include <cmath>
#include <cstdint>
#include <type_traits>

namespace tipp
{

/// TriangleRows for four triangles at a time. It handles only the rows whose result rounding errors
/// cannot change; the others are marked as doubtful.
class TriangleLanes
{
public:
  explicit TriangleLanes(const LatticeAxes& axes)
    : U(axes.U)
    , V(axes.V)
  {
  }

  /// Loads four cells, from `first` on.
  template <typename Access>
  [[gnu::always_inline]] void set(const Access& cells, std::int64_t first)
  {
    const LaneCorners<Point2, 3> p(cells, first);
    Lanes x[3] = { p.get(0, &Point2::x), p.get(1, &Point2::x), p.get(2, &Point2::x) };
    Lanes y[3] = { p.get(0, &Point2::y), p.get(1, &Point2::y), p.get(2, &Point2::y) };
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
  const RangeLanes& columns() const { return this->Columns; }
  const RangeLanes& rows() const { return this->Rows; }
  static IndexRange layers(int) { return { 0, 1 }; }

  static void prepareRows() {}

  /// Four rows of a fast() triangle, from its row `first` on.
  [[gnu::always_inline]] RowSpans<laneCount> spans(int lane, int first) const
  {
    const IndexRange rows = this->rows(lane);
    const int row = rows.Begin + first;
    const LaneMask wanted = LaneMask{ 0, 1, 2, 3 } < rows.End - row;
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
    this->Slopes[1] = (x[1] - x[0]) / (y[1] - y[0]); // not used if y[0] == y[1]
    this->Slopes[2] = (x[2] - x[1]) / (y[2] - y[1]); // not used if y[1] == y[2]
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

/// TetrahedronRows for four tetrahedra at a time. It handles only the rows whose result rounding
/// errors cannot change; the others are marked as doubtful.
class TetrahedronLanes
{
public:
  explicit TetrahedronLanes(const LatticeAxes& axes)
    : X(axes.U)
    , Y(axes.V)
    , Z(axes.W)
  {
  }

  /// Loads four cells, from `first` on.
  template <typename Access>
  [[gnu::always_inline]] void set(const Access& cells, std::int64_t first)
  {
    const LaneCorners<Point3, 4> p(cells, first);
    PointLanes corners[4] = {};
    for (int i = 0; i < 4; ++i)
    {
      corners[i] = { p.get(i, &Point3::x), p.get(i, &Point3::y), p.get(i, &Point3::z) };
    }
    const PointLanes low = leastOf(corners);
    const PointLanes high = mostOf(corners);
    const RangeLanes columns(this->X, low.x, high.x);
    const RangeLanes rows(this->Y, low.y, high.y);
    const RangeLanes layers(this->Z, low.z, high.z);
    const PointLanes size = high - low;
    this->Nothing = columns.Empty | rows.Empty | layers.Empty;
    const LaneMask singleRow = (rows.End - rows.Begin == 1) & (layers.End - layers.Begin == 1);
    const LaneMask single = singleRow & (columns.End - columns.Begin == 1);
    this->Single = !any(~(single | this->Nothing));
    if (this->nothing())
    {
      return;
    }
    if (this->Single)
    {
      this->setSamples(corners, size, columns, rows, layers);
      return;
    }
    columns.store(this->Columns);
    rows.store(this->Rows);
    layers.store(this->Layers);
    this->RowError = rows.Error;
    this->LayerError = layers.Error;
    this->orient(corners);
    this->SingleRows = !any(~((singleRow & this->Fast) | this->Nothing));
    this->setFace(0, corners[1], corners[3], corners[2], size, columns.Error);
    this->setFace(1, corners[0], corners[2], corners[3], size, columns.Error);
    this->setFace(2, corners[0], corners[3], corners[1], size, columns.Error);
    this->setFace(3, corners[0], corners[1], corners[2], size, columns.Error);
  }

  /// Whether nothing(lane) is true for all; the other results are then undefined.
  bool nothing() const { return !any(~this->Nothing); }
  /// Whether the tetrahedron's box certainly has no sample.
  bool nothing(int lane) const { return this->Nothing[lane] != 0; }
  /// Whether every box that is not empty has exactly one sample. Then only samples() is defined.
  bool haveSingleSamples() const { return this->Single; }
  /// A bit for each tetrahedron whose box may have a sample.
  unsigned visited() const { return laneBits(~this->Nothing); }
  /// The sample of each tetrahedron's box; `Open` is set if it is inside or undecided.
  const RowSpans<laneCount>& samples() const { return this->Samples; }

  /// Whether the tetrahedron is certainly finite and not flat.
  bool fast(int lane) const { return this->Fast[lane] != 0; }

  IndexRange columns(int lane) const { return this->Columns[lane]; }
  IndexRange rows(int lane) const { return this->Rows[lane]; }
  IndexRange layers(int lane) const { return this->Layers[lane]; }

  /// Whether every box that is not empty has exactly one row; then singleRows() is faster.
  bool haveSingleRows() const { return this->SingleRows; }

  /// The row of each tetrahedron's box.
  [[gnu::always_inline]] RowSpans<laneCount> singleRows() const
  {
    const PointLanes at = this->firstRows();
    Lanes last = {};
    LaneInts row = {};
    LaneInts layer = {};
    for (int lane = 0; lane < laneCount; ++lane)
    {
      last[lane] = this->Columns[lane].End;
      row[lane] = this->Rows[lane].Begin;
      layer[lane] = this->Layers[lane].Begin;
    }
    Lanes begin = at.x;
    Lanes end = last;
    LaneMask certain = LaneMask{} - 1;
    for (const Face& face : this->Faces)
    {
      const Lanes position = this->X.clamp(face.at(at));
      const Lanes before = whole(position);
      const LaneMask sure = AxisLanes::certain(position, before, face.Error);
      certain &= sure;
      begin = most((sure & face.Forward) ? before : at.x, begin);
      end = least((sure & ~face.Forward) ? before : last, end);
    }
    const LaneMask open = (begin < end) & ~this->Nothing;
    RowSpans<laneCount> spans;
    spans.Open = laneBits(open);
    // An undecided face matters only if the other faces leave samples.
    spans.Doubtful = laneBits(~certain & open);
    spans.set(toInts(begin), toInts(end) - toInts(begin), row, layer);
    return spans;
  }

  /// To be called before spans().
  [[gnu::always_inline]] void prepareRows()
  {
    const PointLanes first = this->firstRows();
    Lanes rows = {};
    Lanes layers = {};
    for (int lane = 0; lane < laneCount; ++lane)
    {
      rows[lane] = this->Rows[lane].size();
      layers[lane] = this->Layers[lane].size();
    }
    Lanes worst = {};
    for (int i = 0; i < 4; ++i)
    {
      this->prepareCut(i, first, rows, layers, worst);
    }
    storeFloats(0.5 - FloatSlack - worst, this->Certainty);
    storeFloats(1 / rows, this->PerRows);
  }

  /// Eight rows of a fast() tetrahedron, from row `first` on, counted from the first row of its
  /// first layer. Uses single precision, which decides nearly all rows.
  [[gnu::always_inline]] RowSpans<floatLaneCount> spans(int lane, int first) const
  {
    const IndexRange across = this->Rows[lane];
    const IndexRange deep = this->Layers[lane];
    const FloatLanes number = FloatLanes{ 0, 1, 2, 3, 4, 5, 6, 7 } + float(first);
    const FloatLaneInts layer = toInts((number + 0.5F) * this->PerRows[lane]);
    const FloatLanes up = toFloats(layer);
    const FloatLanes along = number - up * float(across.size());
    const float width = float(this->Columns[lane].size());
    FloatLanes begin = allFloats(0.5F);
    FloatLanes end = allFloats(width + 0.5F);
    for (const Cut& cut : this->Cuts)
    {
      const FloatLanes position =
        cut.Position[lane] - (cut.PerRow[lane] * along + cut.PerLayer[lane] * up);
      begin = most(position + cut.NotBegin[lane], begin);
      end = least(position + cut.NotEnd[lane], end);
    }
    begin = least(begin, allFloats(width + 0.5F));
    end = most(end, allFloats(0.5F));
    const FloatLaneInts begins = toInts(begin);
    const FloatLaneInts ends = toInts(end);
    const FloatLaneInts wanted = number < float(across.size() * deep.size());
    const FloatLaneInts sure = this->certain(lane, begin, begins) & this->certain(lane, end, ends);
    RowSpans<floatLaneCount> spans;
    spans.Open = floatLaneBits((begins < ends) & wanted);
    spans.Doubtful = floatLaneBits(~sure & (begins <= ends + 1) & wanted);
    const FloatLaneInts row = toInts(along) + across.Begin;
    spans.set(begins + this->Columns[lane].Begin, ends - begins, row, layer + deep.Begin);
    return spans;
  }

private:
  /// Where the plane of a face of each tetrahedron crosses rows of samples parallel to x.
  struct Face
  {
    Lanes Position;
    Lanes PerY;
    Lanes PerZ;
    Lanes AY;
    Lanes AZ;
    Lanes Error;
    LaneMask Forward;

    /// The position of the crossing with a row.
    [[gnu::always_inline]] Lanes at(const PointLanes& row) const
    {
      return this->Position - (this->PerY * (row.y - this->AY) + this->PerZ * (row.z - this->AZ));
    }
  };

  /// A face for spans(): where it crosses the first row, in steps from the box's first column, and
  /// how many steps earlier with each further row and layer.
  struct Cut
  {
    float Position[laneCount];
    float PerRow[laneCount];
    float PerLayer[laneCount];
    float NotBegin[laneCount]; ///< -Beyond if rows do not begin at the face
    float NotEnd[laneCount];   ///< Beyond if they do not end there
  };

  static constexpr double Smallest = 1e-280; ///< keeps clear of underflow
  static constexpr float Beyond = 1e30F;
  static constexpr double FloatSlack = 0x1p-20; ///< for the roundings of Certainty

  /// The coordinates of each box's first row, and the number of its first column.
  [[gnu::always_inline]] PointLanes firstRows() const
  {
    PointLanes first = {};
    for (int lane = 0; lane < laneCount; ++lane)
    {
      first.x[lane] = this->Columns[lane].Begin;
      first.y[lane] = this->Y.Axis[this->Rows[lane].Begin];
      first.z[lane] = this->Z.Axis[this->Layers[lane].Begin];
    }
    return first;
  }

  /// `first`: see firstRows().
  [[gnu::always_inline]] void prepareCut(
    int i, const PointLanes& first, Lanes rows, Lanes layers, Lanes& worst)
  {
    // A position has seven roundings of 2^-24 of these numbers; this allows for eight.
    constexpr double roundings = 0x1p-21;
    // With a larger error single precision decides too few rows.
    constexpr double useless = 0.25;
    const Face& face = this->Faces[i];
    const Lanes position = face.at(first) - first.x;
    const Lanes perRow = face.PerY * this->Y.Delta;
    const Lanes perLayer = face.PerZ * this->Z.Delta;
    // Stepping from the first row reaches the other rows' coordinates up to the errors of their
    // axes. Therefore the errors of PerY and PerZ count twice.
    const Lanes error = 2 * face.Error + absolute(perRow) * this->RowError +
      absolute(perLayer) * this->LayerError +
      roundings * (absolute(position) + absolute(perRow) * rows + absolute(perLayer) * layers);
    const LaneMask good = error < useless;
    const Lanes none = {};
    worst = good ? most(error, worst) : allLanes(1);
    Cut& cut = this->Cuts[i];
    storeFloats(good ? position : none, cut.Position);
    storeFloats(good ? perRow : none, cut.PerRow);
    storeFloats(good ? perLayer : none, cut.PerLayer);
    storeFloats((good & face.Forward) ? none : allLanes(-Beyond), cut.NotBegin);
    storeFloats((good & ~face.Forward) ? none : allLanes(Beyond), cut.NotEnd);
  }

  [[gnu::always_inline]] FloatLaneInts certain(
    int lane, FloatLanes position, FloatLaneInts whole) const
  {
    return absolute(position - toFloats(whole) - 0.5F) < this->Certainty[lane];
  }

  /// Not a lambda, which would not be compiled for the caller's instruction set.
  [[gnu::always_inline]] static Lanes minor(const PointLanes& a, const PointLanes& b)
  {
    return a.x * b.y - b.x * a.y;
  }

  [[gnu::always_inline]] void setSamples(const PointLanes (&corners)[4], const PointLanes& size,
    const RangeLanes& columns, const RangeLanes& rows, const RangeLanes& layers)
  {
    const PointLanes sample{ this->X.coordinates(columns.Begin), this->Y.coordinates(rows.Begin),
      this->Z.coordinates(layers.Begin) };
    const PointLanes p[4] = { corners[0] - sample, corners[1] - sample, corners[2] - sample,
      corners[3] - sample };
    const Lanes m01 = minor(p[0], p[1]);
    const Lanes m02 = minor(p[0], p[2]);
    const Lanes m03 = minor(p[0], p[3]);
    const Lanes m12 = minor(p[1], p[2]);
    const Lanes m13 = minor(p[1], p[3]);
    const Lanes m23 = minor(p[2], p[3]);
    // The barycentric weights times the volume, which may be negative.
    const Lanes weights[4] = { p[1].z * m23 - p[2].z * m13 + p[3].z * m12,
      p[2].z * m03 - p[0].z * m23 - p[3].z * m02, p[0].z * m13 - p[1].z * m03 + p[3].z * m01,
      p[1].z * m02 - p[0].z * m12 - p[2].z * m01 };
    // None of the six products exceeds the box's volume, and each has eight roundings: 48 in total.
    const Lanes bound =
      LatticeAxis::Roundings * size.x * size.y * size.z + Smallest * (1.0 + size.z);
    LaneMask allAbove = LaneMask{} - 1;
    LaneMask allBelow = allAbove;
    LaneMask anyAbove = {};
    LaneMask anyBelow = {};
    for (const Lanes& weight : weights)
    {
      const LaneMask above = weight > bound;
      const LaneMask below = weight < -bound;
      allAbove &= above;
      allBelow &= below;
      anyAbove |= above;
      anyBelow |= below;
    }
    const LaneMask outside = (anyAbove & anyBelow) | this->Nothing;
    this->Samples.Open = laneBits(~outside);
    this->Samples.Doubtful = laneBits(~(outside | allAbove | allBelow));
    this->Samples.set(
      toInts(columns.Begin), LaneInts{} + 1, toInts(rows.Begin), toInts(layers.Begin));
  }

  /// orientation3() with its filter; reorders corners so that all orientations are positive, as in
  /// VTK.
  [[gnu::always_inline]] void orient(PointLanes (&p)[4])
  {
    const PointLanes& d = p[3];
    const PointLanes a = p[0] - d;
    const PointLanes b = p[1] - d;
    const PointLanes c = p[2] - d;
    const Lanes minus =
      a.z * (b.x * c.y - c.x * b.y) + b.z * (c.x * a.y - a.x * c.y) + c.z * (a.x * b.y - b.x * a.y);
    const Lanes heights = absolute(a.z) + absolute(b.z) + absolute(c.z);
    const Lanes permanent = absolute(a.z) * (absolute(b.x * c.y) + absolute(c.x * b.y)) +
      absolute(b.z) * (absolute(c.x * a.y) + absolute(a.x * c.y)) +
      absolute(c.z) * (absolute(a.x * b.y) + absolute(b.x * a.y));
    const Lanes bound = 7.7715611723761e-16 * permanent + 1e-300 * (1.0 + heights);
    // False for NaN and infinity.
    this->Fast = absolute(minus) > bound;
    const LaneMask swap = minus > 0;
    const PointLanes first = p[0];
    p[0] = { swap ? p[1].x : first.x, swap ? p[1].y : first.y, swap ? p[1].z : first.z };
    p[1] = { swap ? first.x : p[1].x, swap ? first.y : p[1].y, swap ? first.z : p[1].z };
  }

  [[gnu::always_inline]] void setFace(int i, const PointLanes& a, const PointLanes& b,
    const PointLanes& c, const PointLanes& size, Lanes columnError)
  {
    constexpr double roundings = LatticeAxis::Roundings;
    const PointLanes u = b - a;
    const PointLanes v = c - a;
    const Lanes nx = u.y * v.z - u.z * v.y;
    const Lanes ny = u.z * v.x - u.x * v.z;
    const Lanes nz = u.x * v.y - u.y * v.x;
    const Lanes scale = this->X.Inverse / nx;
    Face& face = this->Faces[i];
    face.Position = (a.x - this->X.Origin) * this->X.Inverse - this->X.First + 1;
    face.PerY = ny * scale;
    face.PerZ = nz * scale;
    face.AY = a.y;
    face.AZ = a.z;
    face.Forward = nx > 0;
    const Lanes area = roundings * size.y * size.z;
    const Lanes error = columnError + (area * size.x + Smallest) * absolute(scale);
    const LaneMask good = (absolute(nx) > area + Smallest) &
      (error + absolute(face.PerY) + absolute(face.PerZ) < HUGE_VAL);
    face.Error = good ? error : allLanes(HUGE_VAL);
  }

  AxisLanes X;
  AxisLanes Y;
  AxisLanes Z;
  LaneMask Nothing;
  LaneMask Fast;
  bool Single = false;
  bool SingleRows = false;
  RowSpans<laneCount> Samples;
  Face Faces[4];
  Cut Cuts[4];
  Lanes RowError;
  Lanes LayerError;
  float Certainty[laneCount]; ///< a crossing this close to midway between samples is certain
  float PerRows[laneCount];   ///< 1 / number of rows in a layer
  IndexRange Columns[laneCount];
  IndexRange Rows[laneCount];
  IndexRange Layers[laneCount];
};

template <int Dimension>
using CellLanes = std::conditional_t<Dimension == 2, TriangleLanes, TetrahedronLanes>;

} // namespace tipp

#endif

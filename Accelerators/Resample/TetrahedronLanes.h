// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedronLanes_h
#define tippTetrahedronLanes_h

#include "Resample/Lanes.h"
#include "Resample/TetrahedronRows.h"

namespace tipp
{

/// TetrahedronRows for four tetrahedra at a time. It handles only the rows whose result rounding
/// errors cannot change; the others are marked as doubtful.
class TetrahedronLanes
{
public:
  TetrahedronLanes(const LatticeAxis& x, const LatticeAxis& y, const LatticeAxis& z)
    : X(x)
    , Y(y)
    , Z(z)
  {
  }

  /// Loads four cells, from `first` on.
  template <typename Access>
  [[gnu::always_inline]] void set(const Access& cells, std::int64_t first)
  {
    const LaneCorners<Point3, 4> p(cells, first);
    Corner corners[4] = {};
    for (int i = 0; i < 4; ++i)
    {
      corners[i].x = p.get(i, &Point3::x);
      corners[i].y = p.get(i, &Point3::y);
      corners[i].z = p.get(i, &Point3::z);
    }
    const Lanes left = leastOf(corners, &Corner::x);
    const Lanes right = mostOf(corners, &Corner::x);
    const Lanes front = leastOf(corners, &Corner::y);
    const Lanes back = mostOf(corners, &Corner::y);
    const Lanes low = leastOf(corners, &Corner::z);
    const Lanes high = mostOf(corners, &Corner::z);
    const RangeLanes columns(this->X, left, right);
    const RangeLanes rows(this->Y, front, back);
    const RangeLanes layers(this->Z, low, high);
    const Corner size{ right - left, back - front, high - low };
    this->Nothing = columns.Empty | rows.Empty | layers.Empty;
    const LaneMask single = (columns.End - columns.Begin == 1) & (rows.End - rows.Begin == 1) &
      (layers.End - layers.Begin == 1);
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
    store(columns, this->Columns);
    store(rows, this->Rows);
    store(layers, this->Layers);
    this->RowError = rows.Error;
    this->LayerError = layers.Error;
    this->orient(corners);
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
  bool haveSingleRows() const
  {
    bool single = true;
    for (int lane = 0; lane < laneCount; ++lane)
    {
      const bool one = this->Rows[lane].size() == 1 && this->Layers[lane].size() == 1;
      single = single && (this->nothing(lane) || (one && this->fast(lane)));
    }
    return single;
  }

  /// The row of each tetrahedron's box.
  [[gnu::always_inline]] RowSpans<laneCount> singleRows() const
  {
    Lanes y = {};
    Lanes z = {};
    Lanes first = {};
    Lanes last = {};
    for (int lane = 0; lane < laneCount; ++lane)
    {
      y[lane] = this->nothing(lane) ? 0 : this->Y.coordinate(this->Rows[lane].Begin);
      z[lane] = this->nothing(lane) ? 0 : this->Z.coordinate(this->Layers[lane].Begin);
      first[lane] = this->Columns[lane].Begin;
      last[lane] = this->Columns[lane].End;
    }
    RowLanes rows{ first, last, LaneMask{} - 1 };
    for (const Face& face : this->Faces)
    {
      this->cut(rows, first, last,
        face.Position - (face.PerY * (y - face.AY) + face.PerZ * (z - face.AZ)), face.Error,
        face.Forward);
    }
    const LaneMask open = (rows.Begin < rows.End) & ~this->Nothing;
    RowSpans<laneCount> spans;
    spans.Open = laneBits(open);
    // An undecided face matters only if the other faces leave samples.
    spans.Doubtful = laneBits(~rows.Certain & open);
    const LaneInts begins = toInts(rows.Begin);
    const LaneInts ends = toInts(rows.End);
    LaneInts row;
    LaneInts layer;
    for (int lane = 0; lane < laneCount; ++lane)
    {
      row[lane] = this->Rows[lane].Begin;
      layer[lane] = this->Layers[lane].Begin;
    }
    spans.set(begins, ends - begins, row, layer);
    return spans;
  }

  /// To be called before spans().
  [[gnu::always_inline]] void prepareRows()
  {
    Lanes y = {};
    Lanes z = {};
    Lanes first = {};
    Lanes rows = {};
    Lanes layers = {};
    for (int lane = 0; lane < laneCount; ++lane)
    {
      y[lane] = this->Y.coordinate(this->Rows[lane].Begin);
      z[lane] = this->Z.coordinate(this->Layers[lane].Begin);
      first[lane] = this->Columns[lane].Begin;
      rows[lane] = this->Rows[lane].size();
      layers[lane] = this->Layers[lane].size();
    }
    Lanes worst = {};
    for (int i = 0; i < 4; ++i)
    {
      this->prepareCut(i, { first, y, z }, rows, layers, worst);
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
  struct Corner
  {
    Lanes x;
    Lanes y;
    Lanes z;
  };

  /// As in TetrahedronRows.
  struct Face
  {
    Lanes Position;
    Lanes PerY;
    Lanes PerZ;
    Lanes AY;
    Lanes AZ;
    Lanes Error;
    LaneMask Forward;
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

  /// The part of four rows inside the faces so far.
  struct RowLanes
  {
    Lanes Begin;
    Lanes End;
    LaneMask Certain;
  };

  /// `first` has the box's first column and the coordinates of its first row.
  [[gnu::always_inline]] void prepareCut(
    int i, const Corner& first, Lanes rows, Lanes layers, Lanes& worst)
  {
    // A position has seven roundings of 2^-24 of these numbers; this allows for eight.
    constexpr double roundings = 0x1p-21;
    // With a larger error single precision decides too few rows.
    constexpr double useless = 0.25;
    const Face& face = this->Faces[i];
    const Lanes position =
      face.Position - (face.PerY * (first.y - face.AY) + face.PerZ * (first.z - face.AZ)) - first.x;
    const Lanes perRow = face.PerY * this->Y.delta();
    const Lanes perLayer = face.PerZ * this->Z.delta();
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

  [[gnu::always_inline]] void cut(
    RowLanes& rows, Lanes first, Lanes last, Lanes crossing, Lanes error, LaneMask forward) const
  {
    const Lanes position = this->X.clamp(crossing);
    const Lanes before = whole(position);
    const LaneMask sure = AxisLanes::certain(position, before, error);
    rows.Certain &= sure;
    rows.Begin = most((sure & forward) ? before : first, rows.Begin);
    rows.End = least((sure & ~forward) ? before : last, rows.End);
  }

  /// Not a lambda, which would not be compiled for the caller's instruction set.
  [[gnu::always_inline]] static Lanes minor(const Corner& a, const Corner& b)
  {
    return a.x * b.y - b.x * a.y;
  }

  [[gnu::always_inline]] void setSamples(const Corner (&corners)[4], const Corner& size,
    const RangeLanes& columns, const RangeLanes& rows, const RangeLanes& layers)
  {
    const Corner sample{ this->X.coordinates(columns.Begin), this->Y.coordinates(rows.Begin),
      this->Z.coordinates(layers.Begin) };
    Corner p[4];
    for (int i = 0; i < 4; ++i)
    {
      p[i] = { corners[i].x - sample.x, corners[i].y - sample.y, corners[i].z - sample.z };
    }
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

  [[gnu::always_inline]] static Lanes leastOf(const Corner (&c)[4], Lanes Corner::*axis)
  {
    return least(least(c[0].*axis, c[1].*axis), least(c[2].*axis, c[3].*axis));
  }
  [[gnu::always_inline]] static Lanes mostOf(const Corner (&c)[4], Lanes Corner::*axis)
  {
    return most(most(c[0].*axis, c[1].*axis), most(c[2].*axis, c[3].*axis));
  }

  [[gnu::always_inline]] static void store(const RangeLanes& from, IndexRange (&to)[laneCount])
  {
    const LaneInts begins = toInts(from.Begin);
    const LaneInts ends = toInts(from.End);
    for (int lane = 0; lane < laneCount; ++lane)
    {
      to[lane] = { begins[lane], ends[lane] };
    }
  }

  /// orientation3() with its filter; reorders corners so that all orientations are positive, as in
  /// VTK.
  [[gnu::always_inline]] void orient(Corner (&p)[4])
  {
    const Corner& d = p[3];
    const Corner a{ p[0].x - d.x, p[0].y - d.y, p[0].z - d.z };
    const Corner b{ p[1].x - d.x, p[1].y - d.y, p[1].z - d.z };
    const Corner c{ p[2].x - d.x, p[2].y - d.y, p[2].z - d.z };
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
    const Corner first = p[0];
    p[0] = { swap ? p[1].x : first.x, swap ? p[1].y : first.y, swap ? p[1].z : first.z };
    p[1] = { swap ? first.x : p[1].x, swap ? first.y : p[1].y, swap ? first.z : p[1].z };
  }

  [[gnu::always_inline]] void setFace(
    int i, const Corner& a, const Corner& b, const Corner& c, const Corner& size, Lanes columnError)
  {
    constexpr double roundings = LatticeAxis::Roundings;
    const Corner u{ b.x - a.x, b.y - a.y, b.z - a.z };
    const Corner v{ c.x - a.x, c.y - a.y, c.z - a.z };
    const Lanes nx = u.y * v.z - u.z * v.y;
    const Lanes ny = u.z * v.x - u.x * v.z;
    const Lanes nz = u.x * v.y - u.y * v.x;
    const Lanes scale = this->X.inverse() / nx;
    Face& face = this->Faces[i];
    face.Position = (a.x - this->X.origin()) * this->X.inverse() - this->X.firstIndex() + 1;
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

} // namespace tipp

#endif

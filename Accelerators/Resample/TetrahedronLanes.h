// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedronLanes_h
#define tippTetrahedronLanes_h

#include "Resample/Lanes.h"
#include "Resample/TetrahedronRows.h"

namespace tipp
{

/// TetrahedronRows for four tetrahedra at a time, as far as rounding does not matter.
class TetrahedronLanes
{
public:
  TetrahedronLanes(const LatticeAxis& x, const LatticeAxis& y, const LatticeAxis& z)
    : X(x)
    , Y(y)
    , Z(z)
  {
  }

  /// Takes the cells from `first` on.
  template <typename Access>
  [[gnu::always_inline]] void set(const Access& cells, std::int64_t first)
  {
    Point3 p[laneCount][4];
    for (int lane = 0; lane < laneCount; ++lane)
    {
      cells.corners(first + lane, p[lane]);
    }
    Corner corners[4] = {};
    for (int i = 0; i < 4; ++i)
    {
      corners[i].x = Lanes{ p[0][i].x, p[1][i].x, p[2][i].x, p[3][i].x };
      corners[i].y = Lanes{ p[0][i].y, p[1][i].y, p[2][i].y, p[3][i].y };
      corners[i].z = Lanes{ p[0][i].z, p[1][i].z, p[2][i].z, p[3][i].z };
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
    this->Nothing = columns.Empty | rows.Empty | layers.Empty;
    this->Fast = columns.Certain & rows.Certain & layers.Certain;
    if (!any(~this->Nothing))
    {
      return;
    }
    store(columns, this->Columns);
    store(rows, this->Rows);
    store(layers, this->Layers);
    this->orient(corners);
    const Corner size{ right - left, back - front, high - low };
    this->setFace(0, corners[1], corners[3], corners[2], size, columns.Error);
    this->setFace(1, corners[0], corners[2], corners[3], size, columns.Error);
    this->setFace(2, corners[0], corners[3], corners[1], size, columns.Error);
    this->setFace(3, corners[0], corners[1], corners[2], size, columns.Error);
  }

  /// Whether the tetrahedron's box certainly has no sample.
  bool nothing(int lane) const { return this->Nothing[lane] != 0; }
  /// Whether the tetrahedron is finite and has a volume, and its box is as told.
  bool fast(int lane) const { return this->Fast[lane] != 0; }

  IndexRange columns(int lane) const { return this->Columns[lane]; }
  IndexRange rows(int lane) const { return this->Rows[lane]; }
  IndexRange layers(int lane) const { return this->Layers[lane]; }

  /// Whether the boxes of all that have samples hold one row, as told: then singleRows() is faster.
  bool haveSingleRows() const
  {
    bool single = any(~this->Nothing);
    for (int lane = 0; lane < laneCount; ++lane)
    {
      const bool one = this->Rows[lane].size() == 1 && this->Layers[lane].size() == 1;
      single = single && (this->nothing(lane) || (one && this->fast(lane)));
    }
    return single;
  }

  /// The row of each tetrahedron's box; Doubtful has a bit for each that is to be asked exactly.
  [[gnu::always_inline]] SpanLanes singleRows() const
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
    RowLanes rows{ first, last, LaneTruths{} - 1 };
    for (const Face& face : this->Faces)
    {
      this->cut(rows, first, last,
        face.Place - (face.PerY * (y - face.AY) + face.PerZ * (z - face.AZ)), face.Error,
        face.Forward);
    }
    return rows.spans(~this->Nothing);
  }

  /// The rows row..row + count - 1, at most four, of a fast tetrahedron.
  [[gnu::always_inline]] SpanLanes spans(int lane, int row, int count, int layer) const
  {
    const Lanes y = this->Y.coordinates(row);
    const double z = this->Z.coordinate(layer);
    const Lanes first = allLanes(this->Columns[lane].Begin);
    const Lanes last = allLanes(this->Columns[lane].End);
    RowLanes rows{ first, last, LaneTruths{} - 1 };
    for (const Face& face : this->Faces)
    {
      this->cut(rows, first, last,
        face.Place[lane] -
          (face.PerY[lane] * (y - face.AY[lane]) + face.PerZ[lane] * (z - face.AZ[lane])),
        allLanes(face.Error[lane]), LaneTruths{} + face.Forward[lane]);
    }
    return rows.spans(firstLanes(count));
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
    Lanes Place;
    Lanes PerY;
    Lanes PerZ;
    Lanes AY;
    Lanes AZ;
    Lanes Error;
    LaneTruths Forward;
  };

  /// What faces have left of four rows.
  struct RowLanes
  {
    [[gnu::always_inline]] SpanLanes spans(LaneTruths wanted) const
    {
      const LaneTruths open = (this->Begin < this->End) & wanted;
      SpanLanes spans;
      // What is in doubt matters only where the other faces leave something.
      spans.Doubtful = laneBits(~this->Certain & open);
      spans.Certain = spans.Doubtful == 0;
      spans.set(this->Begin, this->End, open);
      return spans;
    }

    Lanes Begin;
    Lanes End;
    LaneTruths Certain;
  };

  [[gnu::always_inline]] void cut(
    RowLanes& rows, Lanes first, Lanes last, Lanes crossing, Lanes error, LaneTruths forward) const
  {
    const Lanes place = this->X.clamp(crossing);
    const Lanes before = whole(place);
    const LaneTruths sure = AxisLanes::certain(place, before, error);
    rows.Certain &= sure;
    rows.Begin = most((sure & forward) ? before : first, rows.Begin);
    rows.End = least((sure & ~forward) ? before : last, rows.End);
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
    const LaneInts begins = __builtin_convertvector(from.Begin, LaneInts);
    const LaneInts ends = __builtin_convertvector(from.End, LaneInts);
    for (int lane = 0; lane < laneCount; ++lane)
    {
      to[lane] = { begins[lane], ends[lane] };
    }
  }

  /// orientation3() with its filter; makes all turn like VTK's.
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
    // Beside NaN and infinity this is false.
    this->Fast &= absolute(minus) > bound;
    const LaneTruths swap = minus > 0;
    const Corner first = p[0];
    p[0] = { swap ? p[1].x : first.x, swap ? p[1].y : first.y, swap ? p[1].z : first.z };
    p[1] = { swap ? first.x : p[1].x, swap ? first.y : p[1].y, swap ? first.z : p[1].z };
  }

  [[gnu::always_inline]] void setFace(
    int i, const Corner& a, const Corner& b, const Corner& c, const Corner& size, Lanes columnError)
  {
    constexpr double roundings = LatticeAxis::Roundings;
    constexpr double smallest = 1e-280; // keeps clear of underflow
    const Corner u{ b.x - a.x, b.y - a.y, b.z - a.z };
    const Corner v{ c.x - a.x, c.y - a.y, c.z - a.z };
    const Lanes nx = u.y * v.z - u.z * v.y;
    const Lanes ny = u.z * v.x - u.x * v.z;
    const Lanes nz = u.x * v.y - u.y * v.x;
    const Lanes scale = this->X.inverse() / nx;
    Face& face = this->Faces[i];
    face.Place = (a.x - this->X.origin()) * this->X.inverse() - this->X.firstIndex() + 1;
    face.PerY = ny * scale;
    face.PerZ = nz * scale;
    face.AY = a.y;
    face.AZ = a.z;
    face.Forward = nx > 0;
    const Lanes area = roundings * size.y * size.z;
    const Lanes error = columnError + (area * size.x + smallest) * absolute(scale);
    const LaneTruths good = (absolute(nx) > area + smallest) &
      (error + absolute(face.PerY) + absolute(face.PerZ) < HUGE_VAL);
    face.Error = good ? error : allLanes(HUGE_VAL);
  }

  AxisLanes X;
  AxisLanes Y;
  AxisLanes Z;
  LaneTruths Nothing;
  LaneTruths Fast;
  Face Faces[4];
  IndexRange Columns[laneCount];
  IndexRange Rows[laneCount];
  IndexRange Layers[laneCount];
};

} // namespace tipp

#endif

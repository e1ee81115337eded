// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellRows_h
#define tippCellRows_h

#include "Predicates/ExactPredicates3.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
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
  explicit TriangleRows(const LatticeAxes& axes)
    : U(axes.U)
    , V(axes.V)
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

  static void lowFirst(Point2& a, Point2& b)
  {
    if (b.y < a.y)
    {
      std::swap(a, b);
    }
  }

  [[gnu::always_inline]] bool setEdges(Point2 a, Point2 b, Point2 c)
  {
    // NaN if a coordinate is infinite or NaN, or if a difference overflows.
    const double width = (b.x - a.x) + (c.x - a.x) + (c.y - a.y);
    const int side =
      width - width == 0 || (isFinite(a) && isFinite(b) && isFinite(c)) ? orientation(a, c, b) : 0;
    this->LongIsLeft = side < 0;
    this->Middle = b.y;
    this->Long = edge(a, c);
    this->Short[0] = edge(a, b); // unused if level: no row is below b then
    this->Short[1] = edge(b, c); // unused if level: no row is above b then
    // A slope that is infinite or NaN gives no estimate, so exact tests decide all crossings.
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

/// The samples of a lattice that a tetrahedron claims after the move by (e, e^2, e^3).
///
/// A row along x crosses the planes of the four faces. The samples strictly before a plane are
/// counted by evaluating the crossing or, if rounding could change the count, by an exact
/// predicate: see TriangleRows.
class TetrahedronRows
{
public:
  explicit TetrahedronRows(const LatticeAxes& axes)
    : X(axes.U)
    , Y(axes.V)
    , Z(axes.W)
  {
  }

  /// Sets the tetrahedron. Returns whether its box has a sample and it is finite and not flat.
  [[gnu::always_inline]] bool set(const Point3 (&corners)[4])
  {
    const Point3& a = corners[0];
    const Point3& b = corners[1];
    const Point3& c = corners[2];
    const Point3& d = corners[3];
    const double left = least(a.x, b.x, c.x, d.x);
    const double right = most(a.x, b.x, c.x, d.x);
    this->Reach = std::max(-left, right);
    this->Columns = this->X.range(left, right, this->X.error(this->Reach));
    const double front = least(a.y, b.y, c.y, d.y);
    const double back = most(a.y, b.y, c.y, d.y);
    this->Rows = this->Y.range(front, back, this->Y.error(std::max(-front, back)));
    const double low = least(a.z, b.z, c.z, d.z);
    const double high = most(a.z, b.z, c.z, d.z);
    this->Layers = this->Z.range(low, high, this->Z.error(std::max(-low, high)));
    if ((int(this->Columns.empty()) | int(this->Rows.empty()) | int(this->Layers.empty())) != 0)
    {
      return false;
    }
    return this->setFaces(corners, right - left, back - front, high - low);
  }

  IndexRange columns() const { return this->Columns; }
  IndexRange rows() const { return this->Rows; }
  IndexRange layers() const { return this->Layers; }

  RowSpan span(int row, int layer) const
  {
    const double y = this->Y[row];
    const double z = this->Z[layer];
    RowSpan span{ this->Columns.Begin, this->Columns.End, this->Columns.End };
    for (const Face& face : this->Faces)
    {
      face.Direction == 0 ? this->cutLevel(face, y, z, span) : this->cut(face, y, z, span);
      if (span.Begin >= span.ClosedEnd)
      {
        break;
      }
    }
    return span;
  }

  std::int64_t exactTests() const { return this->ExactTests; }

private:
  /// The plane of a face; a, b, c are counter-clockwise seen from inside.
  struct Face
  {
    Point3 A;
    Point3 B;
    Point3 C;
    double Position; ///< where the plane crosses the row through A, in steps
    double PerY;     ///< by how many steps the crossing moves back per unit of y; PerZ: of z
    double PerZ;
    double Error;
    int Direction; ///< sign of the inner normal's x
  };

  static double least(double a, double b, double c, double d)
  {
    return std::min(std::min(a, b), std::min(c, d));
  }
  static double most(double a, double b, double c, double d)
  {
    return std::max(std::max(a, b), std::max(c, d));
  }

  bool setFaces(const Point3 (&corners)[4], double width, double depth, double height)
  {
    Point3 a = corners[0];
    Point3 b = corners[1];
    const Point3 c = corners[2];
    const Point3 d = corners[3];
    if (!isFinite(a) || !isFinite(b) || !isFinite(c) || !isFinite(d))
    {
      return false;
    }
    const int side = orientation3(a, b, c, d);
    if (side == 0)
    {
      return false;
    }
    if (side < 0)
    {
      std::swap(a, b);
    }
    this->setFace(0, b, d, c, width, depth, height);
    this->setFace(1, a, c, d, width, depth, height);
    this->setFace(2, a, d, b, width, depth, height);
    this->setFace(3, a, b, c, width, depth, height);
    return true;
  }

  void setFace(int i, Point3 a, Point3 b, Point3 c, double width, double depth, double height)
  {
    // Within the cell's box every product of a plane's equation is at most twice the box's volume.
    // There are fewer than 32 roundings of those; 64 are allowed for.
    constexpr double roundings = LatticeAxis::Roundings;
    constexpr double smallest = 1e-280; // keeps clear of underflow
    Face& face = this->Faces[i];
    face.A = a;
    face.B = b;
    face.C = c;
    const auto [ux, uy, uz] = b - a;
    const auto [vx, vy, vz] = c - a;
    const double nx = uy * vz - uz * vy;
    const double ny = uz * vx - ux * vz;
    const double nz = ux * vy - uy * vx;
    const double scale = this->X.Inverse / nx;
    face.Position = (a.x - this->X.Origin) * this->X.Inverse - this->X.First + 1;
    face.PerY = ny * scale;
    face.PerZ = nz * scale;
    if (std::fabs(nx) > roundings * depth * height + smallest)
    {
      face.Direction = nx > 0 ? 1 : -1;
      face.Error = this->X.error(this->Reach) +
        (roundings * width * depth * height + smallest) * std::fabs(scale);
      face.Error = std::isfinite(face.Error + face.PerY + face.PerZ) ? face.Error : HUGE_VAL;
    }
    else
    {
      face.Direction = orientation({ a.y, a.z }, { b.y, b.z }, { c.y, c.z });
      face.Error = HUGE_VAL;
    }
  }

  /// Removes the samples outside a face from the row.
  void cut(const Face& face, double y, double z, RowSpan& span) const
  {
    const double position =
      this->X.clamp(face.Position - (face.PerY * (y - face.A.y) + face.PerZ * (z - face.A.z)));
    // Inner samples have a positive sign: before a face that looks forward they have a negative
    // one.
    const RowCrossing crossing = this->X.crossing(position, face.Error, this->Columns,
      [&](int i)
      {
        ++this->ExactTests;
        return -face.Direction * orientation3(face.A, face.B, face.C, { this->X[i], y, z });
      });
    if (face.Direction > 0)
    {
      span.Begin = std::max(span.Begin, crossing.Before);
    }
    else
    {
      span.End = std::min(span.End, crossing.Before);
      span.ClosedEnd = std::min(span.ClosedEnd, crossing.WithOn);
    }
  }

  /// Removes the samples outside a face that is parallel to x from the row: all of them or none.
  void cutLevel(const Face& face, double y, double z, RowSpan& span) const
  {
    ++this->ExactTests;
    const int side = orientation3(face.A, face.B, face.C, { face.A.x, y, z });
    // The symbolic move goes along y first, then along z.
    const int ny = side == 0
      ? orientation({ face.A.z, face.A.x }, { face.B.z, face.B.x }, { face.C.z, face.C.x })
      : 0;
    const int nz = side == 0 && ny == 0
      ? orientation({ face.A.x, face.A.y }, { face.B.x, face.B.y }, { face.C.x, face.C.y })
      : 0;
    if (side < 0)
    {
      span.End = span.ClosedEnd = span.Begin;
    }
    else if (side == 0 && (ny < 0 || (ny == 0 && nz < 0)))
    {
      span.End = this->Columns.Begin; // empty, whatever the other faces set Begin to
    }
  }

  const LatticeAxis& X;
  const LatticeAxis& Y;
  const LatticeAxis& Z;
  Face Faces[4];
  double Reach;
  IndexRange Columns;
  IndexRange Rows;
  IndexRange Layers;
  mutable std::int64_t ExactTests = 0;
};

template <int Dimension>
using CellRows = std::conditional_t<Dimension == 2, TriangleRows, TetrahedronRows>;

} // namespace tipp

#endif

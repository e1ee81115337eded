// SPDX-License-Identifier: BSD-3-Clause
#include "Locate/CellLocator.h"

#include "Predicates/ExactPredicates3.h"
#include "Predicates/Fraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tipp
{
namespace
{

template <typename Number, std::size_t D>
using Vector = std::array<Number, D>;

template <typename Number, std::size_t D>
Vector<Number, D> minus(const Vector<Number, D>& a, const Vector<Number, D>& b)
{
  Vector<Number, D> result;
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    result[axis] = a[axis] - b[axis];
  }
  return result;
}

template <typename Number, std::size_t D>
Number dot(const Vector<Number, D>& a, const Vector<Number, D>& b)
{
  Number sum = a[0] * b[0];
  for (std::size_t axis = 1; axis < D; ++axis)
  {
    sum += a[axis] * b[axis];
  }
  return sum;
}

template <typename Number, std::size_t D>
Vector<Number, D> between(
  const Vector<Number, D>& a, const Vector<Number, D>& direction, const Number& share)
{
  Vector<Number, D> result = a;
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    result[axis] += share * direction[axis];
  }
  return result;
}

template <typename Number>
Vector<Number, 2> nearestOfFace(
  const Vector<Number, 2>& p, const Vector<Number, 2>& a, const Vector<Number, 2>& b)
{
  const Vector<Number, 2> edge = minus(b, a);
  const Number along = dot(edge, minus(p, a));
  const Number length = dot(edge, edge);
  if (along <= 0)
  {
    return a;
  }
  return along >= length ? b : between(a, edge, Number(along / length));
}

/// Ericson, Real-Time Collision Detection, 2005, section 5.1.5.
template <typename Number>
Vector<Number, 3> nearestOfFace(const Vector<Number, 3>& p, const Vector<Number, 3>& a,
  const Vector<Number, 3>& b, const Vector<Number, 3>& c)
{
  const Vector<Number, 3> ab = minus(b, a);
  const Vector<Number, 3> ac = minus(c, a);
  const Number abA = dot(ab, minus(p, a));
  const Number acA = dot(ac, minus(p, a));
  const Number abB = dot(ab, minus(p, b));
  const Number acB = dot(ac, minus(p, b));
  const Number abC = dot(ab, minus(p, c));
  const Number acC = dot(ac, minus(p, c));
  if (abA <= 0 && acA <= 0)
  {
    return a;
  }
  if (abB >= 0 && acB <= abB)
  {
    return b;
  }
  const Number ofC = abA * acB - abB * acA;
  if (ofC <= 0 && abA >= 0 && abB <= 0)
  {
    return between(a, ab, Number(abA / (abA - abB)));
  }
  if (acC >= 0 && abC <= acC)
  {
    return c;
  }
  const Number ofB = abC * acA - abA * acC;
  if (ofB <= 0 && acA >= 0 && acC <= 0)
  {
    return between(a, ac, Number(acA / (acA - acC)));
  }
  const Number ofA = abB * acC - abC * acB;
  const Number toC = acB - abB;
  const Number toB = abC - acC;
  if (ofA <= 0 && toC >= 0 && toB >= 0)
  {
    return between(b, minus(c, b), Number(toC / (toC + toB)));
  }
  const Number sum = ofA + ofB + ofC;
  return between(between(a, ab, Number(ofB / sum)), ac, Number(ofC / sum));
}

template <typename Number, std::size_t D>
Vector<Number, D> vectorOf(const Point3& p)
{
  Vector<Number, D> result;
  for (std::size_t axis = 0; axis < D; ++axis)
  {
    result[axis] = p[axis];
  }
  return result;
}

template <typename Number, std::size_t D>
struct Nearest
{
  Number Squared{};
  Vector<Number, D> At{};
};

/// The location on a cell's faces that is nearest to a point.
template <typename Number, std::size_t D>
Nearest<Number, D> nearestOf(const NearCell& cell, const Point3& from)
{
  const Vector<Number, D> p = vectorOf<Number, D>(from);
  Nearest<Number, D> best;
  for (std::size_t face = 0; face <= D; ++face)
  {
    const auto corner = [&](std::size_t i)
    { return vectorOf<Number, D>(cell.Corners[(face + i) % (D + 1)]); };
    Vector<Number, D> at;
    if constexpr (D == 2)
    {
      at = nearestOfFace(p, corner(0), corner(1));
    }
    else
    {
      at = nearestOfFace(p, corner(0), corner(1), corner(2));
    }
    const Vector<Number, D> apart = minus(p, at);
    Number squared = dot(apart, apart);
    if (face == 0 || squared < best.Squared)
    {
      std::swap(best.Squared, squared);
      best.At = at;
    }
  }
  return best;
}

double largestOf(const Point3& p)
{
  return std::max({ std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
}

Point3 pointOf(const Vector<double, 2>& v)
{
  return { v[0], v[1], 0 };
}
Point3 pointOf(const Vector<double, 3>& v)
{
  return { v[0], v[1], v[2] };
}

/// Any location of the cell gives an upper bound, even a rounded one. The plane through it,
/// perpendicular to the line to the point, gives a lower bound: all corners lie behind that plane.
template <std::size_t D>
void bound(NearCell& cell, const Point3& from)
{
  double largest = largestOf(from);
  for (std::size_t i = 0; i <= D; ++i)
  {
    largest = std::max(largest, largestOf(cell.Corners[i]));
  }
  const Nearest<double, D> nearest = nearestOf<double, D>(cell, from);
  const Vector<double, D> p = vectorOf<double, D>(from);
  const Vector<double, D> apart = minus(p, nearest.At);
  const double distance = std::sqrt(dot(apart, apart));
  cell.At = pointOf(nearest.At);
  cell.Low = 0;
  cell.High = HUGE_VAL;
  // Within these limits squares do not overflow, and underflow stays below the error bound.
  if (!(largest < 1e140 && largest > 1e-140 && distance >= 0))
  {
    return;
  }
  const double error = 64 * 0x1p-53 * largest;
  double low = HUGE_VAL;
  for (std::size_t i = 0; i <= D; ++i)
  {
    low = std::min(low, dot(apart, minus(p, vectorOf<double, D>(cell.Corners[i]))) / distance);
  }
  cell.Low = distance > 0 ? std::max(low - error, 0.0) : 0;
  cell.High = distance + error;
}

/// Whether the location found is certainly one of the cell's corners, and so exact.
bool isCorner(const NearCell& cell, const Point3& from)
{
  double margin = 0;
  double least = HUGE_VAL;
  bool isOne = false;
  for (int i = 0; i <= cell.Dimension; ++i)
  {
    isOne = isOne || cell.Corners[i] == cell.At;
    if (cell.Corners[i] == cell.At)
    {
      continue;
    }
    const Point3 a = from - cell.At;
    const Point3 b = cell.At - cell.Corners[i];
    least = std::min(least, a.x * b.x + a.y * b.y + a.z * b.z);
    margin = std::max(margin, std::fabs(a.x * b.x) + std::fabs(a.y * b.y) + std::fabs(a.z * b.z));
  }
  return isOne && least > margin * 1e-14 + 1e-300;
}

} // namespace

void NearCell::measure(const Point3& from)
{
  this->Dimension == 2 ? bound<2>(*this, from) : bound<3>(*this, from);
}

bool NearCell::isBetterThan(const NearCell& other, const Point3& from) const
{
  if (other.Id < 0 || this->High < other.Low)
  {
    return true;
  }
  if (this->Low > other.High)
  {
    return false;
  }
  if (std::equal(this->Corners, this->Corners + this->Dimension + 1, other.Corners))
  {
    return this->Id < other.Id;
  }
  if (this->At == other.At && isCorner(*this, from) && isCorner(other, from))
  {
    return this->Id < other.Id;
  }
  const auto square = [&from](const NearCell& cell)
  {
    return cell.Dimension == 2 ? nearestOf<Fraction, 2>(cell, from).Squared
                               : nearestOf<Fraction, 3>(cell, from).Squared;
  };
  const int order = compare(square(*this), square(other));
  return order < 0 || (order == 0 && this->Id < other.Id);
}

double NearCell::distance(const Point3& from)
{
  constexpr double accuracy = 1e-9;
  if (std::isfinite(this->High) && this->High - this->Low <= accuracy * this->High)
  {
    const Point3 apart = from - this->At;
    return this->Dimension == 2 ? std::hypot(apart.x, apart.y)
                                : std::hypot(apart.x, apart.y, apart.z);
  }
  const auto exact = [&](auto nearest)
  {
    Vector<double, nearest.At.size()> at;
    std::transform(nearest.At.begin(), nearest.At.end(), at.begin(),
      [](const Fraction& coordinate) { return coordinate.value(); });
    this->At = pointOf(at);
    return nearest.Squared.root();
  };
  return this->Dimension == 2 ? exact(nearestOf<Fraction, 2>(*this, from))
                              : exact(nearestOf<Fraction, 3>(*this, from));
}

void CellLocator::findNearest(const Point3& point, NearCell& best) const
{
  withAccess(this->Mesh,
    [&](const auto& access)
    {
      constexpr int D = std::decay_t<decltype(access)>::Dimension;
      const auto placed = [this](const Point3& p) {
        return D == 3 ? p : Point3{ p[this->Mesh.Axes[0]], p[this->Mesh.Axes[1]], 0 };
      };
      const Point3 from = placed(point);
      NearCell cell;
      cell.Dimension = D;
      this->tree<D>().searchNear(projected<D>(from),
        [&](std::int32_t index)
        {
          for (int i = 0; i <= D; ++i)
          {
            cell.Corners[i] = placed(access.point(access.ids(index)[i]));
          }
          const auto& [a, b, c, d] = cell.Corners;
          const int side = D == 3 ? orientation3(a, b, c, d)
                                  : orientation({ a.x, a.y }, { b.x, b.y }, { c.x, c.y });
          if (side != 0)
          {
            cell.Id = this->CellIds ? this->CellIds[index] : index;
            cell.measure(from);
            best = cell.isBetterThan(best, from) ? cell : best;
          }
          return best.High;
        });
    });
}

} // namespace tipp

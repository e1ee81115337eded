// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDegenerateCells_h
#define tippDegenerateCells_h

#include "Predicates/Geometry.h"

#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>

/// A cell and a box that touch each other, or almost do. In the plane, z is 0.
struct CellAndBox
{
  std::array<tipp::Point3, 4> Corners;
  tipp::Box3 Box;
};

inline void PrintTo(const CellAndBox& scene, std::ostream* out)
{
  *out << std::hexfloat;
  for (const tipp::Point3& p : scene.Corners)
  {
    *out << "(" << p.x << ", " << p.y << ", " << p.z << ") ";
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    *out << "[" << scene.Box.Min[axis] << ", " << scene.Box.Max[axis] << "] ";
  }
  *out << std::defaultfloat;
}

/// Draws degenerate cells and boxes. The same seed gives the same ones.
class DegenerateCells
{
public:
  DegenerateCells(unsigned seed, int dimension)
    : Engine(seed)
    , Dimension(dimension)
  {
  }

  /// All coordinates are nodes of a small lattice, so cells and boxes often touch, and some are
  /// flat.
  CellAndBox onLattice(int size, double step, double offset)
  {
    return this->scene([&] { return offset + step * this->integer(0, size - 1); });
  }

  /// As onLattice(), but about half of the coordinates are moved by up to two ulps.
  CellAndBox besideLattice(int size, double step, double offset)
  {
    return this->scene([&] { return this->nudged(offset + step * this->integer(0, size - 1)); });
  }

  /// A corner of the box lies on an edge or a face of the cell, up to rounding.
  CellAndBox cornerByTheCell()
  {
    CellAndBox result = this->scene([&] { return this->real(-1.0, 1.0); });
    const auto& p = result.Corners;
    const double s = this->real(0.0, 1.0);
    const double t = this->integer(0, 1) * this->real(0.0, 1.0 - s);
    const auto mix = [&](double a, double b, double c) { return a + s * (b - a) + t * (c - a); };
    const std::array<double, 3> corner = { mix(p[0].x, p[1].x, p[2].x), mix(p[0].y, p[1].y, p[2].y),
      mix(p[0].z, p[1].z, p[2].z) };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double near = this->nudged(corner[axis]);
      const bool below = this->integer(0, 1) != 0;
      const double far = near + (below ? -1.0 : 1.0) * this->integer(0, 2) * this->real(0.0, 1.0);
      result.Box.Min[axis] = std::min(near, far);
      result.Box.Max[axis] = std::max(near, far);
    }
    this->flatten(result);
    return result;
  }

  /// Every coordinate has its own exponent, between the two given ones.
  CellAndBox mixedExponents(int lowest, int highest)
  {
    return this->scene(
      [&] { return std::ldexp(this->real(-1.0, 1.0), this->integer(lowest, highest)); });
  }

  int integer(int low, int high)
  {
    return std::uniform_int_distribution<int>(low, high)(this->Engine);
  }
  double real(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Engine);
  }

private:
  template <typename Draw>
  CellAndBox scene(Draw draw)
  {
    CellAndBox result;
    for (tipp::Point3& p : result.Corners)
    {
      p.x = draw();
      p.y = draw();
      p.z = draw();
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double first = draw();
      const double second = draw();
      result.Box.Min[axis] = std::min(first, second);
      result.Box.Max[axis] = std::max(first, second);
    }
    this->flatten(result);
    return result;
  }

  void flatten(CellAndBox& scene) const
  {
    if (this->Dimension == 2)
    {
      for (tipp::Point3& p : scene.Corners)
      {
        p.z = 0.0;
      }
      scene.Box.Min[2] = 0.0;
      scene.Box.Max[2] = 0.0;
    }
  }

  double nudged(double value)
  {
    const int ulps = this->integer(0, 1) * this->integer(-2, 2);
    for (int i = 0; i < std::abs(ulps); ++i)
    {
      value = std::nextafter(value, ulps < 0 ? -HUGE_VAL : HUGE_VAL);
    }
    return value;
  }

  std::mt19937_64 Engine;
  int Dimension;
};

#endif

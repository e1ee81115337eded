// SPDX-License-Identifier: BSD-3-Clause
#include "ExactLocation.h"

#include <CGAL/Gmpq.h>

#include <array>

namespace oracle
{
namespace
{

using Rational = CGAL::Gmpq;
/// A polynomial in the infinitesimal e: the coefficients of 1, e, e^2, e^3.
using Moved = std::array<Rational, 4>;

int signOf(const Moved& number)
{
  for (const Rational& coefficient : number)
  {
    if (coefficient != 0)
    {
      return coefficient > 0 ? 1 : -1;
    }
  }
  return 0;
}

Rational determinant(const std::vector<std::array<Rational, 3>>& rows, int dimension)
{
  if (dimension == 2)
  {
    return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
  }
  return rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1]) -
    rows[0][1] * (rows[1][0] * rows[2][2] - rows[1][2] * rows[2][0]) +
    rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0]);
}

/// The signs of the moved sample's barycentric coordinates, each times the determinant of the cell,
/// and the sign of this determinant. By Cramer's rule: the sample replaces one corner.
class Location
{
public:
  Location(const Scene& scene, int cell, const double* sample, int move)
    : Dimension(scene.Dimension)
  {
    for (int corner = 0; corner <= this->Dimension; ++corner)
    {
      const double* const p = scene.corner(cell, corner);
      this->Corners.push_back({ Rational(p[0]), Rational(p[1]), Rational(p[2]) });
    }
    this->Orientation = CGAL::sign(this->volume(this->Corners));
    for (int corner = 0; corner <= this->Dimension; ++corner)
    {
      this->Signs.push_back(this->coordinateSign(corner, sample, move));
    }
  }

  bool inside() const { return this->all(1); }
  bool closed() const { return this->all(0); }

private:
  bool all(int least) const
  {
    for (const int sign : this->Signs)
    {
      if (this->Orientation == 0 || sign * this->Orientation < least)
      {
        return false;
      }
    }
    return true;
  }

  Rational volume(const std::vector<std::array<Rational, 3>>& corners) const
  {
    std::vector<std::array<Rational, 3>> rows;
    for (int i = 1; i <= this->Dimension; ++i)
    {
      std::array<Rational, 3> row;
      for (int axis = 0; axis < this->Dimension; ++axis)
      {
        row[axis] = corners[i][axis] - corners[0][axis];
      }
      rows.push_back(row);
    }
    return determinant(rows, this->Dimension);
  }

  int coordinateSign(int corner, const double* sample, int move) const
  {
    auto corners = this->Corners;
    for (int axis = 0; axis < this->Dimension; ++axis)
    {
      corners[corner][axis] = Rational(sample[axis]);
    }
    Moved number;
    number[0] = this->volume(corners);
    // The volume is linear in the sample's coordinates. This is its change for a unit step along an
    // axis.
    for (int axis = 0; axis < this->Dimension && move >= 0; ++axis)
    {
      auto stepped = corners;
      stepped[corner][axis] += 1;
      const Rational step = this->volume(stepped) - number[0];
      number[axis + 1] = (move >> axis) & 1 ? -step : step;
    }
    return signOf(number);
  }

  int Dimension;
  std::vector<std::array<Rational, 3>> Corners;
  int Orientation;
  std::vector<int> Signs;
};

} // namespace

std::vector<int> cellsAfterMove(const Scene& scene, const double* sample, int move)
{
  std::vector<int> cells;
  for (int cell = 0; cell < scene.cells(); ++cell)
  {
    if (scene.boxContains(cell, sample) && Location(scene, cell, sample, move).inside())
    {
      cells.push_back(cell);
    }
  }
  return cells;
}

std::vector<int> closedCells(const Scene& scene, const double* sample)
{
  std::vector<int> cells;
  for (int cell = 0; cell < scene.cells(); ++cell)
  {
    if (scene.boxContains(cell, sample) && Location(scene, cell, sample, -1).closed())
    {
      cells.push_back(cell);
    }
  }
  return cells;
}

} // namespace oracle

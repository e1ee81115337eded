// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSizeFunction_h
#define tippSizeFunction_h

#include "Predicates/Geometry.h"
#include "Refinement/MinimumPyramid.h"
#include "Refinement/SizeLattice.h"
#include "vtkTIPPFiltersModule.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tipp
{

/// The target length of edges at each place of the plane, in the units of the coordinates: a
/// constant, or values at the nodes of a lattice, interpolated bilinearly.
///
/// A size h asks for triangles of at most the area of the equilateral triangle, sqrt(3) / 4 h^2. In
/// the geographic plane, sizes in metres become degrees so that this area is right: h / (111,195
/// sqrt(cos latitude)), because a square degree has 111,195^2 cos(latitude) square metres.
///
/// Between nodes: sizes that change by at most g times the distance differ from the interpolated
/// ones by at most g spacing() / sqrt(2). (A place at the fractions u and v of a cell is on
/// average, with the weights of the corners, within spacing() sqrt(u (1 - u) + v (1 - v)) of
/// these.) Without such a limit the interpolated size is still between those of the cell's four
/// nodes.
class VTKTIPPFILTERS_EXPORT SizeFunction
{
public:
  /// The same size everywhere; it must be above 0.
  explicit SizeFunction(double size)
    : Least(size)
  {
  }

  /// Sizes at the lattice's nodes, as lengths of its plane (metres in the geographic one). All must
  /// be above 0 and finite.
  SizeFunction(const SizeLattice& lattice, std::vector<double> sizes);

  /// Returns the size at a point, which may be anywhere: outside of the lattice it is that at the
  /// nearest place of the lattice. Any number of threads may call it. Takes a few nanoseconds, and
  /// allocates nothing.
  double at(Point2 p) const { return this->Sizes.empty() ? this->Least : this->interpolated(p); }

  /// Returns the size for a triangle with this centroid, of which no corner is farther away than
  /// `radius`: that at the centroid, or twice the least one at a node of the lattice within the
  /// triangle's box or a little beyond it, whichever is less. So triangles do not miss a few small
  /// sizes amid large ones.
  double forTriangle(Point2 centroid, double radius) const
  {
    const double size = this->at(centroid);
    return this->Steepest * radius <= size / 2 ? size : this->leastNear(centroid, radius, size);
  }

  /// Returns the least value that at() can return.
  double least() const { return this->Least; }

  /// Returns the larger distance of two neighbouring nodes along x and y, in the units of the
  /// coordinates; 0 for a constant.
  double spacing() const { return this->Spacing; }

private:
  double leastNear(Point2 centroid, double radius, double size) const;

  double interpolated(Point2 p) const
  {
    // With this order of arguments NaN becomes 0.
    const double x = std::min(std::max(0.0, (p.x - this->Low.x) * this->PerUnit.x), this->Last.x);
    const double y = std::min(std::max(0.0, (p.y - this->Low.y) * this->PerUnit.y), this->Last.y);
    const double column = std::min(double(std::size_t(x)), this->Last.x - 1);
    const double row = std::min(double(std::size_t(y)), this->Last.y - 1);
    const double u = x - column;
    const double v = y - row;
    const double* const low =
      this->Sizes.data() + std::size_t(row) * this->Columns + std::size_t(column);
    const double* const high = low + this->Columns;
    const double below = low[0] + u * (low[1] - low[0]);
    const double above = high[0] + u * (high[1] - high[0]);
    return std::max(below + v * (above - below), this->Least);
  }

  std::vector<double> Sizes; ///< by node; empty for a constant
  std::size_t Columns = 0;
  Point2 Low{ 0, 0 };     ///< the first node
  Point2 PerUnit{ 0, 0 }; ///< steps per unit of x and of y
  Point2 Last{ 0, 0 };    ///< index of the last column and row
  double Least;
  double Spacing = 0;
  double Steepest = 0; ///< upper bound of the change of the size with the distance
  MinimumPyramid Minima;
};

} // namespace tipp

#endif

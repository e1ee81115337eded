// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/SizeFunction.h"

#include <cmath>
#include <utility>

namespace tipp
{

SizeFunction::SizeFunction(const SizeLattice& lattice, std::vector<double> sizes)
  : Sizes(std::move(sizes))
  , Columns(std::size_t(lattice.columns()))
  , Low(lattice.at(0, 0))
  , Last{ double(lattice.columns() - 1), double(lattice.rows() - 1) }
{
  const Lattice& nodes = lattice.samples();
  this->PerUnit = { 1 / nodes.Delta[0], 1 / nodes.Delta[1] };
  this->Spacing = std::max(nodes.Delta[0], nodes.Delta[1]);
  for (int row = 0; row < lattice.rows(); ++row)
  {
    const double squareUnit = lattice.unitX(row) * lattice.unitY();
    const double unit = std::sqrt(squareUnit);
    for (int column = 0; column < lattice.columns(); ++column)
    {
      this->Sizes[lattice.index(column, row)] /= unit;
    }
  }
  this->Least = *std::min_element(this->Sizes.begin(), this->Sizes.end());
  this->Minima = MinimumPyramid(this->Sizes.data(), this->Columns, std::size_t(lattice.rows()));
  Point2 most{ 0, 0 };
  for (int row = 0; row < lattice.rows(); ++row)
  {
    for (int column = 0; column < lattice.columns(); ++column)
    {
      const double size = this->Sizes[lattice.index(column, row)];
      const double left = this->Sizes[lattice.index(std::max(column - 1, 0), row)];
      const double below = this->Sizes[lattice.index(column, std::max(row - 1, 0))];
      most = { std::max(most.x, std::fabs(size - left)),
        std::max(most.y, std::fabs(size - below)) };
    }
  }
  this->Steepest = std::hypot(most.x * this->PerUnit.x, most.y * this->PerUnit.y);
}

double SizeFunction::leastNear(Point2 p, double radius, double size) const
{
  const Point2 low{ (p.x - radius - this->Low.x) * this->PerUnit.x,
    (p.y - radius - this->Low.y) * this->PerUnit.y };
  const Point2 high{ (p.x + radius - this->Low.x) * this->PerUnit.x,
    (p.y + radius - this->Low.y) * this->PerUnit.y };
  return std::min(size, 2 * this->Minima.least(low, high));
}

} // namespace tipp

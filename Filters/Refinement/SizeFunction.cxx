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
}

} // namespace tipp

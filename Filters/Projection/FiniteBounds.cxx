// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/FiniteBounds.h"

#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tipp
{

double FiniteBounds::center(int axis) const
{
  return 0.5 * this->Low[axis] + 0.5 * this->High[axis];
}

double FiniteBounds::diagonal() const
{
  return std::hypot(
    this->High[0] - this->Low[0], this->High[1] - this->Low[1], this->High[2] - this->Low[2]);
}

FiniteBounds finiteBounds(vtkPoints* points)
{
  const double infinity = std::numeric_limits<double>::infinity();
  double low0 = infinity, low1 = infinity, low2 = infinity;
  double high0 = -infinity, high1 = -infinity, high2 = -infinity;
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
#pragma omp parallel for reduction(min : low0, low1, low2) reduction(max : high0, high1, high2)
  for (vtkIdType i = 0; i < count; ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))
    {
      low0 = std::min(low0, p[0]);
      low1 = std::min(low1, p[1]);
      low2 = std::min(low2, p[2]);
      high0 = std::max(high0, p[0]);
      high1 = std::max(high1, p[1]);
      high2 = std::max(high2, p[2]);
    }
  }
  return low0 <= high0 ? FiniteBounds{ { low0, low1, low2 }, { high0, high1, high2 } }
                       : FiniteBounds{};
}

} // namespace tipp

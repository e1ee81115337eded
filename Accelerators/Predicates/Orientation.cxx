// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates/Orientation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace tipp
{

int orientation(Point2 a, Point2 b, Point2 c)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_2;
  return static_cast<int>(CGAL::orientation(Point(a.x, a.y), Point(b.x, b.y), Point(c.x, c.y)));
}

} // namespace tipp

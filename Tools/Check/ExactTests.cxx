// SPDX-License-Identifier: BSD-3-Clause
#include "Check/ExactTests.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace tipp
{
namespace check
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_2 point(Position p)
{
  return { p.x, p.y };
}

} // namespace

int turn(Position a, Position b, Position c)
{
  return static_cast<int>(Kernel::Orientation_2()(point(a), point(b), point(c)));
}

int inCircle(Position a, Position b, Position c, Position d)
{
  return static_cast<int>(
    Kernel::Side_of_oriented_circle_2()(point(a), point(b), point(c), point(d)));
}

} // namespace check
} // namespace tipp

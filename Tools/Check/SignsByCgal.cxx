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

Kernel::Point_3 point(const Position3& p)
{
  return { p.x, p.y, p.z };
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

int turn(const Position3& a, const Position3& b, const Position3& c, const Position3& d)
{
  return static_cast<int>(Kernel::Orientation_3()(point(a), point(b), point(c), point(d)));
}

int inSphere(const Position3& a, const Position3& b, const Position3& c, const Position3& d,
  const Position3& e)
{
  return static_cast<int>(
    Kernel::Side_of_oriented_sphere_3()(point(a), point(b), point(c), point(d), point(e)));
}

bool areCollinear(const Position3& a, const Position3& b, const Position3& c)
{
  return Kernel::Collinear_3()(point(a), point(b), point(c));
}

} // namespace check
} // namespace tipp

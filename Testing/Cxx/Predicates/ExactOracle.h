// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippExactOracle_h
#define tippExactOracle_h

#include "Predicates/Geometry.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

// The correct results of the predicates: from CGAL's predicates and constructions over exact
// rationals.
namespace oracle
{

using Rational = CGAL::Gmpq;
using Kernel = CGAL::Simple_cartesian<Rational>;
using Point = Kernel::Point_2;

Point exact(tipp::Point2 p);
int orientation(tipp::Point2 a, tipp::Point2 b, tipp::Point2 c);
int inCircle(tipp::Point2 a, tipp::Point2 b, tipp::Point2 c, tipp::Point2 p);

/// Centre and squared radius of a circle as rationals.
class Disk
{
public:
  Disk(tipp::Point2 a, tipp::Point2 b, tipp::Point2 c);
  bool meets(const tipp::Box2& box) const;
  bool inside(const tipp::Box2& box) const;

private:
  Point Centre;
  Rational Square;
};

} // namespace oracle

#endif

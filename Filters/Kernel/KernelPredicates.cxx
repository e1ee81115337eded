// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/KernelPredicates.h"

#include "Predicates/ExactPredicates.h"

namespace tipp
{
namespace
{

bool isInHalfPlane(Point2 u, Point2 w, Point2 p)
{
  const int side = orientation(u, w, p);
  if (side != 0)
  {
    return side > 0;
  }
  return lexicographicLess(u, w) ? lexicographicLess(u, p) && lexicographicLess(p, w)
                                 : lexicographicLess(w, p) && lexicographicLess(p, u);
}

} // namespace

void KernelPredicates::restart(const Point2* points, std::size_t count)
{
  this->Points = points;
  this->Count = count;
  this->GridIsCurrent = false;
  this->Turns = 0;
}

const CoordinateGrid& KernelPredicates::grid()
{
  if (!this->GridIsCurrent)
  {
    this->Grid.analyse(this->Points + 1, this->Count - 1);
    this->GridIsCurrent = true;
  }
  return this->Grid;
}

int KernelPredicates::orientation(HalfEdgeMesh::Index ia, HalfEdgeMesh::Index ib, Point2 p)
{
  const Point2 a = this->Points[ia];
  const Point2 b = this->Points[ib];
  // Any input makes a few filters fail; the coordinate grid pays only if there are many failures.
  constexpr std::size_t few = 32;
  return ++this->Turns > few ? this->grid().orientation(a, b, p) : orientationExact(a, b, p);
}

bool KernelPredicates::isInConflict(const HalfEdgeMesh::Index* corners, Point2 p)
{
  const Point2 a = this->Points[corners[0]];
  const Point2 b = this->Points[corners[1]];
  const Point2 c = this->Points[corners[2]];
  if (corners[0] == InfiniteVertex)
  {
    return isInHalfPlane(b, c, p);
  }
  if (corners[1] == InfiniteVertex)
  {
    return isInHalfPlane(c, a, p);
  }
  if (corners[2] == InfiniteVertex)
  {
    return isInHalfPlane(a, b, p);
  }
  const int side = this->grid().inCircle(a, b, c, p);
  return side != 0 ? side > 0 : tieIsInside(a, b, c, p);
}

} // namespace tipp

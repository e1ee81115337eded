// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraint_h
#define tippConstraint_h

#include "Triangulation/Triangulate.h"

#include <cstdint>

namespace tipp
{

/// A segment between two points that has to be an edge of the triangulation, or a chain of edges.
struct Constraint
{
  PointId A;
  PointId B;
};

/// A part of a constraint between two points, in the constraint's direction.
struct ConstraintPiece
{
  PointId A;
  PointId B;
  std::int64_t Constraint; ///< its number
};

} // namespace tipp

#endif

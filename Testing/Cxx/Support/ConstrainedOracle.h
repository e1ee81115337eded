// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainedOracle_h
#define tippConstrainedOracle_h

#include "Constraints/ConstraintEdges.h"
#include "DelaunayOracle.h"

#include "Constraints/Insertion/TriangulateConstrained.h"

#include <gtest/gtest.h>

#include <vector>

namespace tipp
{
namespace test
{

/// x and y of the input's points, then of the crossings in the result.
Coordinates withCrossings(const Coordinates& xy, const ConstrainedTriangulation& result);

/// CGAL's Constrained_Delaunay_triangulation_2 of the distinct finite points and of segments that
/// do not cross. Edges that break a tie against the tie rule are flipped. Throws CGAL's
/// Intersection_of_constraints_exception if segments cross.
Triangles constrainedDelaunay(const Coordinates& xy, const std::vector<Constraint>& segments);

/// Whether the result is correct. Every constraint must be a chain of edges from its first point to
/// its second, straight within rounding errors, with all points that lie exactly on it. No crossing
/// may be at a point. The triangles must be the oracle's for all points and the chains' edges.
testing::AssertionResult isConstrained(const Coordinates& xy,
  const std::vector<Constraint>& constraints, const ConstrainedTriangulation& result);

} // namespace test
} // namespace tipp

#endif

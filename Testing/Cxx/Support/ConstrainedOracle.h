// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstrainedOracle_h
#define tippConstrainedOracle_h

#include "DelaunayOracle.h"

#include "Constraints/TriangulateConstrained.h"

#include <gtest/gtest.h>

#include <vector>

namespace tipp
{
namespace test
{

/// The points of the input, then the crossings of a result.
Coordinates withCrossings(const Coordinates& xy, const ConstrainedTriangulation& result);

/// CGAL's Constrained_Delaunay_triangulation_2 of the distinct finite points with segments that do
/// not cross, its edges flipped where a tie is broken against the rule. Throws
/// CGAL's Intersection_of_constraints_exception if they do.
Triangles constrainedDelaunay(const Coordinates& xy, const std::vector<Constraint>& segments);

/// Is the result what it has to be? Every constraint is a chain of edges from its first point to
/// its second that bends by rounding only, and the triangles are the oracle's of all points and the
/// chains' edges.
testing::AssertionResult isConstrained(const Coordinates& xy,
  const std::vector<Constraint>& constraints, const ConstrainedTriangulation& result);

} // namespace test
} // namespace tipp

#endif

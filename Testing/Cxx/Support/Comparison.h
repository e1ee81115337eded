// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippComparison_h
#define tippComparison_h

#include "DelaunayOracle.h"

#include "Triangulation/Triangulate.h"

#include <gtest/gtest.h>

namespace tipp
{
namespace test
{

PointsView view(const Coordinates& xy);

/// The triangles of a result in canonical form, sorted.
Triangles trianglesOf(const Triangulation& result);

/// Whether the result has the reference's triangles, and every point is a vertex, a duplicate or
/// rejected. The failure shows the coordinates of the first difference.
testing::AssertionResult matches(
  const Coordinates& xy, const Triangulation& result, const Reference& expected);

/// Whether two sorted sets of triangles are equal. The failure shows the first difference.
testing::AssertionResult sameTriangles(
  const Coordinates& xy, const Triangles& actual, const Triangles& expected);

/// For messages, for example "2 threads, 8x8 partitions, stages".
std::string describe(const TriangulationOptions& options);

} // namespace test
} // namespace tipp

#endif

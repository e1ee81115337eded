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

/// The triangles of a result, sorted; empty ones too.
Triangles trianglesOf(const Triangulation& result);

/// Is the result the reference: the same triangles, and every point accounted for? Tells the first
/// difference with its coordinates.
testing::AssertionResult matches(
  const Coordinates& xy, const Triangulation& result, const Reference& expected);

/// Are the two sorted sets of triangles the same? Tells the first difference with its coordinates.
testing::AssertionResult sameTriangles(
  const Coordinates& xy, const Triangles& actual, const Triangles& expected);

/// "2 threads, 8x8 partitions, stages".
std::string describe(const TriangulationOptions& options);

} // namespace test
} // namespace tipp

#endif

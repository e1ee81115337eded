// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintCases_h
#define tippConstraintCases_h

#include "Comparison.h"
#include "Constraints/TableConstraints.h"
#include "DegeneratePoints.h"
#include "OutOfCore/OutOfCoreOptions.h"

#include "Constraints/Insertion/TriangulateConstrained.h"
#include "InMemory/TriangulateTable.h"
#include "Points/ReadPoints.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Points, constraints, and options for a triangulation in memory and one out of core.
struct ConstraintCase
{
  Coordinates XY;
  std::vector<double> Heights;
  TableConstraints Constraints;         ///< between ids of points, or between points of their own
  std::vector<std::size_t> PolygonEnds; ///< per polygon of the constraints, after its last edge
  TriangulationOptions Options;
  OutOfCoreOptions OnDisk;

  std::size_t points() const { return this->XY.size() / 2; }
  /// The points, with the column z.
  PointTable table() const;
  std::unique_ptr<PointStream> stream() const;
  void print() const;
};

/// Draws degenerate points, constraints between some of them, sometimes polygons, points exactly on
/// constraints or a unit in the last place beside them, and copies of points.
ConstraintCase drawConstraintCase(Engine& random);

/// A constrained triangulation of all points, made in memory.
struct MadeInMemory
{
  PointTable Points; ///< those of the case, then the constraints' own, then crossings
  ConstrainedTriangulation Result;
  std::string Refused; ///< the message, if crossings or a polygon's point are refused
};

MadeInMemory makeInMemory(const ConstraintCase& drawn);

/// Compares a result in memory with the oracle and the checker of `tipp check`. Polygons are not
/// checked.
testing::AssertionResult isRight(const ConstraintCase& drawn, const MadeInMemory& made);

/// Compares the points, heights and triangles of a mesh in a folder with the result in memory.
testing::AssertionResult isSameMesh(const std::string& path, const MadeInMemory& made);

} // namespace test
} // namespace tipp

#endif

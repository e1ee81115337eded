// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOverlapTesting_h
#define tippOverlapTesting_h

#include "Overlap/AddOverlaps.h"
#include "Predicates/Geometry.h"

#include <cstdint>
#include <gmpxx.h>
#include <vector>

namespace tipp
{
namespace test
{

/// Triangles with a value per cell and per point.
struct ValuedMesh
{
  std::vector<Point3> Points;
  std::vector<std::int64_t> Ids;
  std::vector<double> OfCells;
  std::vector<double> OfPoints;

  std::int64_t cells() const { return std::int64_t(this->Ids.size() / 3); }
  SimplexMesh view() const;
  /// The values of cells, then those of points.
  OverlapSource source() const;
};

/// A triangulation of random points of a square, shifted, and with random values. With `corners`
/// it covers the whole square.
ValuedMesh randomMesh(int points, std::uint64_t seed, bool corners, Point2 shift = { 0, 0 });

/// One triangle with these corners and value.
ValuedMesh oneTriangle(Point2 a, Point2 b, Point2 c, double value);

/// A rational point, and the weights of a triangle's corners there.
struct ExactPoint
{
  mpq_class X;
  mpq_class Y;
  mpq_class Weight[3];
};
using ExactPolygon = std::vector<ExactPoint>;

/// A triangle of a mesh, counter-clockwise; empty if it has no area.
ExactPolygon exactTriangle(const ValuedMesh& mesh, std::int64_t cell);
/// Keeps the part of a polygon that is left of the line from (ax, ay) to (bx, by).
ExactPolygon exactlyClipped(const ExactPolygon& polygon, const mpq_class& ax, const mpq_class& ay,
  const mpq_class& bx, const mpq_class& by);
mpq_class exactArea(const ExactPolygon& polygon);

/// The exact sums of a target: the area, and the integrals of the values of cells and of points.
struct ExactSums
{
  mpq_class Area;
  mpq_class OfCells;
  mpq_class OfPoints;

  void add(const ValuedMesh& mesh, std::int64_t cell, const ExactPolygon& part);
};

/// Expects the sums of a target to be the exact ones up to `error` times `scale`.
void expectNear(const ExactSums& expected, const RunningSum* found, double error);

/// The total of a target sum over all targets, exactly.
mpq_class totalOf(const OverlapSums& sums, int index);

} // namespace test
} // namespace tipp

#endif

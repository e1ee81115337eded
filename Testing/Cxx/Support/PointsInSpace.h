// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointsInSpace_h
#define PointsInSpace_h

#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// The kinds of points that pointsInSpace() makes.
const std::vector<std::string>& kindsOfPoints();

/// About `count` points of a kind, in random order. The same arguments give the same points.
std::vector<Point3> pointsInSpace(const std::string& kind, std::size_t count, unsigned seed = 1);

/// A stream of the points with two columns: z, and number, the index of the point.
std::unique_ptr<PointStream> streamOf(const std::vector<Point3>& points);

using Tetrahedron = std::array<std::int64_t, 4>; ///< point ids, ascending

/// The tetrahedra of a result, sorted.
std::vector<Tetrahedron> sortedCells(const Tetrahedralization& mesh);

/// The tetrahedra of CGAL's Delaunay_triangulation_3, sorted. Equal points have the lowest of their
/// ids.
std::vector<Tetrahedron> cellsOfCgal(const std::vector<Point3>& points);

/// Arrays for the checker: x, y, z of each point in turn, and four ids per tetrahedron.
std::vector<double> coordinatesOf(const std::vector<Point3>& points);
std::vector<std::int64_t> idsOf(const Tetrahedralization& mesh);

} // namespace test
} // namespace tipp

#endif

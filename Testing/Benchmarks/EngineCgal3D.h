// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippEngineCgal3D_h
#define tippEngineCgal3D_h

#include "Predicates/Points.h"

#include <cstddef>
#include <vector>

namespace tipp
{
namespace benchmark
{

/// Triangulates by CGAL's Delaunay_triangulation_3 and writes the corners' indices of all
/// tetrahedra, as tetrahedralize() returns them. Returns their number.
std::size_t tetrahedralizeByCgal(const std::vector<Point3>& points);

} // namespace benchmark
} // namespace tipp

#endif

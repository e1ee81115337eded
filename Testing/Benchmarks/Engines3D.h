// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippEngines3D_h
#define tippEngines3D_h

#include "Predicates/Geometry.h"

#include <cstddef>
#include <vector>

namespace tipp
{
namespace benchmark
{

/// Each function triangulates points in space and returns the number of tetrahedra. Serial CGAL and
/// TetGen also write the point indices of all tetrahedra, as tetrahedralize() does.
///@{
std::size_t tetrahedralizeByCgal(const std::vector<Point3>& points);
std::size_t tetrahedralizeByParallelCgal(const std::vector<Point3>& points);
std::size_t tetrahedralizeByTetgen(const std::vector<Point3>& points);
///@}

} // namespace benchmark
} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Engines3D.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <tbb/global_control.h>

namespace tipp
{
namespace benchmark
{

std::size_t tetrahedralizeByParallelCgal(const std::vector<Point3>& points)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_3<Kernel>;
  using Cell = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_3<Kernel,
    CGAL::Triangulation_data_structure_3<Vertex, Cell, CGAL::Parallel_tag>>;
  constexpr std::size_t threads = 2;
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  CGAL::Bbox_3 box;
  for (const Point3& p : points)
  {
    input.emplace_back(p.x, p.y, p.z);
    box += input.back().bbox();
  }
  constexpr int locksAlongAnAxis = 50; // as in CGAL's example
  Delaunay::Lock_data_structure locks(box, locksAlongAnAxis);
  return Delaunay(input.begin(), input.end(), &locks).number_of_finite_cells();
}

} // namespace benchmark
} // namespace tipp

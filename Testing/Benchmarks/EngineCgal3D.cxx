// SPDX-License-Identifier: BSD-3-Clause
#include "Engines3D.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <cstdint>
#include <utility>

namespace tipp
{
namespace benchmark
{

std::size_t tetrahedralizeByCgal(const std::vector<Point3>& points)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
  using Cell = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
  using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  std::vector<std::pair<Kernel::Point_3, std::uint32_t>> input;
  input.reserve(points.size());
  for (const Point3& p : points)
  {
    input.emplace_back(Kernel::Point_3(p.x, p.y, p.z), std::uint32_t(input.size()));
  }
  const Delaunay delaunay(input.begin(), input.end());
  std::vector<std::uint32_t> ids;
  ids.reserve(4 * delaunay.number_of_finite_cells());
  for (auto cell = delaunay.finite_cells_begin(); cell != delaunay.finite_cells_end(); ++cell)
  {
    for (int i = 0; i < 4; ++i)
    {
      ids.push_back(cell->vertex(i)->info());
    }
  }
  return ids.size() / 4;
}

} // namespace benchmark
} // namespace tipp

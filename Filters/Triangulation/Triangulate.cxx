// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Triangulate.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <cmath>

namespace tipp
{

Triangulation triangulate(PointsView points, const TriangulationOptions&)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<PointId, Kernel>;
  using Structure = CGAL::Triangulation_data_structure_2<Vertex>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

  Triangulation result;
  Delaunay mesh;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Point2 p = points[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
    {
      result.Rejected.push_back(PointId(i));
      continue;
    }
    const std::size_t before = mesh.number_of_vertices();
    auto v = mesh.insert(Kernel::Point_2(p.x, p.y));
    if (mesh.number_of_vertices() == before)
    {
      result.Duplicates.push_back({ PointId(i), v->info() });
      continue;
    }
    v->info() = PointId(i);
  }
  if (mesh.dimension() < 2)
  {
    return result;
  }
  result.Ids32 = Buffer<std::int32_t>(3 * mesh.number_of_faces());
  std::size_t at = 0;
  for (auto face = mesh.finite_faces_begin(); face != mesh.finite_faces_end(); ++face)
  {
    for (int i = 0; i < 3; ++i)
    {
      result.Ids32[at++] = std::int32_t(face->vertex(i)->info());
    }
  }
  result.Statistics.Partitions = 1;
  result.Statistics.Threads = 1;
  return result;
}

} // namespace tipp

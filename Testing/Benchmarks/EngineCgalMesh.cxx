// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace tipp
{
namespace benchmark
{

Run runCgalMesh(
  const std::vector<double>& xy, const std::vector<Constraint>& segments, double angle, double area)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Structure = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_2<Kernel>,
    CGAL::Delaunay_mesh_face_base_2<Kernel>>;
  using Mesh = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure>;
  using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Mesh>;
  Run run;
  const auto start = std::chrono::steady_clock::now();
  Mesh mesh;
  std::vector<Mesh::Vertex_handle> vertices;
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    vertices.push_back(mesh.insert({ xy[i], xy[i + 1] }));
  }
  for (const Constraint& segment : segments)
  {
    mesh.insert_constraint(vertices[std::size_t(segment.A)], vertices[std::size_t(segment.B)]);
  }
  // Its bound is that of the sine's square, and its size the longest edge: that of an equilateral
  // triangle with the largest area.
  const double sine = std::sin(angle * 3.14159265358979323846 / 180);
  CGAL::refine_Delaunay_mesh_2(mesh, Criteria(sine * sine, std::sqrt(area * 4 / std::sqrt(3.0))));
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (auto face = mesh.finite_faces_begin(); face != mesh.finite_faces_end(); ++face)
  {
    run.Triangles += face->is_in_domain();
  }
  return run;
}

} // namespace benchmark
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <utility>

namespace tipp
{
namespace benchmark
{

Run runCgalConstrained(const std::vector<double>& xy, const std::vector<Constraint>& segments)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  points.reserve(xy.size() / 2);
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    points.emplace_back(xy[i], xy[i + 1]);
  }
  std::vector<std::pair<Kernel::Point_2, Kernel::Point_2>> pairs;
  pairs.reserve(segments.size());
  for (const Constraint& segment : segments)
  {
    pairs.emplace_back(points[std::size_t(segment.A)], points[std::size_t(segment.B)]);
  }
  Run run;
  const auto start = std::chrono::steady_clock::now();
  // Segments may coincide, overlap and end on each other, as the segments of shorelines do.
  CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Default,
    CGAL::No_constraint_intersection_requiring_constructions_tag>
    mesh;
  mesh.insert(points.begin(), points.end());
  mesh.insert_constraints(pairs.begin(), pairs.end());
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.Triangles = std::int64_t(mesh.number_of_faces());
  TriangleSum sum;
  for (auto face = mesh.finite_faces_begin(); face != mesh.finite_faces_end(); ++face)
  {
    double p[3][2];
    for (int i = 0; i < 3; ++i)
    {
      p[i][0] = face->vertex(i)->point().x();
      p[i][1] = face->vertex(i)->point().y();
    }
    sum.add(p[0], p[1], p[2]);
  }
  run.Checksum = sum.value();
  return run;
}

} // namespace benchmark
} // namespace tipp

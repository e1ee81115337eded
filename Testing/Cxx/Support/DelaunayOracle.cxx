// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayOracle.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tipp
{
namespace test
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int64_t, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

Kernel::Point_2 point(const Coordinates& xy, std::int64_t id)
{
  return { xy[std::size_t(2 * id)], xy[std::size_t(2 * id + 1)] };
}

/// Whether all points lie on one line. CGAL takes quadratic time for such points.
bool collinear(const Coordinates& xy, const Ids& ids)
{
  return ids.size() < 3 ||
    std::all_of(ids.begin() + 2, ids.end(),
      [&](std::int64_t id)
      { return CGAL::collinear(point(xy, ids[0]), point(xy, ids[1]), point(xy, id)); });
}

Ids representatives(const Coordinates& xy)
{
  Ids byPlace;
  Ids result(xy.size() / 2, -1);
  for (std::int64_t i = 0; i < std::int64_t(result.size()); ++i)
  {
    if (std::isfinite(xy[std::size_t(2 * i)]) && std::isfinite(xy[std::size_t(2 * i + 1)]))
    {
      byPlace.push_back(i);
    }
  }
  const auto place = [&](std::int64_t id)
  { return std::make_tuple(xy[std::size_t(2 * id)], xy[std::size_t(2 * id + 1)]); };
  std::stable_sort(byPlace.begin(), byPlace.end(),
    [&](std::int64_t a, std::int64_t b) { return place(a) < place(b); });
  std::int64_t first = 0;
  for (std::size_t i = 0; i < byPlace.size(); ++i)
  {
    first = i > 0 && place(byPlace[i]) == place(first) ? first : byPlace[i];
    result[std::size_t(byPlace[i])] = first;
  }
  return result;
}

} // namespace

Triangle canonical(std::int64_t a, std::int64_t b, std::int64_t c)
{
  return a < b && a < c ? Triangle{ a, b, c } : (b < c ? Triangle{ b, c, a } : Triangle{ c, a, b });
}

Triangles sorted(Triangles triangles)
{
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

Triangles delaunay(const Coordinates& xy, const Ids& ids)
{
  if (collinear(xy, ids))
  {
    return {};
  }
  std::vector<std::pair<Kernel::Point_2, std::int64_t>> points;
  for (const std::int64_t id : ids)
  {
    points.emplace_back(point(xy, id), id);
  }
  Delaunay mesh;
  mesh.insert(points.begin(), points.end());
  Triangles triangles;
  for (auto face = mesh.finite_faces_begin(); face != mesh.finite_faces_end(); ++face)
  {
    triangles.push_back(
      canonical(face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()));
  }
  return sorted(std::move(triangles));
}

Reference reference(const Coordinates& xy)
{
  Reference result;
  result.Representative = representatives(xy);
  Ids distinct;
  for (std::int64_t i = 0; i < std::int64_t(result.Representative.size()); ++i)
  {
    if (result.Representative[std::size_t(i)] == i)
    {
      distinct.push_back(i);
    }
  }
  result.Mesh = delaunay(xy, distinct);
  return result;
}

} // namespace test
} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKernelTesting_h
#define tippKernelTesting_h

#include "Comparison.h"

#include "Kernel/DelaunayKernel.h"
#include "Predicates/ExactPredicates.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

///@{
/// The next and previous half-edge of h in its triangle, counter-clockwise.
inline HalfEdgeMesh::Index nextOf(HalfEdgeMesh::Index h)
{
  return h - h % 8 + (h % 8 + 1) % 3;
}
inline HalfEdgeMesh::Index previousOf(HalfEdgeMesh::Index h)
{
  return h - h % 8 + (h % 8 + 2) % 3;
}
///@}

inline std::vector<Point2> asPoints(const Coordinates& xy)
{
  std::vector<Point2> points;
  for (std::size_t i = 0; i + 1 < xy.size(); i += 2)
  {
    points.push_back({ xy[i], xy[i + 1] });
  }
  return points;
}

inline Coordinates asCoordinates(const std::vector<Point2>& points)
{
  Coordinates xy;
  for (const Point2 p : points)
  {
    xy.insert(xy.end(), { p.x, p.y });
  }
  return xy;
}

inline std::vector<Point2> pointSet(
  const std::string& name, std::size_t count, std::uint64_t seed = 1)
{
  return asPoints(makePointSet(name, count, seed));
}

inline void insert(DelaunayKernel& kernel, const std::vector<Point2>& points)
{
  kernel.insert(points.data(), points.size());
}

/// The finite triangles, as indices of the inserted points.
inline Triangles finiteTriangles(const DelaunayKernel& kernel)
{
  Triangles triangles;
  for (DelaunayKernel::Index t = 0; t < kernel.mesh().end(); t += 8)
  {
    if (!kernel.isInfinite(t))
    {
      const auto place = [&](DelaunayKernel::Index i)
      { return std::int64_t(kernel.pointIndex(kernel.mesh().vertex(t + i))); };
      triangles.push_back(canonical(place(0), place(1), place(2)));
    }
  }
  return sorted(std::move(triangles));
}

/// For each inserted point the index of its representative, as the kernel reports it.
inline Ids representatives(const DelaunayKernel& kernel)
{
  Ids ids;
  for (DelaunayKernel::Index v = 1; v < kernel.vertexEnd(); ++v)
  {
    ids.push_back(v - 1);
  }
  for (const DelaunayKernel::Duplicate& duplicate : kernel.duplicates())
  {
    ids[duplicate.Point] = std::int64_t(kernel.pointIndex(duplicate.Vertex));
  }
  return ids;
}

/// Whether the kernel has CGAL's triangles, and every duplicate has a representative with its
/// coordinates. `points` are all points inserted, in one or more batches.
inline testing::AssertionResult isDelaunay(
  const DelaunayKernel& kernel, const std::vector<Point2>& points)
{
  const Ids standsFor = representatives(kernel);
  Ids vertices;
  for (std::size_t i = 0; i < standsFor.size(); ++i)
  {
    if (!(points[i] == points[std::size_t(standsFor[i])]))
    {
      return testing::AssertionFailure()
        << "point " << i << " has a representative with other coordinates";
    }
    if (standsFor[i] == std::int64_t(i))
    {
      vertices.push_back(std::int64_t(i));
    }
  }
  const Coordinates xy = asCoordinates(points);
  return sameTriangles(xy, finiteTriangles(kernel), delaunay(xy, vertices));
}

} // namespace test
} // namespace tipp

#endif

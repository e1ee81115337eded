// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation3D/CoplanarPoints.h"

#include "Kernel3D/DelaunayKernel3.h"
#include "Predicates/NormalAxis.h"
#include "Triangulation3D/OrderCells.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Returns for each point whether it is a duplicate or rejected.
std::vector<char> findLeftOut(const Tetrahedralization& mesh, std::size_t count)
{
  std::vector<char> isLeftOut(count, 0);
  for (const PointId rejected : mesh.Rejected)
  {
    isLeftOut[std::size_t(rejected)] = 1;
  }
  for (const Duplicate& duplicate : mesh.Duplicates)
  {
    isLeftOut[std::size_t(duplicate.Point)] = 1;
  }
  return isLeftOut;
}

/// Returns three of the points that are not collinear. Throws std::logic_error if there are none.
std::array<Point3, 3> findTriangle(const Point3* points, const std::vector<char>& isLeftOut)
{
  std::array<Point3, 3> found = {};
  std::size_t size = 0;
  for (std::size_t i = 0; i < isLeftOut.size() && size < found.size(); ++i)
  {
    const Point3& p = points[i];
    const bool isIndependent = isLeftOut[i] == 0 &&
      (size == 0 || (size == 1 && !(p == found[0])) ||
        (size == 2 && !areCollinear(found[0], found[1], p)));
    if (isIndependent)
    {
      found[size++] = p;
    }
  }
  if (size < found.size())
  {
    throw std::logic_error("the points are collinear");
  }
  return found;
}

} // namespace

Triangulation triangulateCoplanar(const Point3* points, std::size_t count,
  const TetrahedralizationOptions& options, Tetrahedralization& mesh)
{
  const std::vector<char> isLeftOut = findLeftOut(mesh, count);
  const auto [a, b, c] = findTriangle(points, isLeftOut);
  const auto axis = std::size_t(normalAxis(a, b, c));
  constexpr std::array<double Point3::*, 3> axes = { &Point3::x, &Point3::y, &Point3::z };
  const auto u = axes[(axis + 1) % 3];
  const auto v = axes[(axis + 2) % 3];
  Buffer<double> projected(2 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    projected[2 * i] = isLeftOut[i] != 0 ? none : points[i].*u;
    projected[2 * i + 1] = isLeftOut[i] != 0 ? none : points[i].*v;
  }
  TriangulationOptions flat;
  flat.Threads = options.Threads;
  // Progress already stands at 1: only check whether to stop.
  flat.Progress = [&options](double) { return !options.Progress || options.Progress(1); };
  Triangulation triangles = triangulate(PointsView(projected.data(), count, 2), flat);
  orderTriangles(triangles.Ids32);
  triangles.Rejected = mesh.Rejected;
  if (!triangles.Duplicates.empty())
  {
    mesh.Duplicates = triangles.Duplicates;
  }
  triangles.Duplicates = mesh.Duplicates;
  return triangles;
}

} // namespace tipp

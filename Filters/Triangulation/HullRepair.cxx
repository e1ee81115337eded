// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/HullRepair.h"

#include "Kernel/DelaunayKernel.h"
#include "Predicates/Circumdisk.h"
#include "Predicates/InCircle.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

bool hasArtificialVertex(const SeamTriangle& triangle)
{
  return std::any_of(
    triangle.begin(), triangle.end(), [](const SeamVertex& v) { return v.isArtificial(); });
}

std::vector<SeamVertex> trueVertices(
  std::vector<SeamTriangle>::const_iterator begin, std::vector<SeamTriangle>::const_iterator end)
{
  std::vector<SeamVertex> vertices;
  for (auto triangle = begin; triangle != end; ++triangle)
  {
    std::copy_if(triangle->begin(), triangle->end(), std::back_inserter(vertices),
      [](const SeamVertex& v) { return !v.isArtificial(); });
  }
  const auto less = [](const SeamVertex& a, const SeamVertex& b) { return a.Id < b.Id; };
  const auto equal = [](const SeamVertex& a, const SeamVertex& b) { return a.Id == b.Id; };
  std::sort(vertices.begin(), vertices.end(), less);
  vertices.erase(std::unique(vertices.begin(), vertices.end(), equal), vertices.end());
  return vertices;
}

bool contains(const Box2& box, Point2 p)
{
  return box.xmin <= p.x && p.x <= box.xmax && box.ymin <= p.y && p.y <= box.ymax;
}

} // namespace

std::vector<std::array<std::uint32_t, 3>> hullTriangles(
  std::vector<Point2> vertices, const std::vector<SeamVertex>& artificial)
{
  DelaunayKernel kernel;
  kernel.insert(vertices.data(), vertices.size());
  std::vector<Point2>().swap(vertices); // the kernel has them; there may be very many
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (DelaunayKernel::Index t = 0; t < kernel.mesh().end(); t += 8)
  {
    if (kernel.isInfinite(t))
    {
      continue;
    }
    const DelaunayKernel::Index* v = kernel.mesh().slots() + t;
    const Point2 a = kernel.point(v[0]);
    const Point2 b = kernel.point(v[1]);
    const Point2 c = kernel.point(v[2]);
    const Box2 bounds = Circumdisk(a, b, c).bounds();
    if (std::any_of(artificial.begin(), artificial.end(),
          [&](const SeamVertex& z)
          { return contains(bounds, z.Place) && inCirclePerturbed(a, b, c, z.Place); }))
    {
      triangles.push_back({ kernel.place(v[0]), kernel.place(v[1]), kernel.place(v[2]) });
    }
  }
  return triangles;
}

void removeArtificialPoints(
  std::vector<SeamTriangle>& final, const std::vector<SeamVertex>& artificial)
{
  const auto firstRemoved = std::partition(final.begin(), final.end(),
    [](const SeamTriangle& triangle) { return !hasArtificialVertex(triangle); });
  const std::vector<SeamVertex> rim = trueVertices(firstRemoved, final.end());
  final.erase(firstRemoved, final.end());

  std::vector<Point2> points;
  points.reserve(rim.size());
  for (const SeamVertex& v : rim)
  {
    points.push_back(v.Place);
  }
  for (const std::array<std::uint32_t, 3>& corners : hullTriangles(std::move(points), artificial))
  {
    final.push_back({ rim[corners[0]], rim[corners[1]], rim[corners[2]] });
  }
}

} // namespace tipp

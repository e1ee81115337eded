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

bool contains(const Box2& box, Point2 p)
{
  return box.xmin <= p.x && p.x <= box.xmax && box.ymin <= p.y && p.y <= box.ymax;
}

} // namespace

std::vector<std::array<std::uint32_t, 3>> hullTriangles(
  std::vector<Point2> vertices, const std::vector<BoundaryVertex>& artificial)
{
  DelaunayKernel kernel;
  kernel.insert(vertices.data(), vertices.size());
  std::vector<Point2>().swap(vertices); // the kernel has copied them; there may be many
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
          [&](const BoundaryVertex& z)
          { return contains(bounds, z.Position) && inCirclePerturbed(a, b, c, z.Position); }))
    {
      triangles.push_back({ kernel.place(v[0]), kernel.place(v[1]), kernel.place(v[2]) });
    }
  }
  return triangles;
}

} // namespace tipp

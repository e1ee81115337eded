// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/PointsLike.h"

#include "Distributions/Random.h"
#include "Points/ReadPoints.h"
#include "Triangulation/Triangulate.h"

#include <stdexcept>

namespace tipp
{

std::vector<double> pointsLike(const std::string& path, std::int64_t count, std::uint64_t seed)
{
  const PointTable table = readPoints(path);
  TriangulationOptions options;
  // the order of the triangles, and so the points, must be the same on every machine
  options.Threads = 1;
  const Triangulation mesh = triangulate(PointsView(table.XY.data(), table.size(), 2), options);
  const std::int64_t triangles = std::int64_t(mesh.triangleCount());
  if (triangles == 0)
  {
    throw std::runtime_error("'" + path + "' has no three points off one line to be like.");
  }
  const auto corner = [&](std::int64_t triangle, std::int64_t i)
  {
    const std::size_t at = std::size_t(3 * triangle + i);
    return 2 * std::size_t(mesh.Ids64.empty() ? mesh.Ids32[at] : mesh.Ids64[at]);
  };
  Random random(seed);
  std::vector<double> xy;
  xy.reserve(2 * std::size_t(count));
  for (std::int64_t n = 0; n < count; ++n)
  {
    const std::int64_t triangle = random.index(triangles);
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1)
    {
      u = 1 - u;
      v = 1 - v;
    }
    const double* a = &table.XY[corner(triangle, 0)];
    const double* b = &table.XY[corner(triangle, 1)];
    const double* c = &table.XY[corner(triangle, 2)];
    for (int k = 0; k < 2; ++k)
    {
      xy.push_back(a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]));
    }
  }
  return xy;
}

} // namespace tipp

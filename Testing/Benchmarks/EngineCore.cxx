// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"

#include <chrono>

namespace tipp
{
namespace benchmark
{

Run runCore(const std::vector<double>& xy, const TriangulationOptions& options)
{
  Run run;
  const auto start = std::chrono::steady_clock::now();
  const Triangulation mesh = triangulate(PointsView(xy.data(), xy.size() / 2, 2), options);
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.Triangles = std::int64_t(mesh.triangleCount());
  run.Statistics = mesh.Statistics;
  TriangleSum sum;
  const auto corner = [&](std::size_t i)
  { return &xy[2 * std::size_t(mesh.Ids32.empty() ? mesh.Ids64[i] : mesh.Ids32[i])]; };
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
  {
    sum.add(corner(3 * t), corner(3 * t + 1), corner(3 * t + 2));
  }
  run.Checksum = sum.value();
  return run;
}

} // namespace benchmark
} // namespace tipp

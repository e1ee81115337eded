// SPDX-License-Identifier: BSD-3-Clause
#include "Engines.h"

#include "SweepKernel.h"

#include <array>
#include <chrono>

namespace tipp
{
namespace benchmark
{
namespace
{

using Triangle = SweepKernel::Triangle;

/// `work` appends triangles to a list, whose memory is reserved before the time is measured.
template <typename Work>
Run runOn(const std::vector<double>& xy, const Work& work)
{
  Run run;
  const auto* const points = reinterpret_cast<const Point2*>(xy.data());
  const std::size_t count = xy.size() / 2;
  const auto start = std::chrono::steady_clock::now();
  std::vector<Triangle> triangles;
  triangles.reserve(2 * count);
  work(points, count, triangles);
  run.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.Triangles = std::int64_t(triangles.size());
  TriangleSum sum;
  for (const Triangle& triangle : triangles)
  {
    sum.add(&xy[2 * triangle[0]], &xy[2 * triangle[1]], &xy[2 * triangle[2]]);
  }
  run.Checksum = sum.value();
  return run;
}

} // namespace

Run runKernel(const std::vector<double>& xy)
{
  return runOn(xy,
    [](const Point2* points, std::size_t count, std::vector<Triangle>& triangles)
    {
      DelaunayKernel kernel;
      kernel.insert(points, count);
      kernel.forEach(
        [&](DelaunayKernel::Index t)
        {
          if (!kernel.isInfinite(t))
          {
            const auto [a, b, c] = kernel.corners(t);
            triangles.push_back(
              { kernel.pointIndex(a), kernel.pointIndex(b), kernel.pointIndex(c) });
          }
        });
    });
}

Run runSweep(const std::vector<double>& xy)
{
  TriangulationStatistics statistics;
  Run run = runOn(xy,
    [&](const Point2* points, std::size_t count, std::vector<Triangle>& triangles)
    {
      SweepKernel kernel;
      kernel.triangulate(points, count,
        [&](const std::vector<Triangle>& final)
        {
          triangles.insert(triangles.end(), final.begin(), final.end());
          ++statistics.Partitions;
        });
      statistics.WorkerVertices = std::int64_t(count + kernel.carried());
    });
  run.Statistics = statistics;
  return run;
}

} // namespace benchmark
} // namespace tipp

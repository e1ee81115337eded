// SPDX-License-Identifier: BSD-3-Clause
#include "TriangulationDict.h"

#include "Reporter.h"

#include "Meshes/FindNeighbors.h"
#include "Output/TriangulationWarnings.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstring>

namespace tipp::python
{
namespace
{

nb::object duplicatesArray(const std::vector<Duplicate>& duplicates)
{
  static_assert(sizeof(Duplicate) == 2 * sizeof(std::int64_t), "two ids in a row");
  Buffer<std::int64_t> pairs(2 * duplicates.size());
  if (!duplicates.empty())
  {
    std::memcpy(pairs.data(), duplicates.data(), duplicates.size() * sizeof(Duplicate));
  }
  return arrayOf(std::move(pairs), 2);
}

nb::object rejectedArray(const std::vector<PointId>& rejected)
{
  RawBuffer ids(rejected.size() * sizeof(PointId));
  if (!rejected.empty())
  {
    std::memcpy(ids.data(), rejected.data(), ids.size());
  }
  return arrayOf(std::move(ids), Scalar::Int64, 1);
}

nb::object neighborsArray(const Triangulation& triangulation)
{
  const std::size_t triangles = triangulation.triangleCount();
  Buffer<std::int64_t> neighbors(3 * triangles);
  withoutLock(
    [&]
    {
      triangulation.Ids64.empty()
        ? findNeighbors(triangulation.Ids32.data(), triangles, neighbors.data())
        : findNeighbors(triangulation.Ids64.data(), triangles, neighbors.data());
    });
  return arrayOf(std::move(neighbors), 3);
}

nb::dict statisticsOf(const Triangulation& triangulation, std::size_t points)
{
  const TriangulationStatistics& statistics = triangulation.Statistics;
  nb::dict result;
  result["points"] = points;
  result["triangles"] = triangulation.triangleCount();
  result["duplicates"] = triangulation.Duplicates.size();
  result["rejected"] = triangulation.Rejected.size();
  result["partitions"] = statistics.Partitions;
  result["initial_points"] = statistics.InitialPoints;
  result["worker_vertices"] = statistics.WorkerVertices;
  result["threads"] = statistics.Threads;
  nb::dict seconds;
  for (const TriangulationStatistics::Phase& phase : statistics.Phases)
  {
    seconds[phase.Name.c_str()] = phase.Seconds;
  }
  result["seconds"] = seconds;
  return result;
}

} // namespace

PointsView viewOf(const InputArray& points)
{
  const std::size_t count = points.shape(0);
  const std::size_t stride = points.shape(1);
  return scalarOf(points.dtype()) == Scalar::Float32
    ? PointsView(static_cast<const float*>(points.data()), count, stride)
    : PointsView(static_cast<const double*>(points.data()), count, stride);
}

nb::dict triangulationDict(
  Triangulation&& triangulation, std::size_t points, bool longEdgesLeftOut, bool wantsNeighbors)
{
  nb::dict result;
  result["duplicates"] = duplicatesArray(triangulation.Duplicates);
  result["rejected"] = rejectedArray(triangulation.Rejected);
  result["warnings"] = warningsOf(triangulation, std::int64_t(points), longEdgesLeftOut);
  result["statistics"] = statisticsOf(triangulation, points);
  if (wantsNeighbors)
  {
    result["neighbors"] = neighborsArray(triangulation);
  }
  result["triangles"] = triangulation.Ids64.empty() ? arrayOf(std::move(triangulation.Ids32), 3)
                                                    : arrayOf(std::move(triangulation.Ids64), 3);
  return result;
}

} // namespace tipp::python

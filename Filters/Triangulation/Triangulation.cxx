// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Triangulation.h"

#include "Parallel/ParallelFor.h"

namespace tipp
{

std::vector<char> findLeftOut(const TriangulatedPoints& mesh, std::int64_t points)
{
  std::vector<char> isLeftOut(std::size_t(points), 0);
  for (const Duplicate& duplicate : mesh.Duplicates)
  {
    isLeftOut[std::size_t(duplicate.Point)] = 1;
  }
  for (const PointId rejected : mesh.Rejected)
  {
    isLeftOut[std::size_t(rejected)] = 1;
  }
  return isLeftOut;
}

Buffer<std::int64_t> representativeIds(const TriangulatedPoints& mesh, std::int64_t points)
{
  Buffer<std::int64_t> ids{ std::size_t(points) };
  forIndices(
    points, [&](std::int64_t i) { ids[std::size_t(i)] = i; }, mesh.Statistics.Threads);
  for (const Duplicate& duplicate : mesh.Duplicates)
  {
    ids[std::size_t(duplicate.Point)] = duplicate.Representative;
  }
  for (const PointId rejected : mesh.Rejected)
  {
    ids[std::size_t(rejected)] = -1;
  }
  return ids;
}

} // namespace tipp

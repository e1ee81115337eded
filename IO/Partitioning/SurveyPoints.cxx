// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/SurveyPoints.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Partitioning/PointCoordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tipp
{
namespace
{

constexpr std::int64_t blockPoints = 1 << 16;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Calls work(first point, count, coordinates) for blocks of this rank's share.
template <typename Work>
void forEachBlock(const FlatMesh& mesh, const Ranks& ranks, int threads, const Work& work)
{
  const InputFile file(mesh.Points.Path);
  const auto [from, to] = ranks.shareOf(mesh.Points.Tuples);
  const std::int64_t blocks = (to - from + blockPoints - 1) / blockPoints;
  parallelFor(blocks, threads,
    [&, from = from, to = to](std::int64_t block)
    {
      poll();
      const std::int64_t first = from + block * blockPoints;
      const std::int64_t count = std::min(blockPoints, to - first);
      std::vector<char> raw(std::size_t(count) * mesh.Points.tupleBytes());
      file.read(mesh.Points.Offset + std::uint64_t(first) * mesh.Points.tupleBytes(), raw.data(),
        raw.size());
      const int dimension = mesh.CellSize - 1;
      std::vector<double> coordinates(std::size_t(count) * std::size_t(dimension));
      takeCoordinates(mesh.Points, raw.data(), std::size_t(count), dimension, coordinates.data());
      work(block, first, count, coordinates.data());
    });
}

struct Range
{
  double Least[3] = { infinity, infinity, infinity };
  double Greatest[3] = { -infinity, -infinity, -infinity };
};

Range rangeOf(const FlatMesh& mesh, std::int64_t first, std::int64_t count, const double* values)
{
  const std::size_t dimension = std::size_t(mesh.CellSize) - 1;
  Range range;
  double sum = 0; // not finite if one of the values is not
  for (std::size_t i = 0; i < std::size_t(count) * dimension; ++i)
  {
    const std::size_t axis = dimension == 2 ? i & 1 : i % 3;
    range.Least[axis] = std::min(range.Least[axis], values[i]);
    range.Greatest[axis] = std::max(range.Greatest[axis], values[i]);
    sum += values[i] * 0;
  }
  for (std::size_t i = 0; sum != 0 && i < std::size_t(count) * dimension; ++i)
  {
    if (!std::isfinite(values[i]))
    {
      throw IOError(mesh.Points.Path,
        "point " + std::to_string(first + std::int64_t(i / dimension)) +
          " has a coordinate that is not finite; leave such points out.");
    }
  }
  return range;
}

} // namespace

Box3 surveyPoints(const FlatMesh& mesh, const Ranks& ranks, int threads)
{
  std::vector<double> both(6, infinity);
  ranks.attempt(
    [&]
    {
      const auto [from, to] = ranks.shareOf(mesh.Points.Tuples);
      std::vector<Range> ranges(std::size_t((to - from + blockPoints - 1) / blockPoints));
      forEachBlock(mesh, ranks, threads,
        [&](std::int64_t block, std::int64_t first, std::int64_t count, const double* values)
        { ranges[std::size_t(block)] = rangeOf(mesh, first, count, values); });
      for (const Range& range : ranges)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          both[axis] = std::min(both[axis], range.Least[axis]);
          both[3 + axis] = std::min(both[3 + axis], -range.Greatest[axis]);
        }
      }
    });
  both = ranks.minimum(both);
  Box3 box;
  for (std::size_t axis = 0; axis < std::size_t(mesh.CellSize) - 1; ++axis)
  {
    box.Min[axis] = both[axis];
    box.Max[axis] = -both[3 + axis];
  }
  return box;
}

void writeHomes(const FlatMesh& mesh, const BoxTiling& tiling, const std::string& path,
  const Ranks& ranks, int threads)
{
  ranks.attempt(
    [&]
    {
      if (ranks.isFirst())
      {
        const OutputFile made(path);
      }
    });
  ranks.attempt(
    [&]
    {
      const OutputFile file = OutputFile::shared(path);
      const std::size_t dimension = std::size_t(mesh.CellSize) - 1;
      forEachBlock(mesh, ranks, threads,
        [&](std::int64_t, std::int64_t first, std::int64_t count, const double* values)
        {
          std::vector<std::int32_t> homes(std::size_t(count), -1);
          for (std::size_t i = 0; i < homes.size(); ++i)
          {
            Box3 point;
            std::copy_n(values + i * dimension, dimension, point.Min.begin());
            point.Max = point.Min;
            int met = 0;
            std::int32_t home = 0;
            tiling.forEachMeeting(point, [&](std::int32_t id) { home = met++ == 0 ? id : home; });
            homes[i] = met == 1 ? home : -1 - home;
          }
          file.write(std::uint64_t(first) * 4, homes.data(), homes.size() * 4);
        });
    });
}

} // namespace tipp

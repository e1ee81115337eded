// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionSizes_h
#define tippPartitionSizes_h

#include <cstdint>
#include <stdexcept>
#include <string>

namespace tipp
{

/// Points in a partition for which workers are fastest, by measurement.
constexpr std::int64_t BestPointsInPartition = 49152;
/// With fewer points in a partition, a worker's overhead is noticeable.
constexpr std::int64_t FewestPointsInPartition = 4096;
/// Partitions per thread; enough to keep all threads busy until the end.
constexpr std::int64_t PartitionsPerThread = 8;
/// Points of each partition in the initial mesh.
constexpr int InitialPointsOfPartition = 8;
/// Sample points per partition for balancing a tiling.
constexpr std::size_t SamplesPerPartition = 64;
/// The maximum number of partitions in a tiling; more would only cost memory.
constexpr std::int64_t MostPartitions = std::int64_t(1) << 24;

/// Throws std::length_error if a partition has too many points for the kernel's 32-bit half-edges.
inline void requireFitsKernel(std::size_t pointsInPartition)
{
  constexpr std::size_t most = 100'000'000; // well below the limit
  if (pointsInPartition > most)
  {
    throw std::length_error("A partition would hold " + std::to_string(pointsInPartition) +
      " points, more than " + std::to_string(most) +
      ": too many points are close together for the number of partitions, or they are all on one "
      "line.");
  }
}

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionSizes_h
#define tippPartitionSizes_h

#include <cstdint>
#include <stdexcept>
#include <string>

namespace tipp
{

/// Points of a partition that workers are fastest with, by measurement.
constexpr std::int64_t BestPointsInPartition = 49152;
/// With fewer, a worker's overhead shows.
constexpr std::int64_t FewestPointsInPartition = 4096;
/// Partitions for each thread, so that there is something to do until the end.
constexpr std::int64_t PartitionsPerThread = 8;
/// Of each partition's points, in the initial mesh.
constexpr int InitialPointsOfPartition = 8;
/// Of a partition's points, to balance a tiling.
constexpr std::size_t SamplesPerPartition = 64;
/// Of a tiling; more would only cost memory.
constexpr std::int64_t MostPartitions = std::int64_t(1) << 24;

/// The kernel's half-edges have 32 bits.
inline void requireFitsKernel(std::size_t pointsInPartition)
{
  constexpr std::size_t most = 100'000'000; // with room to spare
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

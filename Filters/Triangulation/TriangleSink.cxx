// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/TriangleSink.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

template <typename Id>
TriangleSink<Id>::TriangleSink(PointBuckets<Id>& buckets)
  : Buckets(buckets)
  , InteriorCounts(static_cast<std::size_t>(buckets.partitions()), 0)
{
}

template <typename Id>
typename TriangleSink<Id>::Corners TriangleSink<Id>::fromLowest(const Corners& ids)
{
  const auto first = std::size_t(std::min_element(ids.begin(), ids.end()) - ids.begin());
  return { ids[first], ids[(first + 1) % 3], ids[(first + 2) % 3] };
}

/// The boundary triangles by partition, sorted within each.
template <typename Id>
std::vector<typename TriangleSink<Id>::Corners> TriangleSink<Id>::sortBoundary(
  const std::vector<std::vector<FinalTriangle>>& boundary, int threads) const
{
  const std::size_t partitions = this->InteriorCounts.size();
  std::vector<std::size_t> ends(
    partitions + 1, 0); // end of each partition's triangles, shifted by one
  for (const std::vector<FinalTriangle>& list : boundary)
  {
    for (const FinalTriangle& triangle : list)
    {
      ++ends[std::size_t(triangle.Partition) + 1];
    }
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Corners> sorted(ends.back());
  for (const std::vector<FinalTriangle>& list : boundary)
  {
    for (const FinalTriangle& triangle : list)
    {
      sorted[ends[std::size_t(triangle.Partition)]++] = triangle.Ids;
    }
  }
#pragma omp parallel for num_threads(threads) schedule(dynamic, 16)
  for (std::size_t p = 0; p < partitions; ++p)
  {
    const std::size_t begin = p == 0 ? 0 : ends[p - 1];
    std::sort(sorted.begin() + std::ptrdiff_t(begin), sorted.begin() + std::ptrdiff_t(ends[p]));
  }
  return sorted;
}

template <typename Id>
Buffer<Id> TriangleSink<Id>::assemble(
  const std::vector<std::vector<FinalTriangle>>& boundary, int threads)
{
  const std::vector<Corners> sorted = this->sortBoundary(boundary, threads);
  const std::size_t total =
    std::accumulate(this->InteriorCounts.begin(), this->InteriorCounts.end(), sorted.size());
  const std::size_t room = 2 * this->Buckets.size();
  Buffer<Id> ids = this->Buckets.release();
  if (3 * total > ids.size())
  {
    Buffer<Id> larger(3 * total);
    std::copy(ids.begin(), ids.begin() + 3 * room, larger.begin());
    ids = std::move(larger);
  }
  const auto copyTriangle = [&ids](std::size_t to, const Id* corners)
  { std::copy(corners, corners + 3, ids.data() + 3 * to); };
  // Interior triangles beyond the end, last partition first, are moved to the gaps that are left.
  std::size_t donor = this->InteriorCounts.size();
  std::size_t donorAt = 0;
  std::size_t donorBegin = 0;
  const auto nextBeyond = [&]()
  {
    while (donorAt == donorBegin)
    {
      --donor;
      const std::size_t begin = 2 * this->Buckets.start(static_cast<PartitionIndex>(donor));
      donorAt = begin + this->InteriorCounts[donor];
      donorBegin = std::min(std::max(begin, total), donorAt);
    }
    return ids.data() + 3 * --donorAt;
  };
  auto next = sorted.begin();
  for (PartitionIndex p = 0; p < this->Buckets.partitions(); ++p)
  {
    const std::size_t gap = 2 * this->Buckets.start(p) + this->InteriorCounts[std::size_t(p)];
    const std::size_t gapEnd = std::min(2 * this->Buckets.start(p + 1), total);
    for (std::size_t at = gap; at < gapEnd; ++at)
    {
      copyTriangle(at, next != sorted.end() ? (next++)->data() : nextBeyond());
    }
  }
  for (std::size_t at = room; at < total; ++at)
  {
    copyTriangle(at, (next++)->data());
  }
  ids.truncate(3 * total);
  return ids;
}

LowestPoints::LowestPoints(std::vector<Duplicate>& duplicates)
{
  for (const Duplicate& duplicate : duplicates)
  {
    if (duplicate.Point < duplicate.Representative)
    {
      PointId& low = this->Lowest.emplace(duplicate.Representative, duplicate.Point).first->second;
      low = std::min(low, duplicate.Point);
    }
  }
  if (this->isEmpty())
  {
    return;
  }
  constexpr std::size_t tableSize = 1 << 14;
  this->MayChange.assign(tableSize, 0);
  for (const auto& change : this->Lowest)
  {
    this->MayChange[std::size_t(change.first) % tableSize] = 1;
  }
  for (Duplicate& duplicate : duplicates)
  {
    const PointId low = this->renamed(duplicate.Representative);
    duplicate = { duplicate.Point == low ? duplicate.Representative : duplicate.Point, low };
  }
}

template <typename Id>
void preferLowestIds(Buffer<Id>& ids, std::vector<Duplicate>& duplicates, int threads)
{
  const LowestPoints lowest(duplicates);
  const auto end = lowest.isEmpty() ? std::ptrdiff_t(0) : std::ptrdiff_t(ids.size());
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::ptrdiff_t i = 0; i < end; ++i)
  {
    const PointId id = ids[std::size_t(i)];
    const PointId renamed = lowest.renamed(id);
    if (renamed != id) // unchanged memory is not written
    {
      ids[std::size_t(i)] = static_cast<Id>(renamed);
    }
  }
  std::sort(duplicates.begin(), duplicates.end());
}

template class TriangleSink<std::int32_t>;
template class TriangleSink<std::int64_t>;
template void preferLowestIds(Buffer<std::int32_t>&, std::vector<Duplicate>&, int);
template void preferLowestIds(Buffer<std::int64_t>&, std::vector<Duplicate>&, int);

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointBuckets_h
#define tippPointBuckets_h

#include "Arrays/Buffer.h"
#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/PopulatePages.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace tipp
{

/// Distributes points and their ids among many buckets. Each bucket's items are collected in a
/// buffer of one cache line, which is written to memory as a whole, bypassing the cache: a line
/// filled by one store after another would first have to be read (software write-combining;
/// Balkesen, Teubner, Alonso, Oezsu 2013).
template <typename Id>
class BucketWriter
{
public:
  /// The destination of a bucket's items; the caller owns the memory.
  struct Bucket
  {
    Point2* Points; ///< fastest if Points and Ids are aligned to LineBytes
    Id* Ids;
    std::size_t Next; ///< index of the next item to write
  };
  static constexpr std::size_t LineBytes = 64;

  explicit BucketWriter(std::vector<Bucket> buckets)
    : Buckets(std::move(buckets))
    , Lines(this->Buckets.size())
  {
    for (const Bucket& bucket : this->Buckets)
    {
      this->Next.push_back(bucket.Next);
    }
  }
  BucketWriter(const BucketWriter&) = delete;
  BucketWriter& operator=(const BucketWriter&) = delete;
  void append(std::size_t bucket, Point2 point, Id id)
  {
    const std::size_t at = this->Next[bucket]++;
    Line& line = this->Lines[bucket];
    line.Points[at % PointsInLine] = point;
    line.Ids[at % IdsInLine] = id;
    if (at % PointsInLine == PointsInLine - 1)
    {
      const Bucket& to = this->Buckets[bucket];
      write(line.Points, to.Points, to.Next, at + 1);
      if (at % IdsInLine == IdsInLine - 1)
      {
        write(line.Ids, to.Ids, to.Next, at + 1);
      }
    }
  }

  /// Writes the lines that are not full; without this call they are lost.
  void finish()
  {
    for (std::size_t bucket = 0; bucket < this->Buckets.size(); ++bucket)
    {
      const std::size_t end = this->Next[bucket];
      const Bucket& to = this->Buckets[bucket];
      if (end > to.Next && end % PointsInLine != 0)
      {
        write(this->Lines[bucket].Points, to.Points, to.Next, end);
      }
      if (end > to.Next && end % IdsInLine != 0)
      {
        write(this->Lines[bucket].Ids, to.Ids, to.Next, end);
      }
    }
#ifdef __SSE2__
    _mm_sfence(); // make the stores visible to other threads
#endif
  }

private:
  static constexpr std::size_t PointsInLine = LineBytes / sizeof(Point2);
  static constexpr std::size_t IdsInLine = LineBytes / sizeof(Id);
  static_assert(IdsInLine % PointsInLine == 0, "where a line of ids ends, one of points does");

  struct alignas(LineBytes) Line
  {
    Point2 Points[PointsInLine];
    Id Ids[IdsInLine];
  };

  /// Writes a line's items up to `end`, except those before `first`, which belong to another
  /// writer.
  template <typename Item>
  static void write(const Item* line, Item* items, std::size_t first, std::size_t end)
  {
    constexpr std::size_t inLine = LineBytes / sizeof(Item);
    const std::size_t begin = (end - 1) / inLine * inLine;
    Item* const to = items + begin;
    if (begin < first || end - begin < inLine ||
      reinterpret_cast<std::uintptr_t>(to) % LineBytes != 0)
    {
      const std::size_t skipped = begin < first ? first - begin : 0;
      std::copy(line + skipped, line + (end - begin), to + skipped);
      return;
    }
#ifdef __SSE2__
    for (std::size_t i = 0; i < LineBytes / sizeof(__m128i); ++i)
    {
      _mm_stream_si128(reinterpret_cast<__m128i*>(to) + i,
        _mm_load_si128(reinterpret_cast<const __m128i*>(line) + i));
    }
#else
    std::copy_n(line, inLine, to);
#endif
  }

  const std::vector<Bucket> Buckets;
  std::vector<std::size_t> Next;
  std::vector<Line> Lines;
};

/// The finite points and their ids, grouped by partition, in the input's order within each
/// partition. Once a partition's points are no longer needed, the same memory holds its triangles.
/// There is memory for two triangles per point, more than a planar triangulation has (Euler).
template <typename Id>
class PointBuckets
{
public:
  PointBuckets() = default;
  /// `starts` has the index of each partition's first point, and the number of points at the end.
  explicit PointBuckets(std::vector<std::size_t> starts)
    : Starts(std::move(starts))
    , Memory(6 * this->Starts.back())
  {
  }
  /// Refers to points that are stored elsewhere in the buckets' order; their ids are their indices
  /// in `points`. `more` is the number of additional triangles to allocate memory for, at the end.
  PointBuckets(std::vector<std::size_t> starts, const Point2* points, std::size_t more)
    : Starts(std::move(starts))
    , Elsewhere(points)
    , Memory(6 * this->Starts.back() + 3 * more)
  {
  }

  PartitionIndex partitions() const { return static_cast<PartitionIndex>(this->Starts.size() - 1); }
  std::size_t start(PartitionIndex p) const { return this->Starts[std::size_t(p)]; }
  std::size_t count(PartitionIndex p) const { return this->start(p + 1) - this->start(p); }
  std::size_t size() const { return this->Starts.back(); }

  const Point2* points(PartitionIndex p) const
  {
    return this->Elsewhere ? this->Elsewhere + this->start(p) : this->held(p);
  }
  Id id(PartitionIndex p, std::size_t at) const
  {
    return this->Elsewhere ? static_cast<Id>(this->start(p) + at) : this->heldIds(p)[at];
  }
  /// Copies the ids of a partition's points to `ids`, which is resized.
  void copyIds(PartitionIndex p, std::vector<Id>& ids) const
  {
    ids.resize(this->count(p));
    if (this->Elsewhere)
    {
      std::iota(ids.begin(), ids.end(), static_cast<Id>(this->start(p)));
    }
    else
    {
      std::copy_n(this->heldIds(p), ids.size(), ids.data());
    }
  }
  Id* triangles(PartitionIndex p) { return this->Memory.data() + 6 * this->start(p); }

  ///@{
  /// Uninitialised memory for a partition's points and ids.
  Point2* pointsToFill(PartitionIndex p) { return const_cast<Point2*>(this->held(p)); }
  Id* idsToFill(PartitionIndex p) { return const_cast<Id*>(this->heldIds(p)); }
  ///@}

  /// Commits the pages of part `part` of `parts` of the memory, all of which will be used.
  void populate(int part, int parts)
  {
    const auto [begin, end] = evenShare(6 * this->size(), part, parts);
    populatePages(this->Memory.data() + begin, (end - begin) * sizeof(Id));
  }

  /// Returns the memory: all partitions' triangles, with gaps between them.
  Buffer<Id> release() { return std::move(this->Memory); }

  /// Takes back released memory, with any content: the points must be stored elsewhere.
  void takeBack(Buffer<Id> memory) { this->Memory = std::move(memory); }

private:
  static_assert(sizeof(Point2) + sizeof(Id) <= 6 * sizeof(Id), "the points fit");

  ///@{
  /// Points and ids are aligned to cache lines, for BucketWriter, if the partition has enough
  /// points: the triangles' memory is larger than the points need, and the difference must hold the
  /// padding.
  std::uintptr_t alignment(PartitionIndex p) const
  {
    constexpr std::size_t line = 64;
    constexpr std::size_t spare = 6 * sizeof(Id) - sizeof(Point2) - sizeof(Id);
    return this->count(p) * spare >= 2 * line ? line : alignof(Id);
  }
  const Point2* held(PartitionIndex p) const
  {
    return alignedUp<Point2>(this->Memory.data() + 6 * this->start(p), this->alignment(p));
  }
  const Id* heldIds(PartitionIndex p) const
  {
    return alignedUp<Id>(this->held(p) + this->count(p), this->alignment(p));
  }
  template <typename Item>
  static const Item* alignedUp(const void* memory, std::uintptr_t alignment)
  {
    const std::uintptr_t beyond = reinterpret_cast<std::uintptr_t>(memory) % alignment;
    return reinterpret_cast<const Item*>(
      static_cast<const char*>(memory) + (beyond == 0 ? 0 : alignment - beyond));
  }
  ///@}

  std::vector<std::size_t> Starts = { 0 };
  const Point2* Elsewhere = nullptr;
  Buffer<Id> Memory;
};

/// Sorts the finite points by partition, stably. Ids are indices into `points`.
template <typename Id>
PointBuckets<Id> bucketPoints(const PointsView& points, const Tiling& tiling, int threads)
{
  const std::size_t partitions = static_cast<std::size_t>(tiling.size());
  const PartitionFinder finder(tiling);
  Buffer<std::uint32_t> labels(points.size());
  // By part of the input and partition: at first the part's number of points there.
  std::vector<std::vector<std::size_t>> nextOf(
    static_cast<std::size_t>(threads), std::vector<std::size_t>(partitions, 0));
  const auto labelPart = [&](std::int64_t part)
  {
    const auto [begin, end] = evenShare(points.size(), int(part), threads);
    populatePages(labels.data() + begin, (end - begin) * sizeof(std::uint32_t));
    finder.label(points, begin, end, labels.data(), nextOf[std::size_t(part)]);
  };
  parallelFor(threads, threads, labelPart);
  // From here on: the index of each part's next point in the sorted order.
  PointBuckets<Id> buckets(countsToIndices(partitions, nextOf));
  const auto scatterPart = [&](std::int64_t part)
  {
    buckets.populate(int(part), threads);
    std::vector<typename BucketWriter<Id>::Bucket> toFill;
    toFill.reserve(partitions);
    for (PartitionIndex p = 0; p < tiling.size(); ++p)
    {
      toFill.push_back({ buckets.pointsToFill(p), buckets.idsToFill(p),
        nextOf[std::size_t(part)][std::size_t(p)] - buckets.start(p) });
    }
    BucketWriter<Id> writer(std::move(toFill));
    const auto [begin, end] = evenShare(points.size(), int(part), threads);
    points.forEach(begin, end,
      [&](std::size_t id, Point2 p)
      {
        if (labels[id] != PartitionFinder::None)
        {
          writer.append(labels[id], p, static_cast<Id>(id));
        }
      });
    writer.finish();
  };
  parallelFor(threads, threads, scatterPart);
  return buckets;
}

/// Puts all points into one bucket. The points are not copied if they are contiguous and all
/// finite.
template <typename Id>
PointBuckets<Id> bucketTogether(
  const PointsView& points, const Box2& bounds, bool allFinite, int threads)
{
  if (points.contiguous() && allFinite)
  {
    PointBuckets<Id> buckets({ 0, points.size() }, points.contiguous(), 0);
    buckets.populate(0, 1);
    return buckets;
  }
  if (!allFinite)
  {
    return bucketPoints<Id>(points, Tiling::grid(bounds, 1, 1), threads);
  }
  PointBuckets<Id> buckets({ 0, points.size() });
  Point2* const to = buckets.pointsToFill(0);
  Id* const ids = buckets.idsToFill(0);
  const auto copyPart = [&](std::int64_t part)
  {
    const auto [begin, end] = evenShare(points.size(), int(part), threads);
    buckets.populate(int(part), threads);
    points.forEach(begin, end, [to](std::size_t id, Point2 p) { to[id] = p; });
    std::iota(ids + begin, ids + end, static_cast<Id>(begin));
  };
  parallelFor(threads, threads, copyPart);
  return buckets;
}

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBucketWriter_h
#define tippBucketWriter_h

#include "Predicates/Point2.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
      this->writePoints(bucket, at + 1);
      if (at % IdsInLine == IdsInLine - 1)
      {
        this->writeIds(bucket, at + 1);
      }
    }
  }

  /// Writes the lines that are not full; without this call they are lost.
  void finish()
  {
    for (std::size_t bucket = 0; bucket < this->Buckets.size(); ++bucket)
    {
      const std::size_t end = this->Next[bucket];
      if (end > this->Buckets[bucket].Next && end % PointsInLine != 0)
      {
        this->writePoints(bucket, end);
      }
      if (end > this->Buckets[bucket].Next && end % IdsInLine != 0)
      {
        this->writeIds(bucket, end);
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

  void writePoints(std::size_t bucket, std::size_t end)
  {
    const Bucket& to = this->Buckets[bucket];
    write(this->Lines[bucket].Points, to.Points, to.Next, end);
  }

  void writeIds(std::size_t bucket, std::size_t end)
  {
    const Bucket& to = this->Buckets[bucket];
    write(this->Lines[bucket].Ids, to.Ids, to.Next, end);
  }

  const std::vector<Bucket> Buckets;
  std::vector<std::size_t> Next;
  std::vector<Line> Lines;
};

} // namespace tipp

#endif

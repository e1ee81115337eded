// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/PositionJoin.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace tipp
{
namespace
{

/// The number of 64-bit words, a power of two: 16 bits per position, if memory allows.
std::size_t wordsFor(std::int64_t wanted, std::uint64_t memory)
{
  constexpr std::uint64_t perWord = 4;
  const std::uint64_t most = std::max<std::uint64_t>(1, memory / 16 / sizeof(std::uint64_t));
  std::size_t words = 1;
  while (words < std::uint64_t(wanted) / perWord && 2 * words <= most)
  {
    words *= 2;
  }
  return words;
}

std::size_t bucketsFor(
  std::int64_t wanted, std::size_t columns, std::uint64_t memory, std::size_t most)
{
  // Position and number, the point's row, and the entry in an index.
  const std::uint64_t each = 24 + 8 + 8 * columns + 36;
  const std::uint64_t share = std::max<std::uint64_t>(1, memory / 16);
  return std::size_t(std::clamp<std::uint64_t>(std::uint64_t(wanted) * each / share, 1, most));
}

} // namespace

PositionJoin::PositionJoin(const std::string& file, std::int64_t wanted, std::size_t columns,
  std::uint64_t memory, int threads)
  : Columns(columns)
  , Threads(threads)
  , Mask(wordsFor(wanted, memory) - 1)
  , Bits(std::size_t(this->Mask) + 1, 0)
  , Positions(file + ".wanted", bucketsFor(wanted, columns, memory, MostBuckets), sizeof(Wanted))
  , Candidates(file + ".points", this->Positions.keys(), (2 + columns) * sizeof(double))
{
}

void PositionJoin::want(Point2 position, std::int64_t number)
{
  const std::uint64_t hash = PositionIndex::hashOf(position);
  this->wordOf(hash) |= bitsOf(hash);
  const Wanted wanted{ position, number };
  this->Positions.add(this->bucketOf(position), &wanted);
}

void PositionJoin::seal()
{
  this->Positions.finish();
}

/// The indices of points whose hash passes the filter.
std::vector<std::size_t> PositionJoin::mayMatch(PointsView points)
{
  constexpr std::int64_t chunk = 8192;
  constexpr std::size_t group = 32; // number of hashes prefetched at a time
  const auto count = std::int64_t(points.size());
  std::vector<std::vector<std::size_t>> found(std::size_t((count + chunk - 1) / chunk));
  const auto look =
    [&](const Point2* block, std::size_t first, std::size_t size, std::vector<std::size_t>& its)
  {
    std::array<std::uint64_t, group> hashes;
    for (std::size_t i = 0; i < size; ++i)
    {
      hashes[i] = PositionIndex::hashOf(block[i]);
      __builtin_prefetch(&this->wordOf(hashes[i]));
    }
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::uint64_t bits = bitsOf(hashes[i]);
      (this->wordOf(hashes[i]) & bits) == bits ? its.push_back(first + i) : void();
    }
  };
  forChunks(count, chunk, this->Threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      points.forBlocks(std::size_t(begin), std::size_t(end),
        [&](std::size_t first, const Point2* block, std::size_t some)
        {
          for (std::size_t at = 0; at < some; at += group)
          {
            look(block + at, first + at, std::min(group, some - at),
              found[std::size_t(begin / chunk)]);
          }
        });
    });
  std::vector<std::size_t> all;
  for (const std::vector<std::size_t>& part : found)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

void PositionJoin::finish()
{
  this->Candidates.finish();
  std::vector<std::uint64_t>().swap(this->Bits);
}

void PositionJoin::forEachMatch(const std::function<void(const Match&)>& visit) const
{
  for (std::size_t bucket = 0; bucket < this->Positions.keys(); ++bucket)
  {
    this->matchBucket(bucket, visit);
  }
}

void PositionJoin::matchBucket(
  std::size_t bucket, const std::function<void(const Match&)>& visit) const
{
  const std::vector<Wanted> wanted = this->Positions.readAll<Wanted>(bucket);
  std::vector<Point2> positions;
  positions.reserve(wanted.size());
  std::transform(wanted.begin(), wanted.end(), std::back_inserter(positions),
    [](const Wanted& one) { return one.Position; });
  const PositionIndex index(std::move(positions));
  constexpr std::int64_t none = -1;
  std::vector<std::int64_t> rowOf(wanted.size(), none); // row of the first point at each position
  std::vector<double> rows;
  std::int64_t count = 0;
  const std::size_t words = this->Columns + 1; // at least one word per row
  this->Candidates.forEach(bucket,
    [&](const char* bytes)
    {
      Point2 position;
      std::memcpy(&position, bytes, sizeof position);
      const std::int64_t at = index.find(position);
      if (at >= 0 && rowOf[std::size_t(at)] == none)
      {
        rowOf[std::size_t(at)] = count++;
        rows.resize(std::size_t(count) * words);
        std::memcpy(
          &rows[rows.size() - words], bytes + sizeof position, this->Columns * sizeof(double));
      }
    });
  for (const Wanted& one : wanted)
  {
    const auto first = std::size_t(index.find(one.Position));
    visit({ one.Position, one.Number, wanted[first].Number,
      rowOf[first] == none ? nullptr : &rows[std::size_t(rowOf[first]) * words] });
  }
}

} // namespace tipp

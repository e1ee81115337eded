// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/OnDisk/SegmentTiles.h"

#include "OutOfCore/StreamSampler.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace tipp
{

int SegmentTiles::tilesFor(std::int64_t segments, std::uint64_t memory)
{
  constexpr std::uint64_t each = 128; // bytes of a segment and its tree
  constexpr std::uint64_t most = 4096;
  const std::uint64_t share = std::max<std::uint64_t>(1, memory / 16);
  return int(std::clamp<std::uint64_t>(std::uint64_t(segments) * each / share, 1, most));
}

SegmentTiles::SegmentTiles(const std::string& file,
  const std::function<void(const Visit&)>& forEach, std::int64_t segments, int tiles, int threads)
  : Threads(threads)
{
  Box2 domain{ HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  StreamSampler<Point2> sampler(SamplesPerPartition * std::size_t(tiles), segments);
  std::int64_t count = 0;
  std::vector<Point2> middle(1);
  forEach(
    [&](const SegmentTree::Item& item)
    {
      domain = unionOf(domain, boxOf(item.A, item.B));
      middle[0] = { item.A.x / 2 + item.B.x / 2, item.A.y / 2 + item.B.y / 2 };
      sampler.add(count++, middle);
    });
  std::vector<Point2> sample;
  for (const auto& [number, position] : sampler.take())
  {
    sample.push_back(position);
  }
  constexpr double relative = 0x1p-44; // relative to the largest coordinate
  this->Margin = count == 0 ? 0
                            : relative *
      std::max({ std::fabs(domain.xmin), std::fabs(domain.ymin), std::fabs(domain.xmax),
        std::fabs(domain.ymax) });
  const Tiling tiling = count == 0 ? Tiling::grid({ 0, 0, 0, 0 }, 1, 1)
                                   : Tiling::balanced(domain, std::move(sample), tiles);
  this->Rows = std::make_unique<KeyedRows>(
    file + ".tiles", std::size_t(tiling.size()), sizeof(SegmentTree::Item));
  forEach(
    [&](const SegmentTree::Item& item)
    {
      tiling.visitNear(expanded(boxOf(item.A, item.B), this->Margin),
        [&](PartitionIndex tile)
        {
          lineMayMeet(item.A, item.B, expanded(tiling.box(tile), this->Margin))
            ? this->Rows->add(std::size_t(tile), &item)
            : void();
        });
    });
  this->Rows->finish();
}

std::vector<SegmentTree::Item> SegmentTiles::itemsOf(std::size_t tile) const
{
  return this->Rows->readAll<SegmentTree::Item>(tile);
}

void SegmentTiles::findCrossings(const std::function<void(std::int64_t, std::int64_t)>& found) const
{
  for (std::size_t tile = 0; tile < this->Rows->keys(); ++tile)
  {
    for (const CrossingPair& pair : findCrossingPairs(this->itemsOf(tile), this->Threads))
    {
      found(pair[0], pair[1]);
    }
  }
}

void SegmentTiles::findNear(const std::function<bool(std::int64_t)>& isWanted,
  const std::function<void(std::int64_t)>& near) const
{
  for (std::size_t tile = 0; tile < this->Rows->keys(); ++tile)
  {
    std::vector<SegmentTree::Item> items = this->itemsOf(tile);
    std::vector<SegmentTree::Item> wanted;
    std::copy_if(items.begin(), items.end(), std::back_inserter(wanted),
      [&](const SegmentTree::Item& item) { return isWanted(item.Id); });
    const SegmentTree tree(
      wanted.empty() ? std::vector<SegmentTree::Item>() : std::move(items), this->Threads);
    for (const SegmentTree::Item& item : wanted)
    {
      tree.visitNear(
        item,
        [&](const SegmentTree::Item& other)
        {
          lineMayMeet(item.A, item.B, expanded(boxOf(other.A, other.B), this->Margin))
            ? near(other.Id)
            : void();
          return true;
        },
        this->Margin);
    }
  }
}

} // namespace tipp

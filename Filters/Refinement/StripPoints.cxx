// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/StripPoints.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
namespace
{
constexpr std::size_t chunksInBlock = 1 << 10; ///< 25 MB
}

StripPoints::StripPoints(
  const NodeStrips& strips, PointStream& points, std::size_t column, PagedMemory* memory)
  : Strips(strips)
  , Points(points)
  , Column(column)
  , Memory(memory)
{
  if (strips.size() == 1)
  {
    return; // forBlocks() reads the stream
  }
  this->Chunks.resize(strips.size());
  this->Counts.resize(strips.size());
  constexpr std::size_t most = 1 << 18;
  this->forStream(most,
    [this](const std::vector<Point3>& positions, const std::vector<double>& values)
    {
      for (std::size_t i = 0; i < positions.size(); ++i)
      {
        this->store(positions[i], values[i]);
      }
    });
}

/// Reads the stream once.
void StripPoints::forStream(std::size_t most, const Take& take)
{
  std::vector<Point3> positions;
  std::vector<double> values;
  forEachBlock(this->Points, most,
    [&](PointBlock& block)
    {
      positions.clear();
      values.clear();
      for (std::size_t i = 0; i < block.size(); ++i)
      {
        const double value = block.Columns[this->Column][i];
        if (std::isfinite(value))
        {
          positions.push_back({ block.XY[2 * i], block.XY[2 * i + 1], 0 });
          values.push_back(value);
        }
      }
      keepMemoryLimits();
      take(positions, values);
    });
}

/// Adds a point to the strips whose triangles may contain it.
void StripPoints::store(Point3 position, double value)
{
  for (std::size_t strip = 0; strip < this->Strips.size(); ++strip)
  {
    const auto [low, high] = this->Strips.range(strip);
    if (low <= position[1] && position[1] <= high)
    {
      this->add(strip, { { position[0], position[1] }, value });
    }
  }
}

void StripPoints::add(std::size_t strip, const Item& item)
{
  const std::size_t at = this->Counts[strip]++ % Chunk;
  if (at == 0)
  {
    if (this->ChunkEnd % chunksInBlock == 0)
    {
      this->Blocks.push_back(bufferIn<Item>(this->Memory, chunksInBlock * Chunk));
    }
    this->Chunks[strip].push_back(this->ChunkEnd++);
  }
  const std::size_t chunk = this->Chunks[strip].back();
  this->Blocks[chunk / chunksInBlock][chunk % chunksInBlock * Chunk + at] = item;
}

void StripPoints::forBlocks(std::size_t strip, std::size_t most, const Take& take)
{
  if (this->Strips.size() == 1)
  {
    this->forStream(most, take);
    return;
  }
  std::vector<Point3> positions;
  std::vector<double> values;
  for (std::size_t i = 0; i < this->Counts[strip]; ++i)
  {
    const std::size_t chunk = this->Chunks[strip][i / Chunk];
    const Item& item =
      this->Blocks[chunk / chunksInBlock][chunk % chunksInBlock * Chunk + i % Chunk];
    positions.push_back({ item.Position.x, item.Position.y, 0 });
    values.push_back(item.Value);
    if (positions.size() == most || i + 1 == this->Counts[strip])
    {
      keepMemoryLimits();
      take(positions, values);
      positions.clear();
      values.clear();
    }
  }
}

} // namespace tipp

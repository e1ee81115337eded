// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/PartitionFinder.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tipp
{
namespace
{

/// Without branches, so that compilers vectorise it.
inline void findCells(const CellGrid::Axis& columns, const CellGrid::Axis& rows,
  const Point2* points, std::size_t count, std::uint32_t* cells)
{
  const CellGrid::Axis column = columns;
  const CellGrid::Axis row = rows;
  const std::uint32_t width = column.size();
  const std::uint32_t outside = width * row.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Point2 p = points[i];
    const std::uint32_t cell = row(p.y) * width + column(p.x);
    const double nothing = (p.x - p.x) + (p.y - p.y); // NaN if a coordinate is not finite
    cells[i] = nothing == 0 ? cell : outside;
  }
}

/// Chosen so that few cells lie in several boxes, but the grid stays in the processor's cache.
std::uint32_t cellsAlongASide(PartitionIndex boxes)
{
  constexpr double perBox = 32;
  constexpr double most = 1024;
  return boxes > 1 ? static_cast<std::uint32_t>(std::min(perBox * std::sqrt(double(boxes)), most))
                   : 1;
}

} // namespace

CellGrid::Axis::Axis(double low, double high, std::uint32_t count)
{
  const double scale = count / (high - low);
  if (std::isfinite(scale))
  {
    this->Low = low;
    this->Scale = scale;
    this->Last = count - 1;
  }
}

CellGrid::CellGrid(const Box2& box, std::uint32_t perSide)
  : Columns(box.xmin, box.xmax, perSide)
  , Rows(box.ymin, box.ymax, perSide)
{
}

void CellGrid::find(
  const Point2* points, std::size_t count, std::uint32_t* cells, Instructions instructions) const
{
  runWith(instructions, [&] { findCells(this->Columns, this->Rows, points, count, cells); });
}

PartitionFinder::PartitionFinder(const Tiling& tiling)
  : Boxes(tiling)
  , Cells(tiling.domain(), cellsAlongASide(tiling.size()))
  , Starts(this->Cells.size() + 1)
{
  this->fill(0, { { 0, 0 }, { this->Cells.columns().size(), this->Cells.rows().size() } });
}

/// Fills the starts of a block of cells, all of which reach the node.
void PartitionFinder::fill(std::int32_t node, const Block& block)
{
  if (block.Begin[0] >= block.End[0] || block.Begin[1] >= block.End[1])
  {
    return;
  }
  const Tiling::Node& cut = this->Boxes.node(node);
  Block cells = block; // the cells in a box, or on both sides of the cut
  if (!cut.isBox())
  {
    const std::uint32_t at =
      cut.Axis == 0 ? this->Cells.columns()(cut.At) : this->Cells.rows()(cut.At);
    Block below = block;
    Block above = block;
    below.End[cut.Axis] = std::min(block.End[cut.Axis], at);
    above.Begin[cut.Axis] = std::max(block.Begin[cut.Axis], at + 1);
    this->fill(cut.Child[0], below);
    this->fill(cut.Child[1], above);
    cells.Begin[cut.Axis] = std::max(block.Begin[cut.Axis], at);
    cells.End[cut.Axis] = std::min(block.End[cut.Axis], at + 1);
  }
  for (std::uint32_t row = cells.Begin[1]; row < cells.End[1]; ++row)
  {
    std::int32_t* const starts =
      this->Starts.data() + std::size_t(row) * this->Cells.columns().size();
    std::fill(starts + std::min(cells.Begin[0], cells.End[0]), starts + cells.End[0],
      cut.isBox() ? ~cut.Partition : node);
  }
}

void PartitionFinder::locate(
  const Point2* points, std::size_t count, std::uint32_t* partitions) const
{
  constexpr std::size_t most = 256; // at a time
  std::array<std::uint32_t, most> cells;
  std::array<std::uint32_t, most> open;
  for (std::size_t begin = 0; begin < count; begin += most)
  {
    const std::size_t size = std::min(count - begin, most);
    const Point2* const block = points + begin;
    std::uint32_t* const found = partitions + begin;
    this->Cells.find(block, size, cells.data());
    // Without branches; the few cells that lie in several boxes are processed below.
    std::size_t openCount = 0;
    for (std::size_t i = 0; i < size; ++i)
    {
      const std::int32_t start = this->Starts[cells[i]];
      found[i] = static_cast<std::uint32_t>(~start);
      open[openCount] = static_cast<std::uint32_t>(i);
      openCount += start >= 0 ? 1 : 0;
    }
    for (std::size_t k = 0; k < openCount; ++k)
    {
      const std::size_t i = open[k];
      const std::int32_t start = static_cast<std::int32_t>(~found[i]);
      found[i] =
        isFinite(block[i]) ? static_cast<std::uint32_t>(this->Boxes.locate(block[i], start)) : None;
    }
  }
}

void PartitionFinder::label(PointsView points, std::size_t begin, std::size_t end,
  std::uint32_t* labels, std::vector<std::size_t>& counts) const
{
  points.forBlocks(begin, end,
    [this, labels, &counts](std::size_t first, const Point2* block, std::size_t count)
    {
      std::uint32_t* const to = labels + first;
      this->locate(block, count, to);
      for (std::size_t i = 0; i < count; ++i)
      {
        if (to[i] != None)
        {
          ++counts[to[i]];
        }
      }
    });
}

} // namespace tipp

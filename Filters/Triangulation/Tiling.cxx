// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/Tiling.h"

#include "Ranks/Archive.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
namespace
{

/// A coordinate inside (low, high) that splits off the fraction `part`; high if none is
/// representable.
double between(double low, double high, double part)
{
  return std::clamp(low * (1 - part) + high * part, low, high);
}

/// Branch-free, so that compilers vectorise it.
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

std::int32_t Tiling::addBox(const Box2& box, PartitionIndex partition)
{
  this->Boxes.resize(std::max(this->Boxes.size(), std::size_t(partition) + 1));
  this->Boxes[std::size_t(partition)] = box;
  return this->addLeaf(partition);
}

Tiling Tiling::grid(const Box2& domain, int columns, int rows)
{
  if (std::int64_t(columns) * rows > MostPartitions)
  {
    throw std::length_error(std::to_string(columns) + " x " + std::to_string(rows) +
      " partitions are too many; the most are " + std::to_string(MostPartitions) + ".");
  }
  Tiling tiling;
  tiling.Domain = domain;
  tiling.cutGrid(domain, columns, rows);
  return tiling;
}

std::int32_t Tiling::cutGrid(const Box2& box, int columns, int rows)
{
  if (columns == 1 && rows == 1)
  {
    return this->addBox(box, this->size());
  }
  const int axis = columns >= rows ? 0 : 1;
  const int count = axis == 0 ? columns : rows;
  const int lower = count / 2;
  const double at = between(box.Min[axis], box.Max[axis], double(lower) / count);
  const auto halves = box.cut(std::size_t(axis), at);
  const auto child = [&](const Box2& half, int part)
  { return axis == 0 ? this->cutGrid(half, part, rows) : this->cutGrid(half, columns, part); };
  return this->addCut(
    axis, at, [&] { return child(halves.first, lower); },
    [&] { return child(halves.second, count - lower); });
}

Tiling Tiling::balanced(const Box2& domain, std::vector<Point2> sample, int count)
{
  Tiling tiling;
  tiling.Domain = domain;
  tiling.cutSample(domain, sample.data(), sample.data() + sample.size(), count);
  return tiling;
}

/// Cuts the longer side half way between two neighbouring sample points. Returns the node.
std::int32_t Tiling::cutSample(const Box2& box, Point2* begin, Point2* end, int count)
{
  const std::ptrdiff_t lower = (end - begin) * (count / 2) / std::max(count, 1);
  if (count <= 1 || lower == 0)
  {
    return this->addBox(box, this->size());
  }
  const int axis = box.width(0) >= box.width(1) ? 0 : 1;
  const auto less = [axis](const Point2& p, const Point2& q) { return p[axis] < q[axis]; };
  Point2* middle = begin + lower;
  std::nth_element(begin, middle, end, less);
  const double at = between((*std::max_element(begin, middle, less))[axis], (*middle)[axis], 0.5);
  const auto halves = box.cut(std::size_t(axis), at);
  return this->addCut(
    axis, at, [&] { return this->cutSample(halves.first, begin, middle, count / 2); },
    [&] { return this->cutSample(halves.second, middle, end, count - count / 2); });
}

/// Copies another tiling's cuts below the node `from`; makeBox(partition) replaces its boxes.
/// Returns the copied root.
template <typename MakeBox>
std::int32_t Tiling::addTree(const Tiling& tree, std::int32_t from, const MakeBox& makeBox)
{
  const Node node = tree.node(from);
  return node.isBox()
    ? makeBox(node.Partition)
    : this->addCut(
        node.Axis, node.Coordinate, [&] { return this->addTree(tree, node.Child[0], makeBox); },
        [&] { return this->addTree(tree, node.Child[1], makeBox); });
}

Tiling Tiling::refined(const std::vector<Tiling>& inner) const
{
  Tiling tiling;
  tiling.Domain = this->Domain;
  std::vector<PartitionIndex> firsts = { 0 };
  for (const Tiling& part : inner)
  {
    firsts.push_back(firsts.back() + part.size());
  }
  tiling.addTree(*this, 0,
    [&](PartitionIndex outer)
    {
      const Tiling& part = inner[std::size_t(outer)];
      const PartitionIndex first = firsts[std::size_t(outer)];
      return tiling.addTree(
        part, 0, [&](PartitionIndex p) { return tiling.addBox(part.box(p), first + p); });
    });
  return tiling;
}

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
  : Columns(box.Min.x, box.Max.x, perSide)
  , Rows(box.Min.y, box.Max.y, perSide)
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
      cut.Axis == 0 ? this->Cells.columns()(cut.Coordinate) : this->Cells.rows()(cut.Coordinate);
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
    // Branch-free; the few points in cells that lie in several boxes are processed below.
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

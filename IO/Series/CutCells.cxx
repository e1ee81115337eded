// SPDX-License-Identifier: BSD-3-Clause
#include "Series/CutCells.h"

#include "Cells/CutPolygon.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Parallel/Poll.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace tipp
{
namespace
{

constexpr double turn = 360;

using Corners = std::vector<std::int64_t>;

class WholeCells : public CellBlocks
{
public:
  explicit WholeCells(CellMesh cells)
    : XY(std::move(cells.XY))
    , Block{ 0, std::move(cells.Corners), std::move(cells.Offsets) }
  {
    this->Cells = this->Block.cells();
    this->IsInDegrees = cells.IsInDegrees;
    this->Originals = std::move(cells.Originals);
  }

  SeriesNodes readNodes() override
  {
    SeriesNodes nodes;
    nodes.add(this->XY);
    this->XY = {};
    return nodes;
  }

  bool next(CellBlock& block) override
  {
    block = std::move(this->Block);
    this->Block = {};
    return !block.Corners.empty() || !block.Offsets.empty();
  }

private:
  std::vector<double> XY;
  CellBlock Block;
};

} // namespace

std::unique_ptr<CellBlocks> sourceOf(CellMesh cells)
{
  return std::make_unique<WholeCells>(std::move(cells));
}

class CellCutter::Work
{
public:
  Work(SeriesNodes nodes, bool isInDegrees, bool wrap, const std::string& path)
    : Given(std::move(nodes))
    , Wrap(wrap)
    , Path(path)
    , IsInDegrees(isInDegrees || this->looksLikeDegrees())
  {
    this->checkNodes();
  }

  SeriesTriangles cut(CellBlock block)
  {
    this->Cells = std::move(block);
    this->Result = {};
    this->Result.FirstCell = this->Cells.First;
    this->Changed = false;
    const bool mayChange = !this->Cells.Offsets.empty() || this->Wrap || this->IsInDegrees;
    const std::int64_t count = mayChange ? this->Cells.cells() : 0;
    for (std::int64_t cell = 0; cell < count; ++cell)
    {
      pollAt(cell);
      this->addCell(cell);
    }
    if (!this->Changed)
    {
      this->Result.Nodes = std::move(this->Cells.Corners);
    }
    return std::move(this->Result);
  }

  std::vector<SeriesLeftOut> leftOut() const
  {
    if (this->PoleCells == 0)
    {
      return {};
    }
    return { { "cell " + std::to_string(this->FirstPoleCell),
      (this->PoleCells > 1 ? "and " + std::to_string(this->PoleCells - 1) + " more contain a pole"
                           : std::string("contains a pole")) +
        ", which a map of longitudes and latitudes cannot show" } };
  }

  SeriesNodes& nodes() { return this->Given; }

private:
  /// Whether the mesh goes around the Earth, in degrees. Formats such as ADCIRC's do not say.
  bool looksLikeDegrees() const
  {
    constexpr double nearlyAll = 300;
    Box2 box = Box2::empty();
    for (std::int64_t i = 0; i < this->Given.size(); ++i)
    {
      box.extend(this->Given[i]);
    }
    return box.width(0) > nearlyAll && box.width(0) <= turn && box.Min.x >= -turn / 2 &&
      box.Max.x <= turn && box.Min.y >= -turn / 4 && box.Max.y <= turn / 4;
  }

  void checkNodes() const
  {
    for (std::int64_t i = 0; i < this->Given.size(); ++i)
    {
      const auto [x, y] = this->Given[i];
      if (!std::isfinite(x) || !std::isfinite(y))
      {
        throw IOError(this->Path,
          "gives node " + std::to_string(i) + " (from 0) no finite coordinates; correct them.");
      }
      if (this->Wrap && (std::fabs(x) > turn || std::fabs(y) > turn / 4))
      {
        throw IOError(this->Path,
          "has a node at " + shortText(x) + ", " + shortText(y) +
            ", which are no longitude and latitude in degrees; leave out --wrap.");
      }
    }
  }

  [[noreturn]] void fail(std::int64_t cell, const std::string& problem) const
  {
    throw IOError(
      this->Path, "cell " + std::to_string(this->Cells.First + cell) + " (from 0) " + problem);
  }

  Point2 position(std::int64_t node) const { return this->Given[node]; }

  /// The cell's corners without repetitions: some files repeat a corner of cells that have fewer
  /// than others.
  void takeCorners(std::int64_t cell)
  {
    const std::vector<std::int64_t>& all = this->Cells.Corners;
    const bool isTriangle = this->Cells.Offsets.empty();
    const auto at = std::size_t(cell);
    const std::int64_t first = isTriangle ? 3 * cell : this->Cells.Offsets[at];
    const std::int64_t end = isTriangle ? first + 3 : this->Cells.Offsets[at + 1];
    this->Nodes.assign(all.begin() + first, all.begin() + end);
    if (end - first > 3)
    {
      this->Nodes.erase(std::unique(this->Nodes.begin(), this->Nodes.end()), this->Nodes.end());
      while (this->Nodes.size() > 1 && this->Nodes.front() == this->Nodes.back())
      {
        this->Nodes.pop_back();
      }
    }
  }

  void addCell(std::int64_t cell)
  {
    this->takeCorners(cell);
    if (this->Nodes.empty())
    {
      this->beginChanges(cell);
      return;
    }
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (const std::int64_t node : this->Nodes)
    {
      low = std::min(low, this->position(node).x);
      high = std::max(high, this->position(node).x);
    }
    const bool isWide = high - low > turn / 2 && (this->Wrap || this->IsInDegrees);
    if (!isWide)
    {
      this->addPolygon(cell);
      return;
    }
    if (!this->Wrap)
    {
      this->fail(cell,
        "is more than 180 degrees wide: it crosses the meridian at which longitudes "
        "jump by 360; give --wrap.");
    }
    this->beginChanges(cell);
    if (this->containsPole())
    {
      this->FirstPoleCell = this->PoleCells++ == 0 ? this->Cells.First + cell : this->FirstPoleCell;
      return;
    }
    this->addOnBothSides(cell, low + turn / 2);
  }

  /// Whether the corners go around a pole: from one to the next is less than half a turn.
  bool containsPole() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < this->Nodes.size(); ++i)
    {
      const std::int64_t next = this->Nodes[(i + 1) % this->Nodes.size()];
      sum += std::remainder(this->position(next).x - this->position(this->Nodes[i]).x, turn);
    }
    return std::fabs(sum) > turn / 2;
  }

  /// Adds the cell with its western corners moved east, and with its eastern ones moved west.
  void addOnBothSides(std::int64_t cell, double middle)
  {
    const Corners given = this->Nodes;
    for (const double shift : { turn, -turn })
    {
      this->Nodes = given;
      for (std::int64_t& node : this->Nodes)
      {
        if ((this->position(node).x < middle) == (shift > 0))
        {
          node = this->copyOf(node, shift);
        }
      }
      this->addPolygon(cell);
    }
  }

  std::int64_t copyOf(std::int64_t node, double shift)
  {
    const auto [found, isNew] =
      this->CopyOf.emplace(std::pair(node, shift > 0), this->Given.size());
    if (isNew)
    {
      const Point2 p = this->position(node);
      this->Given.addCopy(node, { p.x + shift, p.y });
    }
    return found->second;
  }

  /// From the first cell of a block on that is not one triangle, the triangles are listed.
  void beginChanges(std::int64_t cell)
  {
    if (this->Changed)
    {
      return;
    }
    this->Changed = true;
    std::vector<std::int64_t>& triangles = this->Result.Nodes;
    for (std::int64_t before = 0; before < cell; ++before)
    {
      const std::int64_t first =
        this->Cells.Offsets.empty() ? 3 * before : this->Cells.Offsets[std::size_t(before)];
      triangles.insert(triangles.end(), this->Cells.Corners.begin() + first,
        this->Cells.Corners.begin() + first + 3);
      this->Result.Cells.push_back(this->Cells.First + before);
    }
  }

  void addPolygon(std::int64_t cell)
  {
    const bool isTriangle = this->Nodes.size() == 3;
    const bool isStoredSo = this->Cells.Offsets.empty() ||
      this->Cells.Offsets[std::size_t(cell) + 1] - this->Cells.Offsets[std::size_t(cell)] == 3;
    if (isTriangle && isStoredSo && !this->Changed)
    {
      return;
    }
    this->beginChanges(cell);
    if (isTriangle)
    {
      this->addTriangle(cell, { 0, 1, 2 });
      return;
    }
    this->Positions.clear();
    for (const std::int64_t node : this->Nodes)
    {
      this->Positions.push_back(this->position(node));
    }
    this->Parts.clear();
    if (!cutPolygon(this->Positions, this->Parts))
    {
      this->fail(cell,
        this->Nodes.size() < 3 ? "has fewer than three corners; correct it."
          : this->Nodes.size() > mostCorners
          ? "has more than " + std::to_string(mostCorners) + " corners; divide it."
          : "crosses or touches itself or has no area, so it is no polygon; correct it.");
    }
    for (const CornerTriangle& part : this->Parts)
    {
      this->addTriangle(cell, part);
    }
  }

  void addTriangle(std::int64_t cell, const CornerTriangle& corners)
  {
    for (const std::size_t corner : corners)
    {
      this->Result.Nodes.push_back(this->Nodes[corner]);
    }
    this->Result.Cells.push_back(this->Cells.First + cell);
  }

  SeriesNodes Given;
  const bool Wrap;
  const std::string Path;
  const bool IsInDegrees;
  CellBlock Cells;
  SeriesTriangles Result;
  bool Changed = false;
  std::int64_t PoleCells = 0;
  std::int64_t FirstPoleCell = 0;
  std::map<std::pair<std::int64_t, bool>, std::int64_t> CopyOf;
  Corners Nodes; ///< of the cell that is being added
  std::vector<Point2> Positions;
  std::vector<CornerTriangle> Parts;
};

CellCutter::CellCutter(SeriesNodes nodes, bool isInDegrees, bool wrap, const std::string& path)
  : Cutting(std::make_unique<Work>(std::move(nodes), isInDegrees, wrap, path))
{
}

CellCutter::~CellCutter() = default;

SeriesTriangles CellCutter::cut(CellBlock block)
{
  return this->Cutting->cut(std::move(block));
}

SeriesNodes& CellCutter::nodes()
{
  return this->Cutting->nodes();
}

std::vector<SeriesLeftOut> CellCutter::leftOut() const
{
  return this->Cutting->leftOut();
}

} // namespace tipp

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

class CellCutter
{
public:
  CellCutter(CellMesh cells, bool wrap, const std::string& path)
    : Cells(std::move(cells))
    , Wrap(wrap)
    , Path(path)
  {
    this->Cells.IsInDegrees = this->Cells.IsInDegrees || this->looksLikeDegrees();
  }

  CutMesh cut()
  {
    this->checkNodes();
    const std::int64_t count = this->Cells.cells();
    for (std::int64_t cell = 0; cell < count; ++cell)
    {
      pollAt(cell);
      this->addCell(cell);
    }
    if (!this->Changed)
    {
      this->Result.Mesh.OriginalCells.clear();
      this->Result.Mesh.Triangles = std::move(this->Cells.Corners);
    }
    if (this->PoleCells > 0)
    {
      this->Result.LeftOut.push_back({ "cell " + std::to_string(this->FirstPoleCell),
        (this->PoleCells > 1 ? "and " + std::to_string(this->PoleCells - 1) + " more contain a pole"
                             : std::string("contains a pole")) +
          ", which a map of longitudes and latitudes cannot show" });
    }
    this->Result.Mesh.XY = std::move(this->Cells.XY);
    return std::move(this->Result);
  }

private:
  /// Whether the mesh goes around the Earth, in degrees. Formats such as ADCIRC's do not say.
  bool looksLikeDegrees() const
  {
    constexpr double nearlyAll = 300;
    Box2 box = Box2::empty();
    for (std::size_t i = 0; i < this->Cells.XY.size(); i += 2)
    {
      box.extend(Point2{ this->Cells.XY[i], this->Cells.XY[i + 1] });
    }
    return box.width(0) > nearlyAll && box.width(0) <= turn && box.Min.x >= -turn / 2 &&
      box.Max.x <= turn && box.Min.y >= -turn / 4 && box.Max.y <= turn / 4;
  }

  void checkNodes() const
  {
    const std::vector<double>& xy = this->Cells.XY;
    const auto bad =
      std::find_if(xy.begin(), xy.end(), [](double value) { return !std::isfinite(value); });
    if (bad != xy.end())
    {
      throw IOError(this->Path,
        "gives node " + std::to_string((bad - xy.begin()) / 2) +
          " (from 0) no finite coordinates; correct them.");
    }
    for (std::size_t i = 0; this->Wrap && i < xy.size(); i += 2)
    {
      if (std::fabs(xy[i]) > turn || std::fabs(xy[i + 1]) > turn / 4)
      {
        throw IOError(this->Path,
          "has a node at " + shortText(xy[i]) + ", " + shortText(xy[i + 1]) +
            ", which are no longitude and latitude in degrees; leave out --wrap.");
      }
    }
  }

  [[noreturn]] void fail(std::int64_t cell, const std::string& problem) const
  {
    throw IOError(this->Path, "cell " + std::to_string(cell) + " (from 0) " + problem);
  }

  Point2 position(std::int64_t node) const
  {
    return { this->Cells.XY[2 * std::size_t(node)], this->Cells.XY[2 * std::size_t(node) + 1] };
  }

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
    const bool isWide = high - low > turn / 2 && (this->Wrap || this->Cells.IsInDegrees);
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
      this->FirstPoleCell = this->PoleCells++ == 0 ? cell : this->FirstPoleCell;
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
      this->CopyOf.emplace(std::pair(node, shift > 0), std::int64_t(this->Cells.XY.size() / 2));
    if (isNew)
    {
      const Point2 p = this->position(node);
      this->Cells.XY.push_back(p.x + shift);
      this->Cells.XY.push_back(p.y);
      this->Result.Copies.push_back(node);
    }
    return found->second;
  }

  /// From the first cell on that is not one triangle, the triangles are listed.
  void beginChanges(std::int64_t cell)
  {
    if (this->Changed)
    {
      return;
    }
    this->Changed = true;
    std::vector<std::int64_t>& triangles = this->Result.Mesh.Triangles;
    std::vector<std::int64_t>& originals = this->Result.Mesh.OriginalCells;
    for (std::int64_t before = 0; before < cell; ++before)
    {
      const std::int64_t first =
        this->Cells.Offsets.empty() ? 3 * before : this->Cells.Offsets[std::size_t(before)];
      triangles.insert(triangles.end(), this->Cells.Corners.begin() + first,
        this->Cells.Corners.begin() + first + 3);
      originals.push_back(before);
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
      this->Result.Mesh.Triangles.push_back(this->Nodes[corner]);
    }
    this->Result.Mesh.OriginalCells.push_back(cell);
  }

  CellMesh Cells;
  const bool Wrap;
  const std::string& Path;
  CutMesh Result;
  bool Changed = false;
  std::int64_t PoleCells = 0;
  std::int64_t FirstPoleCell = 0;
  std::map<std::pair<std::int64_t, bool>, std::int64_t> CopyOf;
  Corners Nodes; ///< of the cell that is being added
  std::vector<Point2> Positions;
  std::vector<CornerTriangle> Parts;
};

} // namespace

CutMesh cutCells(CellMesh cells, bool wrap, const std::string& path)
{
  return CellCutter(std::move(cells), wrap, path).cut();
}

} // namespace tipp

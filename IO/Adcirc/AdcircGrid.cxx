// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"

#include "Adcirc/AdcircRows.h"

#include <utility>

namespace tipp
{
namespace
{

class AdcircReader
{
public:
  AdcircReader(const std::string& path, const std::string& text)
    : Rows(path, text, "an ADCIRC grid")
  {
  }

  AdcircGrid read()
  {
    this->Rows.skipTitle();
    this->Rows.next(2, "the numbers of elements and nodes");
    const std::int64_t elements = this->Rows.integer(0);
    const std::int64_t nodes = this->Rows.integer(1);
    const std::int64_t lines = this->Rows.remainingLines();
    if (elements < 0 || nodes < 0 || elements > lines || nodes > lines - elements)
    {
      this->Rows.fail("announces " + std::to_string(elements) + " elements and " +
        std::to_string(nodes) + " nodes, but " + std::to_string(lines) +
        " lines follow; copy the file again or correct the numbers.");
    }
    this->readNodes(nodes);
    this->readElements(elements);
    return std::move(this->Grid);
  }

  /// Call after read(): the open boundaries, then the land boundaries.
  void readBoundaries(AdcircGrid& grid)
  {
    for (const bool isLand : { false, true })
    {
      this->Rows.next(1, "the number of boundaries");
      const std::int64_t boundaries = this->Rows.integer(0);
      this->Rows.next(1, "the number of boundary nodes");
      for (std::int64_t i = 0; i < boundaries; ++i)
      {
        this->readBoundary(isLand, grid);
      }
    }
  }

  /// Brings another reader of the same text, which has read the title, to where this one is.
  void skipLinesOf(LineReader& lines) const
  {
    std::string_view line;
    while (lines.lineNumber() < this->Rows.lineNumber() && lines.next(line))
    {
    }
  }

private:
  void readBoundary(bool isLand, AdcircGrid& grid)
  {
    this->Rows.next(isLand ? 2 : 1, "the number of a boundary's nodes and its kind");
    const std::int64_t count = this->Rows.integer(0);
    const std::int64_t kind = isLand ? this->Rows.integer(1) % 10 : 0;
    constexpr std::int64_t island = 1;
    constexpr std::int64_t weir = 4; // 4 and 5: paired nodes on both sides of a weir
    const bool isWeir = kind == weir || kind == weir + 1;
    std::vector<std::int64_t> front;
    std::vector<std::int64_t> back;
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Rows.next(isWeir ? 2 : 1, "a node of a boundary");
      front.push_back(this->node(grid, 0));
      if (isWeir)
      {
        back.push_back(this->node(grid, 1));
      }
    }
    if (kind == island && !front.empty() && front.front() != front.back())
    {
      front.push_back(front.front());
    }
    for (const auto& nodes : { front, back })
    {
      for (std::size_t i = 1; i < nodes.size(); ++i)
      {
        grid.BoundaryEdges.push_back({ nodes[i - 1], nodes[i] });
      }
    }
  }

  std::int64_t node(const AdcircGrid& grid, std::size_t field) const
  {
    const std::int64_t number = this->Rows.integer(field);
    const auto node = grid.IndexOf.find(number);
    if (node == grid.IndexOf.end())
    {
      this->Rows.fail("names node " + std::to_string(number) + ", which is not given.");
    }
    return node->second;
  }

  void readNodes(std::int64_t count)
  {
    this->Grid.XY.reserve(2 * std::size_t(count));
    this->Grid.Depth.reserve(std::size_t(count));
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Rows.next(4, "a node");
      const std::int64_t number = this->Rows.integer(0);
      if (!this->Grid.IndexOf.emplace(number, i).second)
      {
        this->Rows.fail("node " + std::to_string(number) + " is given twice.");
      }
      this->Grid.XY.push_back(this->Rows.number(1));
      this->Grid.XY.push_back(this->Rows.number(2));
      this->Grid.Depth.push_back(this->Rows.number(3));
    }
  }

  void readElements(std::int64_t count)
  {
    this->Grid.Triangles.reserve(3 * std::size_t(count));
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Rows.next(5, "an element");
      if (this->Rows.integer(1) != 3)
      {
        this->Rows.fail("holds an element that is not a triangle; only triangles can be read.");
      }
      for (std::size_t corner = 2; corner < 5; ++corner)
      {
        this->Grid.Triangles.push_back(this->node(this->Grid, corner));
      }
    }
  }

  AdcircRows Rows;
  AdcircGrid Grid;
};

} // namespace

AdcircGrid readAdcircGrid(const std::string& path)
{
  const std::string text = readTextFile(path);
  return AdcircReader(path, text).read();
}

AdcircFrame readAdcircFrame(const std::string& path)
{
  const std::string text = readTextFile(path);
  AdcircReader reader(path, text);
  const AdcircGrid grid = reader.read();
  AdcircFrame frame;
  LineReader lines(text);
  std::string_view line;
  lines.next(line);
  frame.Title = line;
  frame.NodeNumbers.resize(grid.IndexOf.size());
  for (const auto& [number, index] : grid.IndexOf)
  {
    frame.NodeNumbers[std::size_t(index)] = number;
  }
  reader.skipLinesOf(lines);
  while (lines.next(line))
  {
    frame.Boundaries += std::string(line) + "\n";
  }
  return frame;
}

AdcircGrid readAdcircGridAndBoundaries(const std::string& path)
{
  const std::string text = readTextFile(path);
  AdcircReader reader(path, text);
  AdcircGrid grid = reader.read();
  reader.readBoundaries(grid);
  return grid;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircGrid.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Files/TextFile.h"
#include "Points/ReadPoints.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

namespace
{

class AdcircReader
{
public:
  explicit AdcircReader(const std::string& path)
    : Rows(path, "an ADCIRC grid")
  {
  }

  AdcircGrid read(bool readsBoundaries)
  {
    this->Grid.Title = this->Rows.title();
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
    LineReader boundaries(this->Rows.rest());
    for (std::string_view line; boundaries.next(line);)
    {
      this->Grid.Boundaries.append(line) += '\n';
    }
    readsBoundaries ? this->readBoundaries() : void();
    return std::move(this->Grid);
  }

private:
  /// Reads the open boundaries, then the land boundaries.
  void readBoundaries()
  {
    for (const bool isLand : { false, true })
    {
      this->Rows.next(1, "the number of boundaries");
      const std::int64_t boundaries = this->Rows.integer(0);
      this->Rows.next(1, "the number of boundary nodes");
      for (std::int64_t i = 0; i < boundaries; ++i)
      {
        this->readBoundary(isLand);
      }
    }
    this->closeWeirs();
  }

  void readBoundary(bool isLand)
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
      front.push_back(this->node(0));
      if (isWeir)
      {
        back.push_back(this->node(1));
      }
    }
    if (kind == island && !front.empty() && front.front() != front.back())
    {
      front.push_back(front.front());
    }
    if (isWeir && !front.empty())
    {
      this->WeirEnds.push_back({ front.front(), back.front() });
      this->WeirEnds.push_back({ front.back(), back.back() });
    }
    for (const auto& nodes : { front, back })
    {
      for (std::size_t i = 1; i < nodes.size(); ++i)
      {
        this->Grid.BoundaryEdges.push_back({ nodes[i - 1], nodes[i] });
      }
    }
  }

  /// The two sides of a weir are continued by other boundaries; where they are not, an edge is
  /// added between their ends.
  void closeWeirs()
  {
    std::unordered_map<std::int64_t, int> degrees;
    for (const auto& edge : this->Grid.BoundaryEdges)
    {
      ++degrees[edge[0]];
      ++degrees[edge[1]];
    }
    for (const auto& ends : this->WeirEnds)
    {
      if (ends[0] != ends[1] && degrees[ends[0]] % 2 != 0 && degrees[ends[1]] % 2 != 0)
      {
        this->Grid.BoundaryEdges.push_back(ends);
        ++degrees[ends[0]];
        ++degrees[ends[1]];
      }
    }
  }

  std::int64_t node(std::size_t field) const
  {
    const std::int64_t number = this->Rows.integer(field);
    const auto node = this->Grid.IndexOf.find(number);
    if (node == this->Grid.IndexOf.end())
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
        this->Grid.Triangles.push_back(this->node(corner));
      }
    }
  }

  NumberRows Rows;
  AdcircGrid Grid;
  std::vector<std::array<std::int64_t, 2>> WeirEnds; ///< pairs of opposite nodes
};

} // namespace

AdcircGrid readAdcircGrid(const std::string& path)
{
  return AdcircReader(path).read(false);
}

AdcircGrid readAdcircGridAndBoundaries(const std::string& path)
{
  return AdcircReader(path).read(true);
}

namespace
{

constexpr const char* noBoundaries = "0 = number of open boundaries\n"
                                     "0 = total number of open boundary nodes\n"
                                     "0 = number of land boundaries\n"
                                     "0 = total number of land boundary nodes\n";

void append(std::string& line, double value)
{
  char text[32];
  line += ' ';
  line.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::vector<double> depthsOf(const PointTable& points)
{
  const std::vector<std::string> names = points.names();
  const auto depth = std::find_if(
    names.begin(), names.end(), [](const std::string& name) { return lowerCase(name) == "depth"; });
  if (depth != names.end())
  {
    return points.Columns[std::size_t(depth - names.begin())].Values;
  }
  std::vector<double> depths(points.size(), 0);
  const std::size_t elevation = findElevation(names);
  if (elevation < names.size())
  {
    const std::vector<double>& z = points.Columns[elevation].Values;
    std::transform(z.begin(), z.end(), depths.begin(), [](double value) { return 0 - value; });
  }
  return depths;
}

/// The numbers of a grid's nodes, in the order of the file `path`, and of further nodes up to
/// `points`. Throws IOError if these would exceed 64 bits.
std::vector<std::int64_t> nodeNumbers(
  const std::string& path, const AdcircGrid& grid, std::size_t points)
{
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  std::vector<std::int64_t> numbers(grid.IndexOf.size());
  std::int64_t last = numbers.empty() ? 0 : std::numeric_limits<std::int64_t>::min();
  for (const auto& [number, index] : grid.IndexOf)
  {
    numbers[std::size_t(index)] = number;
    last = std::max(last, number);
  }
  while (numbers.size() < points)
  {
    if (last == most)
    {
      throw IOError(path,
        "has the largest node number possible, so new nodes cannot be numbered; renumber its "
        "nodes.");
    }
    numbers.push_back(++last);
  }
  return numbers;
}

} // namespace

bool isAdcircFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".14" || extension == ".grd";
}

bool writeAdcircGrid(const std::string& path, const PointTable& points, TrianglesView triangles,
  const std::string& like, const std::optional<PathState>& before,
  const std::function<bool()>& aborted)
{
  AdcircGrid frame; // its title, node numbers and boundaries are written
  frame.Title = "Triangles made by tipp";
  if (!like.empty())
  {
    frame = readAdcircGrid(like);
  }
  const std::vector<std::int64_t> numbers = nodeNumbers(like, frame, points.size());
  const std::vector<double> depths = depthsOf(points);
  PendingFile pending(path, before);
  OutputStream out(pending.file());
  out << frame.Title << "\n" << triangles.size() << " " << points.size() << "\n";
  std::string line;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!std::isfinite(points.XY[2 * i]) || !std::isfinite(points.XY[2 * i + 1]))
    {
      throw IOError(path,
        "cannot hold point " + std::to_string(i) +
          ", whose coordinates are not finite; remove it, or write .vtu.");
    }
    line = std::to_string(numbers[i]);
    append(line, points.XY[2 * i]);
    append(line, points.XY[2 * i + 1]);
    append(line, depths[i]);
    out << line << "\n";
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    line = std::to_string(t + 1) + " 3";
    for (int corner = 0; corner < 3; ++corner)
    {
      line += ' ' + std::to_string(numbers[std::size_t(triangles.id(t, corner))]);
    }
    out << line << "\n";
  }
  out << (frame.Boundaries.empty() ? noBoundaries : frame.Boundaries);
  out.finish();
  if (aborted && aborted())
  {
    return false;
  }
  pending.commit();
  return true;
}

namespace
{

/// Values at the nodes of an ADCIRC grid (https://adcirc.org; fort.63, fort.64, maxele.63 ...): a
/// title; the numbers of steps and nodes, two unused numbers, and the number of values per node;
/// for each step a line of time and time step, and a line `node value...` per node. A step may give
/// a number of nodes and a default value on its first line, and then only the nodes that differ.
/// Nodes are identified by the grid's node numbers. A file with fewer steps than announced, as from
/// an interrupted run, is rejected.
struct AdcircValues
{
  int Components = 1;        ///< values per node
  std::vector<double> Times; ///< times of the steps, in seconds
  std::vector<double>
    Values; ///< step by step, in the order of the grid's nodes; -99999 at dry nodes
};

/// Reads a file of AdcircValues. The constructor and read() throw IOError if the file cannot be
/// read or its values belong to another grid.
class ValuesReader
{
public:
  ValuesReader(const std::string& path, const AdcircGrid& grid)
    : Grid(grid)
    , Rows(path, "ADCIRC's output in ASCII")
  {
  }

  AdcircValues read()
  {
    this->Rows.title();
    this->Rows.next(5, "the numbers of steps, nodes and values");
    const std::int64_t steps = this->Rows.integer(0);
    this->Nodes = this->Rows.integer(1);
    const std::int64_t components = this->Rows.integer(4);
    const std::int64_t lines = this->Rows.remainingLines();
    // A step has at least one line; the number of its nodes is checked when it is read.
    if (steps < 1 || steps > lines || this->Nodes < 1 || this->Nodes > lines || components < 1 ||
      components > 3)
    {
      this->Rows.fail("announces " + std::to_string(steps) + " steps of " +
        std::to_string(this->Nodes) + " nodes with " + std::to_string(components) +
        " values, but " + std::to_string(lines) + " lines follow; copy the file again.");
    }
    if (std::size_t(this->Nodes) != this->Grid.Depth.size())
    {
      this->Rows.fail("gives values at " + std::to_string(this->Nodes) +
        " nodes, but the grid has " + std::to_string(this->Grid.Depth.size()) +
        "; name the grid that it belongs to.");
    }
    this->Result.Components = int(components);
    this->LastStep.assign(std::size_t(this->Nodes), -1);
    for (std::int64_t step = 0; step < steps; ++step)
    {
      this->readStep(step);
    }
    return std::move(this->Result);
  }

private:
  void readStep(std::int64_t step)
  {
    this->Rows.next(2, "a step");
    this->Result.Times.push_back(this->Rows.number(0));
    const bool sparse = this->Rows.fields() >= 4;
    const std::int64_t given = sparse ? this->Rows.integer(2) : this->Nodes;
    const std::int64_t lines = this->Rows.remainingLines();
    if (given < 0 || given > this->Nodes || given > lines)
    {
      this->Rows.fail("announces " + std::to_string(given) + " nodes, but " +
        std::to_string(lines) + " lines follow; copy the file again.");
    }
    const auto components = std::size_t(this->Result.Components);
    const std::size_t first = this->Result.Values.size();
    const double rest = sparse ? this->Rows.number(3) : 0;
    this->Result.Values.resize(first + std::size_t(this->Nodes) * components, rest);
    for (std::int64_t i = 0; i < given; ++i)
    {
      this->Rows.next(1 + components, "a node's values");
      const std::size_t node = this->nodeOf(this->Rows.integer(0), step);
      for (std::size_t c = 0; c < components; ++c)
      {
        this->Result.Values[first + node * components + c] = this->Rows.number(1 + c);
      }
    }
  }

  /// The index in the grid of a node number. A step may list a node only once.
  std::size_t nodeOf(std::int64_t number, std::int64_t step)
  {
    const auto node = this->Grid.IndexOf.find(number);
    if (node == this->Grid.IndexOf.end())
    {
      this->Rows.fail("names node " + std::to_string(number) +
        ", which the grid does not have; name the grid that it belongs to.");
    }
    std::int64_t& last = this->LastStep[std::size_t(node->second)];
    if (last == step)
    {
      this->Rows.fail(
        "gives node " + std::to_string(number) + " twice in a step; copy the file again.");
    }
    last = step;
    return std::size_t(node->second);
  }

  const AdcircGrid& Grid;
  NumberRows Rows;
  std::int64_t Nodes = 0;
  std::vector<std::int64_t> LastStep; ///< the last step that gave the node, or -1
  AdcircValues Result;
};

FlatArray floats(std::string name, std::vector<double> values, int components, std::int64_t tuples)
{
  const auto kept = std::make_shared<std::vector<double>>(std::move(values));
  return { std::move(name), Scalar::Float64, components, tuples, 0, kept->data(), kept };
}

/// The array's name. ADCIRC's own file names, such as fort.63, keep their extension, which
/// identifies the content.
std::string nameOf(const std::string& path)
{
  const std::filesystem::path file(path);
  return file.stem() == "fort" ? file.filename().string() : file.stem().string();
}

void addValues(const std::string& path, const AdcircGrid& grid, FlatContent& content)
{
  AdcircValues values = ValuesReader(path, grid).read();
  const std::int64_t nodes = content.Points.Tuples;
  FlatArray array = floats(nameOf(path), std::move(values.Values), values.Components, nodes);
  if (values.Times.size() > 1)
  {
    if (!content.Times.empty() && content.Times != values.Times)
    {
      throw IOError(path, "has other times than the file before it; flatten them one by one.");
    }
    content.Times = std::move(values.Times);
    array.Steps = std::int64_t(content.Times.size());
  }
  content.PointData.push_back(std::move(array));
}

} // namespace

FlatContent flattenAdcirc(const std::string& grid, const std::vector<std::string>& values)
{
  AdcircGrid read = readAdcircGrid(grid);
  FlatContent content;
  content.Cells = std::move(read.Triangles);
  const auto nodes = std::int64_t(read.Depth.size());
  content.Points = floats("points", std::move(read.XY), 2, nodes);
  content.PointData.push_back(floats("depth", read.Depth, 1, nodes));
  for (const std::string& path : values)
  {
    addValues(path, read, content);
  }
  return content;
}

} // namespace tipp

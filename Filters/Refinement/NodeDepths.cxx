// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/NodeDepths.h"

#include "Files/IOError.h"
#include "Files/PagedMemory.h"
#include "Parallel/Poll.h"
#include "Refinement/CellMeans.h"
#include "Refinement/NodeStrips.h"
#include "Refinement/StripPoints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

constexpr double notGiven = std::numeric_limits<double>::quiet_NaN();

/// Pixels of a strip and points of a block: 64 bytes each while they are located.
constexpr std::int64_t itemsAtOnce = std::int64_t(1) << 18;

/// The pixels around a position along one axis of a grid, of which `count` centres are at 0.5, 1.5
/// and so on.
struct Between
{
  std::int64_t Low;
  std::int64_t High; ///< the next pixel; Low at the borders
  double Fraction;   ///< from the centre of Low to that of High
};

std::optional<Between> pixelsAround(double position, std::int64_t count)
{
  if (!(position >= 0 && position <= double(count)))
  {
    return std::nullopt;
  }
  const double centre = position - 0.5;
  const double low = std::floor(centre);
  const auto index = std::int64_t(low);
  return Between{ std::max<std::int64_t>(index, 0), std::min(index + 1, count - 1), centre - low };
}

Point2 nodeAt(const MeshPart& part, std::size_t node)
{
  const double* const xyz = static_cast<const double*>(part.Mesh.Points) + 3 * node;
  return { xyz[0], xyz[1] };
}

/// Interpolates a raster at the nodes that a part owns while its rows are read from south to north.
class RasterAtNodes
{
public:
  RasterAtNodes(const MeshPart& part, const RasterGrid& grid)
    : Values(std::size_t(part.Mesh.PointCount), notGiven)
    , Part(part)
    , Grid(grid)
  {
    for (std::size_t node = 0; node < this->Values.size(); ++node)
    {
      const auto rows = this->rowsAt(node);
      if (part.owns(std::int64_t(node)) && rows && this->columnsAt(node))
      {
        this->ByRow.emplace_back(rows->Low, std::int64_t(node));
      }
    }
    std::sort(this->ByRow.begin(), this->ByRow.end());
  }

  /// Interpolates at the nodes all of whose rows are in the strip. Strips must overlap by a row.
  void take(const RasterWindow& strip, const std::vector<double>& values)
  {
    for (; this->Next < this->ByRow.size(); ++this->Next)
    {
      const auto node = std::size_t(this->ByRow[this->Next].second);
      const Between rows = *this->rowsAt(node);
      if (rows.High >= strip.Row + strip.Rows)
      {
        break;
      }
      this->Values[node] = this->interpolated(*this->columnsAt(node), rows, strip, values);
    }
  }

  std::vector<double> Values; ///< per node; NaN outside of the raster or where it has no values

private:
  std::optional<Between> columnsAt(std::size_t node) const
  {
    return pixelsAround(
      (nodeAt(this->Part, node).x - this->Grid.West) / this->Grid.Pixel[0], this->Grid.Columns);
  }
  std::optional<Between> rowsAt(std::size_t node) const
  {
    return pixelsAround(
      (nodeAt(this->Part, node).y - this->Grid.South) / this->Grid.Pixel[1], this->Grid.Rows);
  }

  /// Pixels without a value are left out, and the weights of the others enlarged.
  static double interpolated(const Between& columns, const Between& rows, const RasterWindow& strip,
    const std::vector<double>& values)
  {
    double sum = 0;
    double total = 0;
    for (const bool isHigh : { false, true })
    {
      for (const bool isEast : { false, true })
      {
        const std::int64_t row = isHigh ? rows.High : rows.Low;
        const std::int64_t column = isEast ? columns.High : columns.Low;
        const double weight = (isHigh ? rows.Fraction : 1 - rows.Fraction) *
          (isEast ? columns.Fraction : 1 - columns.Fraction);
        const double value =
          values[std::size_t((row - strip.Row) * strip.Columns + column - strip.Column)];
        if (weight > 0 && std::isfinite(value))
        {
          sum += weight * value;
          total += weight;
        }
      }
    }
    return total > 0 ? sum / total : notGiven;
  }

  const MeshPart& Part;
  const RasterGrid Grid;
  std::vector<std::pair<std::int64_t, std::int64_t>> ByRow; ///< row and node, ascending
  std::size_t Next = 0;                                     ///< in ByRow
};

/// The pixels from which a range of coordinates can be interpolated, and one more on each side, as
/// first and number; the number is 0 if the range does not meet the raster.
std::pair<std::int64_t, std::int64_t> pixelsOver(
  double low, double high, double origin, double pixel, std::int64_t count)
{
  const double first = std::floor((low - origin) / pixel) - 2;
  const double last = std::floor((high - origin) / pixel) + 2;
  if (!(first < double(count) && last >= 0))
  {
    return { 0, 0 };
  }
  const auto begin = std::int64_t(std::max(first, 0.0));
  const auto end = std::int64_t(std::min(last + 1, double(count)));
  return { begin, end - begin };
}

/// The part of the raster over the nodes; without pixels if it is elsewhere.
RasterWindow windowOver(const MeshPart& part, const RasterGrid& grid)
{
  Box2 bounds = Box2::empty();
  for (std::int64_t node = 0; node < part.Mesh.PointCount; ++node)
  {
    bounds.extend(nodeAt(part, std::size_t(node)));
  }
  const auto [column, columns] =
    pixelsOver(bounds.Min.x, bounds.Max.x, grid.West, grid.Pixel[0], grid.Columns);
  const auto [row, rows] =
    pixelsOver(bounds.Min.y, bounds.Max.y, grid.South, grid.Pixel[1], grid.Rows);
  return { column, row, columns, rows };
}

/// The x of the pixels' centres in the window's columns.
std::vector<double> columnCentres(const RasterGrid& grid, const RasterWindow& window)
{
  std::vector<double> centres;
  for (std::int64_t column = window.Column; column < window.Column + window.Columns; ++column)
  {
    centres.push_back(gridPosition(grid.West, grid.Pixel[0], 2 * column + 1));
  }
  return centres;
}

/// Adds the pixels of a strip from row `firstRow` on to the means. `x`: of columnCentres().
void addPixels(const RasterGrid& grid, const RasterWindow& strip, std::int64_t firstRow,
  const std::vector<double>& x, const std::vector<double>& values, CellMeans& means)
{
  std::vector<Point3> centres;
  std::vector<double> known;
  for (std::int64_t row = firstRow; row < strip.Row + strip.Rows; ++row)
  {
    const double y = gridPosition(grid.South, grid.Pixel[1], 2 * row + 1);
    for (std::int64_t column = 0; column < strip.Columns; ++column)
    {
      const double value = values[std::size_t((row - strip.Row) * strip.Columns + column)];
      if (std::isfinite(value))
      {
        centres.push_back({ x[std::size_t(column)], y, 0 });
        known.push_back(value);
      }
    }
  }
  means.add(centres, known);
}

/// Reads a window of the raster, in strips from south to north that overlap by one row.
/// Calls take(strip, the first row that is new, values).
template <typename Take>
void forStrips(RasterValues& raster, const RasterWindow& whole, const Take& take)
{
  const std::int64_t rowsAtOnce = std::max<std::int64_t>(2, itemsAtOnce / whole.Columns);
  const std::int64_t end = whole.Row + whole.Rows;
  std::vector<double> values;
  for (std::int64_t row = whole.Row; row < end;)
  {
    poll();
    const std::int64_t below = row > whole.Row ? 1 : 0;
    RasterWindow strip = whole;
    strip.Row = row - below;
    strip.Rows = std::min(rowsAtOnce, end - strip.Row);
    values.resize(std::size_t(strip.Rows * strip.Columns));
    raster.read(strip, values.data());
    take(strip, row, values);
    row = strip.Row + strip.Rows;
  }
}

bool hasNoDepth(double value)
{
  return !std::isfinite(value);
}

/// Calls work(i) for the indices of nodes or triangles, which may be larger than memory.
template <typename Work>
void forAll(std::size_t count, const Work& work)
{
  constexpr std::size_t often = 1 << 16;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i % often == 0)
    {
      poll();
      keepMemoryLimits();
    }
    work(i);
  }
}

template <typename T>
Buffer<T> zeros(std::size_t size, PagedMemory* memory)
{
  Buffer<T> buffer = bufferIn<T>(memory, size);
  if (!memory) // else it has zeros, and they are nowhere yet
  {
    std::fill(buffer.begin(), buffer.end(), T(0));
  }
  return buffer;
}

/// Gives nodes without a value the mean of those of their triangles' other corners, in rounds: each
/// uses the values from before the round.
class NeighbourFill
{
public:
  NeighbourFill(TrianglesView triangles, Buffer<double>& values, PagedMemory* memory)
    : Triangles(triangles)
    , Values(values)
  {
    std::size_t missing = 0;
    forAll(values.size(), [&](std::size_t node) { missing += hasNoDepth(values[node]) ? 1 : 0; });
    if (missing == 0 || missing == values.size())
    {
      return;
    }
    std::size_t open = 0;
    forAll(triangles.size(), [&](std::size_t t) { open += this->isOpen(t) ? 1 : 0; });
    this->Open = bufferIn<std::int32_t>(memory, open);
    this->Sums = zeros<double>(values.size(), memory);
    this->Counts = zeros<std::int32_t>(values.size(), memory);
    this->Reached = bufferIn<std::int32_t>(memory, missing);
    forAll(triangles.size(),
      [&](std::size_t t)
      {
        if (this->isOpen(t))
        {
          this->Open[this->OpenCount++] = std::int32_t(t);
        }
      });
  }

  /// Returns the number of nodes that got a value.
  std::int64_t run()
  {
    std::int64_t filled = 0;
    for (bool isDone = this->OpenCount == 0; !isDone; isDone = this->ReachedCount == 0)
    {
      this->ReachedCount = 0;
      forAll(this->OpenCount, [this](std::size_t i) { this->add(std::size_t(this->Open[i])); });
      forAll(this->ReachedCount,
        [this](std::size_t i)
        {
          const auto node = std::size_t(this->Reached[i]);
          this->Values[node] = this->Sums[node] / this->Counts[node];
        });
      filled += std::int64_t(this->ReachedCount);
      this->dropFilled();
    }
    return filled;
  }

private:
  std::size_t node(std::size_t t, int corner) const
  {
    return std::size_t(this->Triangles.id(t, corner));
  }
  double valueAt(std::size_t t, int corner) const { return this->Values[this->node(t, corner)]; }
  /// Whether a corner has no value.
  bool isOpen(std::size_t t) const
  {
    return hasNoDepth(this->valueAt(t, 0)) || hasNoDepth(this->valueAt(t, 1)) ||
      hasNoDepth(this->valueAt(t, 2));
  }

  /// Adds the values of a triangle's corners to the sums of its corners without one.
  void add(std::size_t t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const std::size_t to = this->node(t, corner);
      for (int i = 0; i < 3 && hasNoDepth(this->Values[to]); ++i)
      {
        if (!hasNoDepth(this->valueAt(t, i)))
        {
          if (this->Counts[to]++ == 0)
          {
            this->Reached[this->ReachedCount++] = std::int32_t(to);
          }
          this->Sums[to] += this->valueAt(t, i);
        }
      }
    }
  }

  void dropFilled()
  {
    std::size_t end = 0;
    forAll(this->OpenCount,
      [&](std::size_t i)
      {
        const std::int32_t t = this->Open[i];
        if (this->isOpen(std::size_t(t)))
        {
          this->Open[end++] = t;
        }
      });
    this->OpenCount = end;
  }

  const TrianglesView Triangles;
  Buffer<double>& Values;
  Buffer<std::int32_t> Open; ///< triangles with a corner without a value
  std::size_t OpenCount = 0;
  Buffer<double> Sums; ///< by node
  Buffer<std::int32_t> Counts;
  Buffer<std::int32_t> Reached; ///< the nodes that get a value in this round
  std::size_t ReachedCount = 0;
};

/// Completes depths: fills nodes without a value, and turns the axis downwards.
void completeDepths(TrianglesView triangles, const NodeDepthOptions& options, NodeDepths& depths)
{
  depths.FromOthers = NeighbourFill(triangles, depths.Values, options.Memory).run();
  forAll(depths.Values.size(),
    [&](std::size_t node)
    {
      double& value = depths.Values[node];
      depths.Missing += hasNoDepth(value) ? 1 : 0;
      value = options.Axis == VerticalAxis::Elevations ? 0 - value : value;
    });
}

/// Sets the depths of the nodes that a part owns: the mean over the node's cell or, where it has
/// none, the value at the node. Either may be null.
void storeDepths(const MeshPart& part, const CellMeans* means, const std::vector<double>* atNodes,
  NodeDepths& depths)
{
  forAll(std::size_t(part.Mesh.PointCount),
    [&](std::size_t node)
    {
      if (part.owns(std::int64_t(node)))
      {
        const double mean = means ? means->meanOf(node) : notGiven;
        const double there = atNodes ? (*atNodes)[node] : notGiven;
        depths.FromCells += hasNoDepth(mean) ? 0 : 1;
        depths.AtNodes += hasNoDepth(mean) && !hasNoDepth(there) ? 1 : 0;
        depths.Values[std::size_t(part.pointId(std::int64_t(node)))] =
          hasNoDepth(mean) ? there : mean;
      }
    });
}

/// Sets the depths of the nodes that a part owns from a raster.
void addFromRaster(const MeshPart& part, RasterValues& raster, NodeRule rule,
  const NodeDepthOptions& options, NodeDepths& depths)
{
  RasterAtNodes atNodes(part, raster.grid());
  std::optional<CellMeans> means;
  if (rule == NodeRule::CellMean)
  {
    means.emplace(part, options.Threads);
  }
  const RasterWindow window = windowOver(part, raster.grid());
  if (window.Columns > 0 && window.Rows > 0)
  {
    const std::vector<double> x = columnCentres(raster.grid(), window);
    forStrips(raster, window,
      [&](const RasterWindow& strip, std::int64_t firstRow, const std::vector<double>& values)
      {
        atNodes.take(strip, values);
        if (means)
        {
          addPixels(raster.grid(), strip, firstRow, x, values, *means);
        }
      });
  }
  storeDepths(part, means ? &*means : nullptr, &atNodes.Values, depths);
}

NodeStrips stripsOf(
  const NodesView& nodes, TrianglesView triangles, const NodeDepthOptions& options)
{
  return { nodes, triangles,
    options.Strips > 0 ? options.Strips : stripsFor(triangles.size(), options.Memory),
    options.Memory };
}

} // namespace

NodeDepths depthsFromRaster(const NodesView& nodes, TrianglesView triangles, RasterValues& raster,
  NodeRule rule, const NodeDepthOptions& options)
{
  const NodeStrips strips = stripsOf(nodes, triangles, options);
  NodeDepths depths;
  depths.Values = bufferIn<double>(options.Memory, nodes.size());
  std::fill(depths.Values.begin(), depths.Values.end(), notGiven); // also at unused nodes
  for (std::size_t strip = 0; strip < strips.size(); ++strip)
  {
    addFromRaster(strips.part(strip), raster, rule, options, depths);
  }
  completeDepths(triangles, options, depths);
  return depths;
}

NodeDepths depthsFromPoints(const NodesView& nodes, TrianglesView triangles, PointStream& points,
  const std::string& column, const NodeDepthOptions& options)
{
  const std::vector<std::string> names = points.columns();
  const auto found = std::find(names.begin(), names.end(), column);
  if (found == names.end())
  {
    throw IOError("The points have no column '" + column + "' for the depths" +
      listOfNames({ names.begin(), names.end() }, "; there are ") + ".");
  }
  const auto index = std::size_t(found - names.begin());
  const NodeStrips strips = stripsOf(nodes, triangles, options);
  StripPoints stored(strips, points, index, options.Memory);
  NodeDepths depths;
  depths.Values = bufferIn<double>(options.Memory, nodes.size());
  std::fill(depths.Values.begin(), depths.Values.end(), notGiven); // also at unused nodes
  for (std::size_t strip = 0; strip < strips.size(); ++strip)
  {
    const MeshPart part = strips.part(strip);
    CellMeans means(part, options.Threads);
    stored.forBlocks(strip, std::size_t(itemsAtOnce),
      [&](const std::vector<Point3>& positions, const std::vector<double>& known)
      { means.add(positions, known); });
    storeDepths(part, &means, nullptr, depths);
  }
  completeDepths(triangles, options, depths);
  return depths;
}

} // namespace tipp

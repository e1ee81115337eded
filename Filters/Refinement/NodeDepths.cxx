// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/NodeDepths.h"

#include "Files/IOError.h"
#include "Parallel/Poll.h"
#include "Refinement/CellMeans.h"

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

/// Interpolates a raster at nodes while its rows are read from south to north.
class RasterAtNodes
{
public:
  RasterAtNodes(const std::vector<double>& xy, const RasterGrid& grid)
    : Values(xy.size() / 2, notGiven)
    , XY(xy)
    , Grid(grid)
  {
    for (std::size_t node = 0; node < this->Values.size(); ++node)
    {
      if (const auto rows = this->rowsAt(node); rows && this->columnsAt(node))
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
      (this->XY[2 * node] - this->Grid.West) / this->Grid.Pixel[0], this->Grid.Columns);
  }
  std::optional<Between> rowsAt(std::size_t node) const
  {
    return pixelsAround(
      (this->XY[2 * node + 1] - this->Grid.South) / this->Grid.Pixel[1], this->Grid.Rows);
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

  const std::vector<double>& XY;
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
RasterWindow windowOver(const std::vector<double>& xy, const RasterGrid& grid)
{
  Box2 bounds = Box2::empty();
  for (std::size_t i = 0; i < xy.size(); i += 2)
  {
    bounds.extend(Point2{ xy[i], xy[i + 1] });
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

/// Gives nodes without a value the mean of those of their triangles' other corners, in rounds: each
/// uses the values from before the round. Returns the number of nodes that got one.
std::int64_t fillFromNeighbours(TrianglesView triangles, std::vector<double>& values)
{
  std::vector<std::size_t> open; // triangles with a corner without a value
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    open.push_back(t);
  }
  std::vector<double> sums(values.size(), 0);
  std::vector<std::int32_t> counts(values.size(), 0);
  std::int64_t filled = 0;
  for (bool isDone = false; !isDone;)
  {
    poll();
    const auto valueAt = [&](std::size_t t, int corner)
    { return values[std::size_t(triangles.id(t, corner))]; };
    open.erase(std::remove_if(open.begin(), open.end(),
                 [&](std::size_t t) {
                   return !hasNoDepth(valueAt(t, 0)) && !hasNoDepth(valueAt(t, 1)) &&
                     !hasNoDepth(valueAt(t, 2));
                 }),
      open.end());
    std::vector<std::size_t> reached;
    for (const std::size_t t : open)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const auto node = std::size_t(triangles.id(t, corner));
        for (int i = 0; i < 3 && hasNoDepth(values[node]); ++i)
        {
          if (!hasNoDepth(valueAt(t, i)))
          {
            if (counts[node]++ == 0)
            {
              reached.push_back(node);
            }
            sums[node] += valueAt(t, i);
          }
        }
      }
    }
    for (const std::size_t node : reached)
    {
      values[node] = sums[node] / counts[node];
    }
    filled += std::int64_t(reached.size());
    isDone = reached.empty();
  }
  return filled;
}

/// Completes depths: fills nodes without a value, and turns the axis downwards.
void completeDepths(TrianglesView triangles, const NodeDepthOptions& options, NodeDepths& depths)
{
  depths.FromOthers = fillFromNeighbours(triangles, depths.Values);
  for (double& value : depths.Values)
  {
    depths.Missing += hasNoDepth(value) ? 1 : 0;
    value = options.Axis == VerticalAxis::Elevations ? 0 - value : value;
  }
}

} // namespace

NodeDepths depthsFromRaster(const std::vector<double>& xy, TrianglesView triangles,
  RasterValues& raster, NodeRule rule, const NodeDepthOptions& options)
{
  RasterAtNodes atNodes(xy, raster.grid());
  std::optional<CellMeans> means;
  if (rule == NodeRule::CellMean)
  {
    means.emplace(xy, triangles, options.Threads);
  }
  const RasterWindow window = windowOver(xy, raster.grid());
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
  NodeDepths depths;
  depths.Values = std::move(atNodes.Values);
  for (std::size_t node = 0; node < depths.Values.size(); ++node)
  {
    const double mean = means ? means->meanOf(node) : notGiven;
    depths.FromCells += hasNoDepth(mean) ? 0 : 1;
    depths.AtNodes += hasNoDepth(mean) && !hasNoDepth(depths.Values[node]) ? 1 : 0;
    depths.Values[node] = hasNoDepth(mean) ? depths.Values[node] : mean;
  }
  completeDepths(triangles, options, depths);
  return depths;
}

NodeDepths depthsFromPoints(const std::vector<double>& xy, TrianglesView triangles,
  PointStream& points, const std::string& column, const NodeDepthOptions& options)
{
  const std::vector<std::string> names = points.columns();
  const auto found = std::find(names.begin(), names.end(), column);
  if (found == names.end())
  {
    throw IOError("The points have no column '" + column + "' for the depths" +
      listOfNames({ names.begin(), names.end() }, "; there are ") + ".");
  }
  const auto index = std::size_t(found - names.begin());
  CellMeans means(xy, triangles, options.Threads);
  std::vector<Point3> positions;
  std::vector<double> known;
  forEachBlock(points, std::size_t(itemsAtOnce),
    [&](PointBlock& block)
    {
      positions.clear();
      known.clear();
      for (std::size_t i = 0; i < block.size(); ++i)
      {
        if (std::isfinite(block.Columns[index][i]))
        {
          positions.push_back({ block.XY[2 * i], block.XY[2 * i + 1], 0 });
          known.push_back(block.Columns[index][i]);
        }
      }
      means.add(positions, known);
    });
  NodeDepths depths;
  depths.Values.resize(xy.size() / 2);
  for (std::size_t node = 0; node < depths.Values.size(); ++node)
  {
    depths.Values[node] = means.meanOf(node);
    depths.FromCells += hasNoDepth(depths.Values[node]) ? 0 : 1;
  }
  completeDepths(triangles, options, depths);
  return depths;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/SizeRules.h"

#include "Locate/BoxTree.h"
#include "Predicates/Angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace tipp
{
namespace
{

constexpr double pi = 3.14159265358979323846;
using Segment = std::array<Point2, 2>;

/// The squared distance of a point from a segment, where a unit of x and y has these lengths.
double squaredDistance(Point2 p, const Segment& segment, double unitX, double unitY)
{
  const Point2 a{ (segment[0].x - p.x) * unitX, (segment[0].y - p.y) * unitY };
  const Point2 edge{ (segment[1].x - segment[0].x) * unitX, (segment[1].y - segment[0].y) * unitY };
  const double squared = edge.x * edge.x + edge.y * edge.y;
  const double along = squared > 0 ? -(a.x * edge.x + a.y * edge.y) / squared : 0;
  const double share = std::min(std::max(along, 0.0), 1.0);
  const Point2 apart{ a.x + share * edge.x, a.y + share * edge.y };
  return apart.x * apart.x + apart.y * apart.y;
}

/// Limits sizes by the distance to the nearest segment, tile by tile of nodes: one search finds the
/// few segments that may be nearest to a node of a tile. Distances are counted in steps between
/// rows, so that their squares do not overflow.
class DistanceLimit
{
public:
  static constexpr int Side = 8; ///< of a tile, in nodes

  DistanceLimit(const SizeLattice& lattice, const std::vector<Segment>& segments, double least,
    double dis, int threads, std::vector<double>& sizes)
    : Nodes(lattice)
    , Segments(segments)
    , Least(least)
    , PerStep(dis * lattice.stepY())
    , UnitY(lattice.unitY() / lattice.stepY())
    , TreeUnitX(lattice.middleUnitX() / lattice.stepY())
    , Tree(std::int64_t(segments.size()), threadCount(threads),
        [this](std::int64_t i)
        {
          const Segment& segment = this->Segments[std::size_t(i)];
          return Box2::of(this->placed(segment[0]), this->placed(segment[1]));
        })
    , Sizes(sizes)
  {
  }

  int tilesAcross() const { return (this->Nodes.columns() + Side - 1) / Side; }
  std::int64_t tiles() const
  {
    return std::int64_t(this->tilesAcross()) * ((this->Nodes.rows() + Side - 1) / Side);
  }

  /// A segment, and its distance from the centre of a tile.
  struct Near
  {
    double Distance;
    std::int32_t Segment;
  };

  /// `found` is memory that calls on the same thread share.
  void limitTile(std::int64_t number, std::vector<Near>& found)
  {
    const Tile tile = this->tileOf(number);
    this->findSegments(tile, found);
    for (int row = tile.Row; row < tile.RowEnd && !found.empty(); ++row)
    {
      for (int column = tile.Column; column < tile.ColumnEnd; ++column)
      {
        const double distance = this->distanceFrom(tile, column, row, found);
        double& size = this->Sizes[this->Nodes.index(column, row)];
        size = std::min(size, this->Least + this->PerStep * distance);
      }
    }
  }

private:
  struct Tile
  {
    int Column;
    int Row;
    int ColumnEnd;
    int RowEnd;
    Point2 Centre;
    double UnitX; ///< the length of a unit of x at the centre, in steps
    double Reach; ///< how far nodes may be from the centre
    double Ratio; ///< how much longer a distance may be at one row than at another
    double Most;  ///< farther segments lower no size of the tile
  };

  double unitX(int row) const { return this->Nodes.unitX(row) / this->Nodes.stepY(); }
  Point2 placed(Point2 p) const { return { p.x * this->TreeUnitX, p.y * this->UnitY }; }
  double squaredFrom(Point2 p, std::int32_t segment, double unitX) const
  {
    return squaredDistance(p, this->Segments[std::size_t(segment)], unitX, this->UnitY);
  }

  /// Returns the distance of a node from the nearest of the segments, which are sorted by their
  /// distance from the tile's centre.
  double distanceFrom(
    const Tile& tile, int column, int row, const std::vector<Near>& segments) const
  {
    const Point2 node = this->Nodes.at(column, row);
    const double unitX = this->unitX(row);
    const double offset =
      std::hypot((node.x - tile.Centre.x) * tile.UnitX, (node.y - tile.Centre.y) * this->UnitY);
    double squared = std::numeric_limits<double>::infinity();
    double wanted = squared; // farther segments from the centre are farther from the node
    for (const Near& near : segments)
    {
      if (near.Distance > wanted)
      {
        break;
      }
      const double other = this->squaredFrom(node, near.Segment, unitX);
      if (other < squared)
      {
        squared = other;
        wanted = (std::sqrt(squared) * tile.Ratio + offset) * Rounding;
      }
    }
    return std::sqrt(squared);
  }

  Tile tileOf(std::int64_t number) const
  {
    Tile tile{};
    tile.Column = int(number % this->tilesAcross()) * Side;
    tile.Row = int(number / this->tilesAcross()) * Side;
    tile.ColumnEnd = std::min(tile.Column + Side, this->Nodes.columns());
    tile.RowEnd = std::min(tile.Row + Side, this->Nodes.rows());
    const int middle = (tile.Row + tile.RowEnd) / 2;
    const Point2 low = this->Nodes.at(tile.Column, tile.Row);
    const Point2 high = this->Nodes.at(tile.ColumnEnd - 1, tile.RowEnd - 1);
    tile.Centre = Box2{ low, high }.center();
    tile.UnitX = this->unitX(middle);
    tile.Reach = std::hypot((high.x - low.x) / 2 * tile.UnitX, (high.y - low.y) / 2 * this->UnitY);
    double least = tile.UnitX;
    double most = tile.UnitX;
    for (int row = tile.Row; row < tile.RowEnd; ++row)
    {
      least = std::min(least, this->unitX(row));
      most = std::max(most, this->unitX(row));
      for (int column = tile.Column; column < tile.ColumnEnd; ++column)
      {
        const double size = this->Sizes[this->Nodes.index(column, row)];
        tile.Most = std::max(tile.Most, (size - this->Least) / this->PerStep);
      }
    }
    tile.Ratio = most / least;
    return tile;
  }

  /// Finds the segments that may be the nearest of a node of the tile and lower its size. If the
  /// centre is at the distance d from the nearest segment, that of a node is at most d and twice
  /// the reach from the centre, all but for the ratio.
  void findSegments(const Tile& tile, std::vector<Near>& found) const
  {
    found.clear();
    if (!(tile.Most > 0))
    {
      return;
    }
    double wanted = (tile.Most * tile.Ratio + tile.Reach) * Rounding;
    // The tree has the lengths of the middle row of all, which may be longer than here.
    const double treeRatio = std::min(tile.UnitX / this->TreeUnitX, 1.0);
    this->Tree.searchNear(
      this->placed(tile.Centre),
      [&](std::int32_t i)
      {
        const double distance = std::sqrt(this->squaredFrom(tile.Centre, i, tile.UnitX));
        wanted = std::min(wanted, ((distance + tile.Reach) * tile.Ratio + tile.Reach) * Rounding);
        found.push_back({ distance, i });
        return wanted / treeRatio;
      },
      wanted / treeRatio);
    found.erase(std::remove_if(found.begin(), found.end(),
                  [wanted](const Near& near) { return !(near.Distance <= wanted); }),
      found.end());
    std::sort(found.begin(), found.end(),
      [](const Near& a, const Near& b) { return a.Distance < b.Distance; });
  }

  static constexpr double Rounding = 1 + 1e-12; ///< covers the rounding of bounds

  const SizeLattice& Nodes;
  const std::vector<Segment>& Segments;
  double Least;
  double PerStep; ///< by how much a size may grow in a step
  double UnitY;   ///< the length of a unit of y, in steps
  double TreeUnitX;
  BoxTree<2> Tree;
  std::vector<double>& Sizes;
};

} // namespace

void limitByDistance(const SizeLattice& lattice, const std::vector<Segment>& segments, double least,
  double dis, int threads, const Report& report, std::vector<double>& sizes)
{
  DistanceLimit limit(lattice, segments, least, dis, threads, sizes);
  std::vector<std::vector<DistanceLimit::Near>> found(std::size_t(threadCount(threads)));
  constexpr std::int64_t chunk = 64;
  const bool isComplete = forChunks(limit.tiles(), chunk, threadCount(threads), report,
    [&](std::int64_t begin, std::int64_t end, int thread)
    {
      for (std::int64_t tile = begin; tile < end; ++tile)
      {
        limit.limitTile(tile, found[std::size_t(thread)]);
      }
    });
  if (!isComplete)
  {
    throw WorkAborted();
  }
}

double sizeByWavelength(double depth, double elements)
{
  constexpr double period = 12.42 * 3600; // seconds
  constexpr double gravity = 9.81;        // metres per square second
  return period * std::sqrt(gravity * std::max(depth, LeastDepth)) / elements;
}

void limitByWavelength(const SizeLattice& lattice, const std::vector<double>& depths,
  double elements, int threads, const Report& report, std::vector<double>& sizes)
{
  forRows(lattice, threads, report,
    [&](int row)
    {
      for (int column = 0; column < lattice.columns(); ++column)
      {
        const std::size_t node = lattice.index(column, row);
        sizes[node] = std::min(sizes[node], sizeByWavelength(depths[node], elements));
      }
    });
}

void limitBySlope(const SizeLattice& lattice, const std::vector<double>& depths, double slp,
  int threads, const Report& report, std::vector<double>& sizes)
{
  const auto slope = [&](int beforeX, int beforeY, int afterX, int afterY, double distance)
  {
    return (depths[lattice.index(afterX, afterY)] - depths[lattice.index(beforeX, beforeY)]) /
      distance;
  };
  forRows(lattice, threads, report,
    [&](int row)
    {
      const int south = std::max(row - 1, 0);
      const int north = std::min(row + 1, lattice.rows() - 1);
      for (int column = 0; column < lattice.columns(); ++column)
      {
        const int west = std::max(column - 1, 0);
        const int east = std::min(column + 1, lattice.columns() - 1);
        const double x = slope(west, row, east, row, (east - west) * lattice.stepX(row));
        const double y = slope(column, south, column, north, (north - south) * lattice.stepY());
        const double steepness = std::hypot(x, y);
        const std::size_t node = lattice.index(column, row);
        if (steepness > 0)
        {
          const double depth = std::max(depths[node], LeastDepth);
          sizes[node] = std::min(sizes[node], 2 * pi * depth / (slp * steepness));
        }
      }
    });
}

namespace
{

/// What steps cost by which a size may grow.
struct StepCosts
{
  double Along;    ///< in a row
  double Across;   ///< to the next row
  double Diagonal; ///< to the next row and column
};

StepCosts costsOf(double stepX, double stepY, double g)
{
  const double angle = degreesOf(stepX, stepY);
  const double rate = g * cosineOfDegrees(std::max(angle, 90 - angle) / 2);
  return { rate * stepX, rate * stepY, rate * std::hypot(stepX, stepY) };
}

void lower(double limit, double& size, bool& isChanged)
{
  isChanged = isChanged || limit < size;
  size = std::min(limit, size);
}

/// Limits sizes along a row, both ways. Returns whether one has changed.
bool sweepAlong(double* sizes, int columns, double cost)
{
  bool isChanged = false;
  for (int i = 1; i < columns; ++i)
  {
    lower(sizes[i - 1] + cost, sizes[i], isChanged);
  }
  for (int i = columns - 2; i >= 0; --i)
  {
    lower(sizes[i + 1] + cost, sizes[i], isChanged);
  }
  return isChanged;
}

/// Limits sizes of a row by those of a neighbouring one. Returns whether one has changed.
bool sweepAcross(const double* from, double* to, int columns, const StepCosts& costs)
{
  bool isChanged = false;
  for (int i = 0; i < columns; ++i)
  {
    const double west = from[std::max(i - 1, 0)] + costs.Diagonal;
    const double east = from[std::min(i + 1, columns - 1)] + costs.Diagonal;
    lower(std::min({ from[i] + costs.Across, west, east }), to[i], isChanged);
  }
  return isChanged;
}

/// Limits sizes once, row by row to the north or back.
class GradationPass
{
public:
  GradationPass(const SizeLattice& lattice, double g, std::vector<double>& sizes)
    : Columns(lattice.columns())
    , Rows(lattice.rows())
    , Sizes(sizes)
  {
    for (int row = 0; row < this->Rows; ++row)
    {
      // The costs of a step between rows are those at the shorter one.
      const double nextX = lattice.stepX(std::min(row + 1, this->Rows - 1));
      const double x = std::min(lattice.stepX(row), nextX);
      this->Costs.push_back(costsOf(x, lattice.stepY(), g));
    }
  }

  /// `isWanted(rows)`, called with the number of rows that are done, returns whether to go on.
  /// Returns whether a size has changed.
  template <typename IsWanted>
  bool run(bool isNorthward, const IsWanted& isWanted)
  {
    bool isChanged = false;
    for (int done = 0; done < this->Rows; ++done)
    {
      const int row = isNorthward ? done : this->Rows - 1 - done;
      const int before = isNorthward ? row - 1 : row + 1;
      if (done > 0)
      {
        const StepCosts& costs = this->Costs[std::size_t(std::min(row, before))];
        isChanged |= sweepAcross(this->rowAt(before), this->rowAt(row), this->Columns, costs);
      }
      isChanged |= sweepAlong(this->rowAt(row), this->Columns, this->Costs[std::size_t(row)].Along);
      if (!isWanted(done))
      {
        throw WorkAborted();
      }
    }
    return isChanged;
  }

private:
  double* rowAt(int row)
  {
    return this->Sizes.data() + std::size_t(row) * std::size_t(this->Columns);
  }

  int Columns;
  int Rows;
  std::vector<StepCosts> Costs; ///< by row: in it, and to the next one
  std::vector<double>& Sizes;
};

} // namespace

/// With equal costs two passes reach the result, and two more find that nothing changes. The result
/// is the same for any order, since it is the least over all paths.
void limitGradation(
  const SizeLattice& lattice, double g, const Report& report, std::vector<double>& sizes)
{
  GradationPass pass(lattice, g, sizes);
  double left = 1; // estimated share of the work that is left before a pass
  const auto run = [&](bool isNorthward)
  {
    const bool isChanged = pass.run(isNorthward,
      [&](int rows)
      { return !report || report(1 - left * (1 - 0.5 * rows / double(lattice.rows()))); });
    left /= 2;
    return isChanged;
  };
  for (bool isChanged = true; isChanged;)
  {
    isChanged = run(true);
    isChanged |= run(false);
  }
}

} // namespace tipp

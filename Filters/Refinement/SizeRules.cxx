// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/SizeRules.h"

#include "Locate/BoxTree.h"

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

/// The distance of a point from a segment, where a unit of x and y has these lengths.
double distanceFrom(Point2 p, const Segment& segment, double unitX, double unitY)
{
  const Point2 a{ (segment[0].x - p.x) * unitX, (segment[0].y - p.y) * unitY };
  const Point2 edge{ (segment[1].x - segment[0].x) * unitX, (segment[1].y - segment[0].y) * unitY };
  const double squared = edge.x * edge.x + edge.y * edge.y;
  const double along = squared > 0 ? -(a.x * edge.x + a.y * edge.y) / squared : 0;
  const double share = std::min(std::max(along, 0.0), 1.0);
  return std::hypot(a.x + share * edge.x, a.y + share * edge.y);
}

/// Finds distances to the nearest of many segments.
class NearestSegments
{
public:
  NearestSegments(const SizeLattice& lattice, const std::vector<Segment>& segments, int threads)
    : Nodes(lattice)
    , Segments(segments)
    , Tree(std::int64_t(segments.size()), threadCount(threads),
        [this](std::int64_t i)
        {
          const Segment& segment = this->Segments[std::size_t(i)];
          return Box2::of(this->placed(segment[0]), this->placed(segment[1]));
        })
  {
  }

  /// Returns the distance of a node from the nearest segment that is nearer than `most`, or `most`.
  /// `nearest` is that segment, or -1; if it is set before, that is where the search begins.
  double distance(int column, int row, double most, std::int64_t& nearest) const
  {
    const Point2 node = this->Nodes.at(column, row);
    const double unitX = this->Nodes.unitX(row);
    // The tree has the lengths of the middle row, so it may overestimate those of this row.
    const double ratio = std::min(unitX / this->Nodes.middleUnitX(), 1.0);
    double best = most;
    const auto compare = [&](std::int64_t i)
    {
      const double distance =
        distanceFrom(node, this->Segments[std::size_t(i)], unitX, this->Nodes.unitY());
      if (distance < best)
      {
        best = distance;
        nearest = i;
      }
    };
    if (nearest >= 0)
    {
      compare(nearest);
    }
    this->Tree.searchNear(
      this->placed(node),
      [&](std::int32_t i)
      {
        compare(i);
        return best / ratio;
      },
      best / ratio);
    return best;
  }

private:
  Point2 placed(Point2 p) const
  {
    return { p.x * this->Nodes.middleUnitX(), p.y * this->Nodes.unitY() };
  }

  const SizeLattice& Nodes;
  const std::vector<Segment>& Segments;
  BoxTree<2> Tree;
};

} // namespace

void limitByDistance(const SizeLattice& lattice, const std::vector<Segment>& segments, double least,
  double dis, int threads, const Report& report, std::vector<double>& sizes)
{
  const NearestSegments shoreline(lattice, segments, threads);
  forRows(lattice, threads, report,
    [&](int row)
    {
      std::int64_t nearest = -1; // also near the next node
      for (int column = 0; column < lattice.columns(); ++column)
      {
        double& size = sizes[lattice.index(column, row)];
        // A segment farther than this does not lower the size.
        const double most = (size - least) / dis;
        if (most > 0)
        {
          const double distance = shoreline.distance(column, row, most, nearest);
          size = std::min(size, least + dis * distance);
        }
      }
    });
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
  const double angle = std::atan2(stepY, stepX);
  const double rate = g * std::cos(std::max(angle, pi / 2 - angle) / 2);
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
  double* rowAt(int row) { return this->Sizes.data() + std::size_t(row) * std::size_t(Columns); }

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

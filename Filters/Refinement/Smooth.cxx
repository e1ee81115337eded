// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/Smooth.h"

#include "Arrays/FindNeighbors.h"
#include "Constraints/ConstraintEdges.h"
#include "Parallel/CountingSort.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Angles.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Vectors.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tipp
{
namespace
{

using Index = std::int32_t;

double squareOf(Point2 u)
{
  return u.x * u.x + u.y * u.y;
}

/// The squared sine of a triangle's smallest angle, which is opposite to its shortest edge.
/// `twice`: twice the area. 0 if that underflows.
double leastSineSquared(Point2 a, Point2 b, Point2 c, double twice)
{
  const double u = squareOf(b - a);
  const double v = squareOf(c - b);
  const double w = squareOf(a - c);
  const double product = u * v * w;
  return product > 0 ? twice * twice * std::min(std::min(u, v), w) / product : 0;
}

class Smoother
{
public:
  Smoother(PointsView points, const RefinementOptions& options, RefinedMesh& mesh)
    : Points(points)
    , Options(options)
    , Mesh(mesh)
    , Threads(threadCount(options.Threads))
    , Segments(mesh.Segments)
    , Neighbors(mesh.Triangles.size())
  {
    const double sine = sineOfDegrees(options.MinimumAngle);
    this->LeastSineSquared = sine * sine * (1 + 1e-12); // rounding must not hide an angle
    findNeighbors(mesh.Triangles.data(), mesh.triangleCount(), this->Neighbors.data());
    this->findMovable();
    this->collectStars();
    this->assignColours();
  }

  void run(int rounds);

private:
  /// A corner of a triangle is given by its index among all corners.
  static std::size_t nextCorner(std::size_t slot) { return slot % 3 == 2 ? slot - 2 : slot + 1; }
  static std::size_t previousCorner(std::size_t slot)
  {
    return slot % 3 == 0 ? slot + 2 : slot - 1;
  }

  Index vertexAt(std::size_t slot) const { return this->Mesh.Triangles[slot]; }
  bool isAdded(Index vertex) const { return std::size_t(vertex) >= this->Points.size(); }
  std::size_t added(Index vertex) const { return std::size_t(vertex) - this->Points.size(); }
  Point2 at(Index vertex) const
  {
    if (!this->isAdded(vertex))
    {
      return this->Points[std::size_t(vertex)];
    }
    const double* const xy = this->Mesh.AddedXY.data() + 2 * this->added(vertex);
    return { xy[0], xy[1] };
  }

  /// The corner opposite to the edge that a corner is opposite to, in the triangle across; -1 if
  /// there is none.
  std::int64_t cornerAcross(std::size_t slot) const
  {
    const Index triangle = this->Neighbors[slot];
    if (triangle < 0)
    {
      return -1;
    }
    const Index from = this->vertexAt(nextCorner(slot));
    std::size_t across = 3 * std::size_t(triangle);
    while (this->vertexAt(nextCorner(nextCorner(across))) != from)
    {
      ++across;
    }
    return std::int64_t(across);
  }

  /// Whether p sees the point across a corner's edge outside of the circumcircle of its triangle.
  bool isDelaunayAcross(std::size_t slot, Point2 p, Point2 a, Point2 b) const
  {
    const std::int64_t across = this->cornerAcross(slot);
    return across < 0 || inCircle(p, a, b, this->at(this->vertexAt(std::size_t(across)))) <= 0;
  }

  void findMovable();
  void collectStars();
  void assignColours();
  std::int64_t moveColour(std::size_t colour, const Report& report);
  bool move(std::size_t i);
  double shapeOf(std::size_t i, Point2 p) const;
  bool isAllowed(std::size_t i, Point2 p) const;
  bool isAllowed(std::size_t slot, Point2 p, Point2 a, Point2 b) const;

  const PointsView Points;
  const RefinementOptions& Options;
  RefinedMesh& Mesh;
  const int Threads;
  const ConstraintEdges Segments;
  Buffer<Index> Neighbors; ///< by corner: the triangle across the opposite edge, or -1
  double LeastSineSquared = 0;
  std::vector<Index> Numbers; ///< by added point: its index among the movable ones, or -1
  std::vector<Index> Movable; ///< vertices
  GroupedItems<Index> Stars;  ///< by movable point: its corners
  std::vector<std::vector<Index>> Colours; ///< movable points
};

/// Added points inside the domain, except for corners of triangles that are not as asked.
void Smoother::findMovable()
{
  this->Numbers.assign(this->Mesh.addedCount(), 0);
  const auto keep = [this](Index vertex)
  {
    if (this->isAdded(vertex))
    {
      this->Numbers[this->added(vertex)] = -1;
    }
  };
  for (const IdSegment& segment : this->Mesh.Segments)
  {
    keep(Index(segment.A));
    keep(Index(segment.B));
  }
  for (const TriangleOutside& outside : this->Mesh.Outside)
  {
    for (std::size_t slot = 3 * std::size_t(outside.Triangle), i = 0; i < 3; ++i)
    {
      keep(this->vertexAt(slot + i));
    }
  }
  for (std::size_t i = 0; i < this->Numbers.size(); ++i)
  {
    if (this->Numbers[i] == 0)
    {
      this->Numbers[i] = Index(this->Movable.size());
      this->Movable.push_back(Index(this->Points.size() + i));
    }
  }
}

void Smoother::collectStars()
{
  this->Stars = GroupedItems<Index>(this->Movable.size(), 1,
    [this](const auto& visit)
    {
      for (std::size_t slot = 0; slot < this->Mesh.Triangles.size(); ++slot)
      {
        const Index vertex = this->vertexAt(slot);
        const Index number = this->isAdded(vertex) ? this->Numbers[this->added(vertex)] : -1;
        if (number >= 0)
        {
          visit(std::size_t(number), Index(slot));
        }
      }
    });
}

/// Gives each movable point the first colour that none of the points has whose positions its move
/// depends on: its neighbours, and the corners across its triangles. This relation is symmetric.
void Smoother::assignColours()
{
  constexpr std::size_t most = 64;
  std::vector<std::uint8_t> colours(this->Movable.size(), most);
  this->Colours.resize(most);
  for (std::size_t i = 0; i < this->Movable.size(); ++i)
  {
    std::uint64_t taken = 0;
    const auto exclude = [&](Index vertex)
    {
      const Index other = this->isAdded(vertex) ? this->Numbers[this->added(vertex)] : -1;
      if (other >= 0 && colours[std::size_t(other)] < most)
      {
        taken |= std::uint64_t(1) << colours[std::size_t(other)];
      }
    };
    for (const Index* slot = this->Stars.begin(i); slot != this->Stars.end(i); ++slot)
    {
      exclude(this->vertexAt(nextCorner(std::size_t(*slot))));
      const std::int64_t across = this->cornerAcross(std::size_t(*slot));
      if (across >= 0)
      {
        exclude(this->vertexAt(std::size_t(across)));
      }
    }
    std::size_t colour = 0;
    while (colour < most && ((taken >> colour) & 1) != 0)
    {
      ++colour;
    }
    if (colour < most) // if its neighbours have all colours, the point does not move
    {
      colours[i] = std::uint8_t(colour);
      this->Colours[colour].push_back(Index(i));
    }
  }
}

/// The squared sine of the smallest angle around movable point i, if it were at p; 0 if a triangle
/// turned over.
double Smoother::shapeOf(std::size_t i, Point2 p) const
{
  double least = std::numeric_limits<double>::infinity();
  for (const Index* slot = this->Stars.begin(i); slot != this->Stars.end(i); ++slot)
  {
    const Point2 a = this->at(this->vertexAt(nextCorner(std::size_t(*slot))));
    const Point2 b = this->at(this->vertexAt(previousCorner(std::size_t(*slot))));
    const double twice = cross(a - p, b - p);
    least = std::min(least, twice > 0 ? leastSineSquared(p, a, b, twice) : 0);
  }
  return least;
}

bool Smoother::isAllowed(std::size_t i, Point2 p) const
{
  return std::all_of(this->Stars.begin(i), this->Stars.end(i),
    [&](Index star)
    {
      const auto slot = std::size_t(star);
      return this->isAllowed(slot, p, this->at(this->vertexAt(nextCorner(slot))),
        this->at(this->vertexAt(previousCorner(slot))));
    });
}

/// Whether the triangle of a corner may have the corners p, a and b.
bool Smoother::isAllowed(std::size_t slot, Point2 p, Point2 a, Point2 b) const
{
  if (orientation(p, a, b) <= 0 ||
    squareOf(a - p) < this->Options.ShortestEdge * this->Options.ShortestEdge)
  {
    return false;
  }
  const double twice = cross(a - p, b - p);
  double limit = this->Options.LargestArea;
  if (!this->Mesh.RegionOf.empty() && this->Mesh.RegionOf[slot / 3] >= 0)
  {
    const auto region = std::size_t(this->Mesh.RegionOf[slot / 3]);
    limit = std::min(limit, this->Options.Regions[region].LargestArea);
  }
  if (this->Options.AreaAt && twice > 2 * this->Options.LeastArea)
  {
    limit = std::min(limit, areaAt(this->Options.AreaAt, { p, a, b }));
  }
  // The edge from p to a is a segment nowhere, and that from p to b belongs to the next triangle.
  return twice <= 2 * limit && this->isDelaunayAcross(previousCorner(slot), p, a, b) &&
    (this->Segments.contains(
       this->vertexAt(nextCorner(slot)), this->vertexAt(previousCorner(slot))) ||
      this->isDelaunayAcross(slot, p, a, b));
}

/// Moves a point towards the mean of its neighbours, if a move is allowed. Returns whether it
/// moved.
bool Smoother::move(std::size_t i)
{
  const Index vertex = this->Movable[i];
  const Point2 present = this->at(vertex);
  Point2 mean{ 0, 0 }; // as seen from the point, so that large coordinates do not matter
  for (const Index* slot = this->Stars.begin(i); slot != this->Stars.end(i); ++slot)
  {
    const Point2 away = this->at(this->vertexAt(nextCorner(std::size_t(*slot)))) - present;
    mean.x += away.x;
    mean.y += away.y;
  }
  const auto count = double(this->Stars.end(i) - this->Stars.begin(i));
  constexpr double growth = 1 + 1e-3; // smaller gains are not worth a move
  const double least = std::max(growth * this->shapeOf(i, present), this->LeastSineSquared);
  for (const double step : { 1.0, 0.5, 0.25 })
  {
    const Point2 p{ present.x + step / count * mean.x, present.y + step / count * mean.y };
    if (this->shapeOf(i, p) >= least && this->isAllowed(i, p))
    {
      double* const xy = this->Mesh.AddedXY.data() + 2 * this->added(vertex);
      xy[0] = p.x;
      xy[1] = p.y;
      return true;
    }
  }
  return false;
}

/// Returns the number of moves; -1 if `report` stopped them.
std::int64_t Smoother::moveColour(std::size_t colour, const Report& report)
{
  const std::vector<Index>& points = this->Colours[colour];
  constexpr std::int64_t chunk = 512;
  std::atomic<std::int64_t> moves{ 0 };
  const bool isDone = forChunks(std::int64_t(points.size()), chunk, this->Threads, report,
    [&](std::int64_t begin, std::int64_t end, int)
    {
      moves += std::count_if(points.begin() + begin, points.begin() + end,
        [this](Index i) { return this->move(std::size_t(i)); });
    });
  return isDone ? moves.load() : -1;
}

void Smoother::run(int rounds)
{
  const double parts = double(rounds) * double(this->Colours.size());
  for (int round = 0; round < rounds; ++round)
  {
    std::int64_t moves = 0;
    for (std::size_t colour = 0; colour < this->Colours.size(); ++colour)
    {
      const double done = double(std::size_t(round) * this->Colours.size() + colour);
      const std::int64_t moved =
        this->moveColour(colour, partOf(this->Options.Progress, done / parts, (done + 1) / parts));
      if (moved < 0)
      {
        this->Mesh.Aborted = true;
        return;
      }
      moves += moved;
    }
    this->Mesh.Statistics.Moves += moves;
    if (moves == 0)
    {
      return;
    }
  }
}

} // namespace

void smooth(PointsView points, const RefinementOptions& options, int rounds, RefinedMesh& mesh)
{
  if (rounds > 0 && mesh.triangleCount() > 0)
  {
    Smoother(points, options, mesh).run(rounds);
  }
}

} // namespace tipp

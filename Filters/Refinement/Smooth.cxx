// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/Smooth.h"

#include "Arrays/FindNeighbors.h"
#include "Constraints/ConstraintEdges.h"
#include "Files/PagedMemory.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Angles.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Vectors.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

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
    , Neighbors(this->array<Index>(mesh.Triangles.size()))
  {
    const double sine = sineOfDegrees(options.MinimumAngle);
    this->LeastSineSquared = sine * sine * (1 + 1e-12); // rounding must not hide an angle
    Buffer<Index> lists = this->array<Index>(neighborLists(mesh.triangleCount()));
    findNeighbors(
      mesh.Triangles.data(), mesh.triangleCount(), this->Neighbors.data(), lists.data());
    this->findMovable();
    this->collectStars();
    this->assignColours();
  }

  void run(int rounds);

private:
  /// An array where the mesh is, with undefined values.
  template <typename T>
  Buffer<T> array(std::size_t size) const
  {
    return bufferIn<T>(this->Options.Memory, size);
  }

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

  ///@{
  /// The corners at a movable point.
  const Index* starBegin(std::size_t i) const { return this->Stars.data() + this->StarBegins[i]; }
  const Index* starEnd(std::size_t i) const { return this->starBegin(i + 1); }
  ///@}

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
  Buffer<Index> Numbers;            ///< by added point: its index among the movable ones, or -1
  Buffer<Index> Movable;            ///< vertices
  Buffer<Index> Stars;              ///< corners, by movable point
  Buffer<std::uint32_t> StarBegins; ///< by movable point, and one more: index in Stars
  static constexpr std::size_t MostColours = 64;
  Buffer<Index> Coloured;                                  ///< movable points, by colour
  std::array<std::size_t, MostColours + 1> ColourBegins{}; ///< indices in Coloured
};

/// Added points inside the domain, except for corners of triangles that are not as asked.
void Smoother::findMovable()
{
  this->Numbers = this->array<Index>(this->Mesh.addedCount());
  std::fill(this->Numbers.begin(), this->Numbers.end(), 0);
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
  this->Movable =
    this->array<Index>(std::size_t(std::count(this->Numbers.begin(), this->Numbers.end(), 0)));
  Index count = 0;
  for (std::size_t i = 0; i < this->Numbers.size(); ++i)
  {
    if (this->Numbers[i] == 0)
    {
      this->Movable[std::size_t(count)] = Index(this->Points.size() + i);
      this->Numbers[i] = count++;
    }
  }
}

/// Sorts the corners by their movable point, by counting.
void Smoother::collectStars()
{
  const auto forCorners = [this](const auto& visit)
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
  };
  // While corners are stored, entry i + 1 is where the next one of point i is stored.
  const std::size_t points = this->Movable.size();
  this->StarBegins = this->array<std::uint32_t>(points + 2);
  std::fill(this->StarBegins.begin(), this->StarBegins.end(), 0);
  forCorners([this](std::size_t point, Index) { ++this->StarBegins[point + 2]; });
  for (std::size_t i = 2; i < points + 2; ++i)
  {
    this->StarBegins[i] += this->StarBegins[i - 1];
  }
  this->Stars = this->array<Index>(this->StarBegins[points + 1]);
  forCorners(
    [this](std::size_t point, Index slot) { this->Stars[this->StarBegins[point + 1]++] = slot; });
}

/// Gives each movable point the first colour that none of the points has whose positions its move
/// depends on: its neighbours, and the corners across its triangles. This relation is symmetric.
void Smoother::assignColours()
{
  constexpr std::size_t most = MostColours;
  Buffer<std::uint8_t> colours = this->array<std::uint8_t>(this->Movable.size());
  std::fill(colours.begin(), colours.end(), std::uint8_t(most));
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
    for (const Index* slot = this->starBegin(i); slot != this->starEnd(i); ++slot)
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
      ++this->ColourBegins[colour + 1];
    }
  }
  std::partial_sum(
    this->ColourBegins.begin(), this->ColourBegins.end(), this->ColourBegins.begin());
  this->Coloured = this->array<Index>(this->ColourBegins.back());
  std::array<std::size_t, most + 1> ends = this->ColourBegins;
  for (std::size_t i = 0; i < this->Movable.size(); ++i)
  {
    if (colours[i] < most)
    {
      this->Coloured[ends[colours[i]]++] = Index(i);
    }
  }
}

/// The squared sine of the smallest angle around movable point i, if it were at p; 0 if a triangle
/// turned over.
double Smoother::shapeOf(std::size_t i, Point2 p) const
{
  double least = std::numeric_limits<double>::infinity();
  for (const Index* slot = this->starBegin(i); slot != this->starEnd(i); ++slot)
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
  return std::all_of(this->starBegin(i), this->starEnd(i),
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
  for (const Index* slot = this->starBegin(i); slot != this->starEnd(i); ++slot)
  {
    const Point2 away = this->at(this->vertexAt(nextCorner(std::size_t(*slot)))) - present;
    mean.x += away.x;
    mean.y += away.y;
  }
  const auto count = double(this->starEnd(i) - this->starBegin(i));
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
  const Index* const points = this->Coloured.data() + this->ColourBegins[colour];
  const std::size_t count = this->ColourBegins[colour + 1] - this->ColourBegins[colour];
  constexpr std::int64_t chunk = 512;
  std::atomic<std::int64_t> moves{ 0 };
  const bool isDone = forChunks(std::int64_t(count), chunk, this->Threads, report,
    [&](std::int64_t begin, std::int64_t end, int)
    {
      keepMemoryLimits();
      moves += std::count_if(
        points + begin, points + end, [this](Index i) { return this->move(std::size_t(i)); });
    });
  return isDone ? moves.load() : -1;
}

void Smoother::run(int rounds)
{
  constexpr std::size_t colours = MostColours;
  const double parts = double(rounds) * double(colours);
  for (int round = 0; round < rounds; ++round)
  {
    std::int64_t moves = 0;
    for (std::size_t colour = 0; colour < colours; ++colour)
    {
      const double done = double(std::size_t(round) * colours + colour);
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

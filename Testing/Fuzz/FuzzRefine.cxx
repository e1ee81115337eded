// SPDX-License-Identifier: BSD-3-Clause
// Draws small graphs of segments and options, refines them, and checks the meshes in exact
// arithmetic; some also on several threads, smoothed, and in temporary files. A seed and a number
// identify a case: 'fuzzRefine --seed S --case N' repeats it.
#include "DegeneratePoints.h"
#include "Files/PagedMemory.h"
#include "FuzzDriver.h"
#include "Predicates/ExactPredicates.h"
#include "Predicates/Vectors.h"
#include "Refinement/Smooth.h"
#include "RefinementTesting.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

struct RefinementCase
{
  LineGraph Graph;
  std::vector<Point2> Holes;
  RefinementOptions Options;
  std::string Angle;
  double Side = 0; ///< of the graph
  double Area = 0; ///< 0: no limit
  ///@{
  /// Their points are chosen in the mesh.
  int HolesWanted = 0;
  int RegionsWanted = 0;
  ///@}
  int SmoothingRounds = 0;
  bool OnThreads = false;
  bool InFiles = false;
};

/// Draws a case step by step.
class CaseDrawer
{
public:
  explicit CaseDrawer(std::mt19937_64& random)
    : Random(random)
  {
  }

  RefinementCase draw()
  {
    this->Drawn.Graph.XY = drawDegeneratePoints(this->Random);
    this->makeUsable();
    this->addSegments();
    this->addShapes();
    this->measure();
    this->drawOptions();
    return std::move(this->Drawn);
  }

private:
  int below(std::uint64_t end) { return int(this->Random() % end); }
  bool oneIn(std::uint64_t cases) { return this->Random() % cases == 0; }
  double fraction() { return double(this->Random() >> 11) * 0x1p-53; }
  PointId anyPoint() { return PointId(this->Random() % std::uint64_t(this->Drawn.Graph.points())); }
  Point2 at(PointId id) const
  {
    const Coordinates& xy = this->Drawn.Graph.XY;
    return { xy[2 * std::size_t(id)], xy[2 * std::size_t(id) + 1] };
  }

  void makeUsable();
  void measure();
  void addSegments();
  void addShapes();
  void addNeedles();
  void drawOptions();

  std::mt19937_64& Random;
  RefinementCase Drawn;
  double Side = 0;
  double Largest = 0; ///< the largest coordinate
};

/// Leaves a number of points, and coordinates, that refine() does not refuse.
void CaseDrawer::makeUsable()
{
  Coordinates& xy = this->Drawn.Graph.XY;
  while (xy.size() < 6)
  {
    this->Drawn.Graph.addPoint(this->below(9), this->below(9));
  }
  xy.resize(std::min<std::size_t>(xy.size(), 60));
  this->measure();
  const bool isScaled = this->Largest < 1e-20 || this->Largest > 1e40;
  for (double& coordinate : xy)
  {
    if (!std::isfinite(coordinate) || isScaled)
    {
      coordinate = this->below(9);
    }
    // Points on a segment between such a coordinate and 0 have none of the numbers between them.
    constexpr double tiny = 1e-250;
    coordinate = std::fabs(coordinate) < tiny ? 0 : coordinate;
  }
  this->measure();
}

void CaseDrawer::measure()
{
  const Coordinates& xy = this->Drawn.Graph.XY;
  this->Side = 0;
  this->Largest = 0;
  for (std::size_t i = 0; i < xy.size(); ++i)
  {
    if (std::isfinite(xy[i]))
    {
      this->Side = std::max(this->Side, std::fabs(xy[i] - xy[i % 2]));
      this->Largest = std::max(this->Largest, std::fabs(xy[i]));
    }
  }
}

/// Adds segments between the points, which may cross, overlap or end anywhere; some are doubled.
void CaseDrawer::addSegments()
{
  LineGraph& graph = this->Drawn.Graph;
  for (int i = this->below(12); i > 0; --i)
  {
    graph.addSegment(this->anyPoint(), this->anyPoint());
    if (this->oneIn(8))
    {
      const Constraint last = graph.Segments.back();
      graph.addSegment(last.B, last.A);
    }
  }
}

/// Adds shapes that random segments rarely form.
void CaseDrawer::addShapes()
{
  LineGraph& graph = this->Drawn.Graph;
  const Point2 low = this->at(this->anyPoint());
  const double side = this->Side;
  if (this->oneIn(3)) // an enclosed part, sometimes with another one in it
  {
    graph.addRectangle(low.x, low.y, low.x + side, low.y + side / (1 + this->below(4)));
    if (this->oneIn(2))
    {
      graph.addRectangle(low.x + side / 4, low.y + side / 16, low.x + side / 2, low.y + side / 5);
    }
  }
  if (this->oneIn(3))
  {
    this->addNeedles();
  }
}

/// Adds segments from a point at tiny angles, or segments beside each other.
void CaseDrawer::addNeedles()
{
  LineGraph& graph = this->Drawn.Graph;
  const Point2 from = this->at(this->anyPoint());
  const bool areParallel = this->oneIn(3);
  const double gap = this->Side * std::ldexp(1, -1 - this->below(24));
  for (int i = 1 + this->below(4); i >= 0; --i)
  {
    const PointId first = graph.points();
    graph.addPoint(from.x, from.y + (areParallel ? i * gap : 0));
    graph.addPoint(from.x + this->Side * (0.5 + 0.5 * this->fraction()), from.y + i * gap);
    graph.addSegment(first, first + 1);
  }
}

void CaseDrawer::drawOptions()
{
  RefinementOptions& options = this->Drawn.Options;
  this->Drawn.Side = this->Side;
  const int angle = this->below(34);
  this->Drawn.Angle = std::to_string(angle);
  options.MinimumAngle = angle;
  options.IsEnclosed = this->oneIn(3);
  options.Threads = 1;
  // Features may be as small as rounding: a floor on edges bounds the number of triangles.
  options.ShortestEdge =
    std::max(this->Side * std::ldexp(1, -4 - this->below(5)), this->Largest * 1e-12);
  if (this->oneIn(2) && this->Side > 0)
  {
    this->Drawn.Area = this->Side * this->Side * std::ldexp(1, -this->below(10));
    options.LargestArea = this->Drawn.Area;
  }
  options.KeepsBorder = this->oneIn(8);
  options.KeepsSegments = this->oneIn(8);
  this->Drawn.HolesWanted = this->oneIn(4) ? 1 + this->below(2) : 0;
  this->Drawn.RegionsWanted = this->oneIn(4) ? 1 + this->below(2) : 0;
  this->Drawn.SmoothingRounds = this->oneIn(4) ? 1 + this->below(3) : 0;
  this->Drawn.OnThreads = this->oneIn(8);
  this->Drawn.InFiles = this->oneIn(32);
}

/// The corners of a triangle.
std::array<Point2, 3> cornersOf(const Refined& refined, std::size_t triangle)
{
  std::array<Point2, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto v = std::size_t(refined.Mesh.Triangles[3 * triangle + i]);
    corners[i] = { refined.XY[2 * v], refined.XY[2 * v + 1] };
  }
  return corners;
}

double largestCoordinate(const Coordinates& xy)
{
  double largest = 0;
  for (const double coordinate : xy)
  {
    largest = std::max(largest, std::fabs(coordinate));
  }
  return largest;
}

/// Whether a triangle is so narrow that a point on its edge, once rounded, may be beyond the
/// others: the exact checker cannot tell then which edges are those of a segment.
bool isNarrow(const std::array<Point2, 3>& corners, double largest)
{
  const auto& [a, b, c] = corners;
  const double side = std::max(std::hypot(b.x - a.x, b.y - a.y),
    std::max(std::hypot(c.x - b.x, c.y - b.y), std::hypot(a.x - c.x, a.y - c.y)));
  return cross(b - a, c - a) < side * largest * 0x1p-36;
}

bool hasNarrowTriangle(const Refined& refined)
{
  const double largest = largestCoordinate(refined.XY);
  for (std::size_t t = 0; t < refined.Mesh.triangleCount(); ++t)
  {
    if (isNarrow(cornersOf(refined, t), largest))
    {
      return true;
    }
  }
  return false;
}

bool isInside(Point2 p, const std::array<Point2, 3>& corners)
{
  return orientation(corners[0], corners[1], p) > 0 && orientation(corners[1], corners[2], p) > 0 &&
    orientation(corners[2], corners[0], p) > 0;
}

/// Refines the graph. Chooses holes, and then regions, around the middles of some triangles of a
/// mesh without them.
Refined refineDrawn(RefinementCase& drawn, std::mt19937_64& random)
{
  Refined refined = refineGraph(drawn.Graph, drawn.Options);
  const double largest = largestCoordinate(refined.XY);
  const auto choose = [&](int count, const auto& add)
  {
    const std::size_t triangles = refined.Mesh.triangleCount();
    for (int i = 0; i < count && triangles > 0; ++i)
    {
      const std::array<Point2, 3> corners = cornersOf(refined, random() % triangles);
      const auto& [a, b, c] = corners;
      const Point2 middle{ (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3 };
      if (!isNarrow(corners, largest) && isInside(middle, corners))
      {
        add(middle, cross(b - a, c - a) / 2);
      }
    }
    if (count > 0)
    {
      refined = refineGraph(drawn.Graph, drawn.Options, drawn.Holes);
    }
  };
  choose(drawn.HolesWanted, [&](Point2 middle, double) { drawn.Holes.push_back(middle); });
  choose(drawn.RegionsWanted,
    [&](Point2 middle, double area)
    {
      // So that no region needs more triangles than are made quickly.
      const double least = drawn.Side * drawn.Side * 0x1p-10;
      drawn.Options.Regions.push_back({ middle, std::max(least, area) * double(1 + random() % 4) });
    });
  return refined;
}

/// The triangles that can be reached from each without crossing a segment, as one of their indices.
std::vector<std::size_t> partsOf(const Refined& refined)
{
  std::set<std::pair<PointId, PointId>> segments;
  for (const IdSegment& segment : refined.Mesh.Segments)
  {
    segments.insert(std::minmax(segment.A, segment.B));
  }
  std::vector<std::size_t> parents(refined.Mesh.triangleCount());
  for (std::size_t t = 0; t < parents.size(); ++t)
  {
    parents[t] = t;
  }
  const auto rootOf = [&parents](std::size_t t)
  {
    while (parents[t] != t)
    {
      t = parents[t] = parents[parents[t]];
    }
    return t;
  };
  std::map<std::pair<PointId, PointId>, std::size_t> beside;
  for (std::size_t slot = 0; slot < 3 * parents.size(); ++slot)
  {
    const std::size_t next = slot % 3 == 2 ? slot - 2 : slot + 1;
    const std::pair<PointId, PointId> edge =
      std::minmax<PointId>(refined.Mesh.Triangles[slot], refined.Mesh.Triangles[next]);
    const auto [found, isFirst] = beside.emplace(edge, slot / 3);
    if (!isFirst && segments.count(edge) == 0)
    {
      parents[rootOf(slot / 3)] = rootOf(found->second);
    }
  }
  std::vector<std::size_t> parts;
  for (std::size_t t = 0; t < parents.size(); ++t)
  {
    parts.push_back(rootOf(t));
  }
  return parts;
}

/// Checks the regions of triangles, and the limits of areas there. The last region with a point in
/// a part of the domain counts.
testing::AssertionResult hasRightRegions(const RefinementCase& drawn, const Refined& refined)
{
  const std::vector<RefinementRegion>& regions = drawn.Options.Regions;
  const std::vector<std::size_t> parts = partsOf(refined);
  std::map<std::size_t, std::int32_t> regionOfPart;
  std::vector<bool> isFound(regions.size(), false);
  for (std::size_t r = 0; r < regions.size(); ++r)
  {
    for (std::size_t t = 0; t < parts.size() && !isFound[r]; ++t)
    {
      if (isInside(regions[r].Seed, cornersOf(refined, t)))
      {
        isFound[r] = true;
        regionOfPart[parts[t]] = std::int32_t(r);
      }
    }
    if (!isFound[r])
    {
      return testing::AssertionSuccess(); // a split segment or an edge is at the point
    }
  }
  std::set<std::int64_t> listed;
  for (const TriangleOutside& outside : refined.Mesh.Outside)
  {
    listed.insert(outside.Triangle);
  }
  for (std::size_t t = 0; t < parts.size(); ++t)
  {
    const auto found = regionOfPart.find(parts[t]);
    const std::int32_t region = found == regionOfPart.end() ? -1 : found->second;
    if (refined.Mesh.RegionOf[t] != region)
    {
      return testing::AssertionFailure() << "triangle " << t << " has another region";
    }
    const auto [a, b, c] = cornersOf(refined, t);
    if (region >= 0 && listed.count(std::int64_t(t)) == 0 &&
      cross(b - a, c - a) / 2 > regions[std::size_t(region)].LargestArea * (1 + 1e-9))
    {
      return testing::AssertionFailure() << "triangle " << t << " is above its region's limit";
    }
  }
  return testing::AssertionSuccess();
}

/// Returns what is wrong with a mesh.
testing::AssertionResult isRightMesh(const RefinementCase& drawn, const Refined& refined)
{
  if (const int faults = countFaults(refined))
  {
    return testing::AssertionFailure() << faults << " edges or triangles are wrong";
  }
  if (refined.Mesh.triangleCount() == 0)
  {
    return testing::AssertionSuccess();
  }
  if (!drawn.Options.Regions.empty())
  {
    if (const auto outcome = hasRightRegions(drawn, refined); !outcome)
    {
      return outcome;
    }
  }
  // A limit of areas may be missed where edges would be too short: such triangles are listed.
  return hasNarrowTriangle(refined) ? testing::AssertionSuccess()
                                    : isRight(drawn.Graph, refined, drawn.Angle, 0, drawn.Holes);
}

/// Smooths the mesh, and checks it again.
testing::AssertionResult isRightWhenSmoothed(const RefinementCase& drawn, Refined& refined)
{
  const std::size_t before = refined.XY.size() - refined.Mesh.AddedXY.size();
  const Coordinates given(refined.XY.begin(), refined.XY.begin() + std::ptrdiff_t(before));
  smooth(
    PointsView(given.data(), before / 2, 2), drawn.Options, drawn.SmoothingRounds, refined.Mesh);
  std::copy(refined.Mesh.AddedXY.begin(), refined.Mesh.AddedXY.end(),
    refined.XY.begin() + std::ptrdiff_t(before));
  const auto outcome = isRightMesh(drawn, refined);
  return outcome ? outcome : testing::AssertionFailure() << "smoothed: " << outcome.message();
}

/// Whether the domain is outside of the range that refine() documents.
bool isRefused(const std::invalid_argument& error)
{
  return std::string(error.what()).find("A domain with a longest side") == 0;
}

/// Whether a triangle is narrow before refinement, also one that is not in the domain: borders on
/// both sides of it may get split points with the same coordinates, once these are rounded.
bool startsNarrow(const RefinementCase& drawn)
{
  RefinementOptions options;
  options.MinimumAngle = 0;
  options.KeepsSegments = true;
  return hasNarrowTriangle(refineGraph(drawn.Graph, options));
}

testing::AssertionResult check(RefinementCase& drawn, std::mt19937_64& random)
{
  try
  {
    Refined one = refineDrawn(drawn, random);
    RefinementOptions options = drawn.Options;
    options.Threads = 3;
    if (drawn.OnThreads && !areSame(one, refineGraph(drawn.Graph, options, drawn.Holes)))
    {
      return testing::AssertionFailure() << "three threads make another mesh";
    }
    if (drawn.InFiles)
    {
      PagedMemory memory(std::filesystem::temp_directory_path().string(), 1);
      options.Memory = &memory;
      if (!areSame(one, refineGraph(drawn.Graph, options, drawn.Holes)))
      {
        return testing::AssertionFailure() << "temporary files make another mesh";
      }
    }
    auto outcome = isRightMesh(drawn, one);
    if (outcome && drawn.SmoothingRounds > 0)
    {
      outcome = isRightWhenSmoothed(drawn, one);
    }
    return outcome || startsNarrow(drawn) ? testing::AssertionSuccess() : outcome;
  }
  catch (const std::invalid_argument& error)
  {
    return isRefused(error) ? testing::AssertionSuccess()
                            : testing::AssertionFailure() << "an exception: " << error.what();
  }
  catch (const std::exception& error)
  {
    return testing::AssertionFailure() << "an exception: " << error.what();
  }
}

void print(const RefinementCase& drawn)
{
  std::printf("angle %s, area %g, shortest edge %.17g, enclosed %d, keeps %d %d\n",
    drawn.Angle.c_str(), drawn.Area, drawn.Options.ShortestEdge, drawn.Options.IsEnclosed,
    drawn.Options.KeepsBorder, drawn.Options.KeepsSegments);
  for (std::size_t i = 0; i < drawn.Graph.XY.size(); i += 2)
  {
    std::printf("%.17g %.17g\n", drawn.Graph.XY[i], drawn.Graph.XY[i + 1]);
  }
  for (const Constraint& segment : drawn.Graph.Segments)
  {
    std::printf("%lld - %lld\n", (long long)segment.A, (long long)segment.B);
  }
  for (const Point2 hole : drawn.Holes)
  {
    std::printf("hole %.17g %.17g\n", hole.x, hole.y);
  }
  for (const RefinementRegion& region : drawn.Options.Regions)
  {
    std::printf("region %.17g %.17g %.17g\n", region.Seed.x, region.Seed.y, region.LargestArea);
  }
}

/// Runs one case, and prints it if it fails.
bool passes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq both{ seed, number };
  std::mt19937_64 random(both);
  RefinementCase drawn = CaseDrawer(random).draw();
  const auto outcome = check(drawn, random);
  if (!outcome)
  {
    std::printf("case %llu of seed %llu: %s\n", (unsigned long long)number,
      (unsigned long long)seed, outcome.message());
    print(drawn);
  }
  return bool(outcome);
}

} // namespace

int main(int argc, char** argv)
{
  return fuzz("fuzzRefine", argc, argv, passes);
}

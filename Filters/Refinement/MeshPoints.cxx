// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/MeshPoints.h"

#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Files/PagedMemory.h"
#include "Parallel/ParallelFor.h"
#include "Refinement/MinimumPyramid.h"
#include "Refinement/Smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// The points of the triangulation, with its crossings.
class AllPoints
{
public:
  AllPoints(PointsView given, const std::vector<CrossingPoint>& crossings)
    : View(given)
  {
    if (crossings.empty())
    {
      return;
    }
    this->Positions.reserve(given.size() + crossings.size());
    for (std::size_t i = 0; i < given.size(); ++i)
    {
      this->Positions.push_back(given[i]);
    }
    for (const CrossingPoint& crossing : crossings)
    {
      this->Positions.push_back(crossing.Position);
    }
    this->View = PointsView(this->Positions);
  }
  AllPoints(const AllPoints&) = delete;
  AllPoints& operator=(const AllPoints&) = delete;

  const PointsView& view() const { return this->View; }

private:
  std::vector<Point2> Positions;
  PointsView View;
};

PointBlend blendOf(const CrossingPoint& crossing)
{
  return { { crossing.A, crossing.B, crossing.A },
    { 1 - crossing.Fraction, crossing.Fraction, 0 } };
}

/// The wanted length of edges, as a limit of areas.
class AreaField
{
public:
  AreaField(const LengthSurface& surface, const char* what, int threads)
    : Lengths(surface.Lengths)
    , Surface(surface.Points, surface.Corners, surface.Triangles, threads)
  {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < surface.Points.size(); ++i)
    {
      const double length = surface.Lengths[i];
      if (!(length > 0 && std::isfinite(length)))
      {
        std::ostringstream text;
        text << "The size at point " << i << " of " << what << " is " << length
             << "; give lengths above 0.";
        throw std::invalid_argument(text.str());
      }
      least = std::min(least, length);
    }
    this->Least = areaFor(least);
    this->setBins(surface);
  }

  /// The area for a triangle, as SizeFunction::forTriangle() gives the size.
  double at(Point2 centroid, double radius) const
  {
    PointBlend blend{};
    const double length = this->Surface.find(centroid, blend)
      ? blend.valueOf([this](PointId id) { return this->Lengths[std::size_t(id)]; })
      : std::numeric_limits<double>::infinity();
    const double nearby =
      this->Minima.least(this->binOf({ centroid.x - radius, centroid.y - radius }),
        this->binOf({ centroid.x + radius, centroid.y + radius }));
    return areaFor(std::min(length, 2 * nearby));
  }
  double least() const { return this->Least; }

private:
  /// The area of the equilateral triangle with this side.
  static double areaFor(double length) { return std::sqrt(3.0) / 4 * length * length; }

  /// The column and row of the bin with a position.
  Point2 binOf(Point2 p) const
  {
    return { std::floor((p.x - this->Low.x) * this->PerUnit),
      std::floor((p.y - this->Low.y) * this->PerUnit) };
  }

  /// Sets for each bin, of which there are about as many as points, the least length in it.
  void setBins(const LengthSurface& surface)
  {
    Box2 box = Box2::empty();
    for (std::size_t i = 0; i < surface.Points.size(); ++i)
    {
      box.extend(surface.Points[i]);
    }
    const double longest = std::max(box.width(0), box.width(1));
    const double shortest = std::max(std::min(box.width(0), box.width(1)), longest / 4096);
    const double side = std::sqrt(longest * shortest / double(surface.Points.size()));
    this->Low = box.Min;
    if (!(side > 0 && std::isfinite(side)))
    {
      return; // refine() refuses such a domain
    }
    this->PerUnit = 1 / side;
    const Point2 last = this->binOf(box.Max);
    const std::size_t columns = std::size_t(last.x) + 1;
    const std::size_t rows = std::size_t(last.y) + 1;
    this->Bins.assign(columns * rows, std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < surface.Points.size(); ++i)
    {
      const Point2 bin = this->binOf(surface.Points[i]);
      double& least = this->Bins[std::size_t(bin.y) * columns + std::size_t(bin.x)];
      least = std::min(least, surface.Lengths[i]);
    }
    this->Minima = MinimumPyramid(this->Bins.data(), columns, rows);
  }

  const double* Lengths;
  SurfaceLocator Surface;
  double Least = 0;
  Point2 Low{ 0, 0 };
  double PerUnit = 0; ///< bins per unit of the coordinates
  std::vector<double> Bins;
  MinimumPyramid Minima;
};

/// The limits of areas by the lengths of a request.
class AreaFields
{
public:
  AreaFields(PointsView points, const MeshRequest& request, const ConstrainedTriangulation& start)
  {
    const int threads = threadCount(request.Refinement.Threads);
    if (request.Lengths)
    {
      this->extendLengths(points.size(), request.Lengths, start.Constraints.Crossings);
      const Buffer<std::int32_t>& ids = start.Mesh.Ids32;
      this->Fields[0].emplace(
        LengthSurface{ points, ids.data(), std::int64_t(ids.size() / 3), this->Lengths.data() },
        "the input", threads);
    }
    if (request.Surface)
    {
      this->Fields[1].emplace(*request.Surface, "the surface of sizes", threads);
    }
  }

  /// Adds the limits to those of the options.
  void apply(RefinementOptions& options) const
  {
    if (!this->Fields[0] && !this->Fields[1])
    {
      return;
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    options.LeastArea = options.AreaAt ? options.LeastArea : infinity;
    for (const std::optional<AreaField>& field : this->Fields)
    {
      options.LeastArea = field ? std::min(options.LeastArea, field->least()) : options.LeastArea;
    }
    options.AreaAt = [this, given = std::move(options.AreaAt)](Point2 centroid, double radius)
    {
      double area = given ? given(centroid, radius) : infinity;
      for (const std::optional<AreaField>& field : this->Fields)
      {
        area = field ? std::min(area, field->at(centroid, radius)) : area;
      }
      return area;
    };
  }

private:
  /// Sets the lengths at the points given, of which there are `all` with the crossings, and at the
  /// crossings.
  void extendLengths(
    std::size_t all, const double* lengths, const std::vector<CrossingPoint>& crossings)
  {
    this->Lengths.assign(lengths, lengths + (all - crossings.size()));
    for (const CrossingPoint& crossing : crossings)
    {
      this->Lengths.push_back(
        blendOf(crossing).valueOf([this](PointId id) { return this->Lengths[std::size_t(id)]; }));
    }
  }

  std::vector<double> Lengths;
  std::array<std::optional<AreaField>, 2> Fields;
};

/// Whether the domain is what lines enclose.
bool isEnclosed(const MeshRequest& request)
{
  return !request.IsConvex && request.Source && !request.Source->Constraints.empty() &&
    request.Source->BoundaryEdges == 0 &&
    request.Source->PolygonBegin >= request.Source->Constraints.size();
}

/// Whether any angle or area is bounded.
bool hasBounds(const RefinementOptions& options)
{
  return options.MinimumAngle > 0 || std::isfinite(options.LargestArea) || options.AreaAt ||
    std::any_of(options.Regions.begin(), options.Regions.end(),
      [](const RefinementRegion& region) { return std::isfinite(region.LargestArea); });
}

constexpr double StartShare = 0.2; ///< of the progress, for the triangulation to start from
constexpr double SmoothingShare = 0.3;

ConstrainedTriangulation triangulateStart(
  PointsView points, const MeshRequest& request, std::vector<std::string>& warnings)
{
  SourceConstraints source;
  PointsRequest start;
  start.Crossings = request.Crossings;
  start.Options.Threads = request.Refinement.Threads;
  start.Options.Progress = partOf(request.Refinement.Progress, 0, StartShare);
  start.Source = request.Source;
  if (request.IsConvex && request.Source)
  {
    source = *request.Source;
    source.PolygonBegin = source.Constraints.size(); // polygons are lines
    source.BoundaryEdges = 0;
    start.Source = &source;
  }
  ConstrainedTriangulation result = triangulatePoints(points, start, warnings);
  if (!result.Mesh.Ids64.empty())
  {
    throw std::length_error("The mesh would have too many points.");
  }
  if (result.Inverted > 0)
  {
    warnings.push_back("A part that only clockwise polygons surround is left out: reverse the "
                       "polygon, or repair it if it crosses itself.");
  }
  return result;
}

/// Finds between which points of the triangulation the added ones lie.
class AddedBlends
{
public:
  AddedBlends(PointsView points, const RefinedMesh& mesh, PagedMemory* memory)
    : Points(points)
    , Mesh(mesh)
    , Beside(bufferIn<std::array<PointId, 2>>(memory, mesh.addedCount()))
  {
    std::fill(this->Beside.begin(), this->Beside.end(), std::array<PointId, 2>{ None, None });
  }

  /// Sets the blends of the added points.
  void run(const Buffer<std::int32_t>& start, int threads, PointBlend* blends)
  {
    const auto added = std::int64_t(this->Mesh.addedCount());
    this->linkSegments();
    for (const IdSegment& segment : this->Mesh.Segments)
    {
      this->follow(segment.A, segment.B, blends);
      this->follow(segment.B, segment.A, blends);
    }
    const SurfaceLocator surface(
      this->Points, start.data(), std::int64_t(start.size() / 3), threads);
    constexpr std::int64_t chunk = 1024;
    forChunks(added, chunk, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        keepMemoryLimits();
        for (std::int64_t i = begin; i < end; ++i)
        {
          if (this->Beside[std::size_t(i)][0] == None)
          {
            blends[i] = surface.findNear(this->added(i));
          }
        }
      });
  }

private:
  static constexpr PointId None = -1;

  bool isAdded(PointId id) const { return id >= PointId(this->Points.size()); }
  std::size_t index(PointId id) const { return std::size_t(id) - this->Points.size(); }
  Point2 added(std::int64_t i) const
  {
    return { this->Mesh.AddedXY[2 * std::size_t(i)], this->Mesh.AddedXY[2 * std::size_t(i) + 1] };
  }

  /// Sets the two neighbours of each added point along its segment.
  void linkSegments()
  {
    const auto link = [this](PointId from, PointId to)
    {
      if (this->isAdded(from))
      {
        std::array<PointId, 2>& beside = this->Beside[this->index(from)];
        beside[beside[0] == None ? 0 : 1] = to;
      }
    };
    for (const IdSegment& segment : this->Mesh.Segments)
    {
      link(segment.A, segment.B);
      link(segment.B, segment.A);
    }
  }

  /// Sets the blends of the chain of added points from a point of the triangulation to the next
  /// one, if `next` is added; only from the end with the lower id, since both are visited.
  void follow(PointId from, PointId next, PointBlend* blends) const
  {
    if (this->isAdded(from) || !this->isAdded(next))
    {
      return;
    }
    PointId before = from;
    PointId end = next;
    while (this->isAdded(end))
    {
      const std::array<PointId, 2>& beside = this->Beside[this->index(end)];
      end = beside[0] == std::exchange(before, end) ? beside[1] : beside[0];
    }
    const Point2 a = this->Points[std::size_t(from)];
    const Point2 along = this->Points[std::size_t(end)] - a;
    const double square = along.x * along.x + along.y * along.y;
    before = from;
    for (PointId id = next; from < end && this->isAdded(id);)
    {
      const Point2 offset = this->added(std::int64_t(this->index(id))) - a;
      const double fraction = (offset.x * along.x + offset.y * along.y) / square;
      blends[this->index(id)] = { { from, end, from }, { 1 - fraction, fraction, 0 } };
      const std::array<PointId, 2>& beside = this->Beside[this->index(id)];
      id = beside[0] == std::exchange(before, id) ? beside[1] : beside[0];
    }
  }

  PointsView Points;
  const RefinedMesh& Mesh;
  Buffer<std::array<PointId, 2>> Beside; ///< by added point: its neighbours along its segment
};

/// Returns the positions of the crossings, followed by the added points.
Buffer<double> joinNew(
  const std::vector<CrossingPoint>& crossings, Buffer<double> added, PagedMemory* memory)
{
  if (crossings.empty())
  {
    return added;
  }
  Buffer<double> joined = bufferIn<double>(memory, 2 * crossings.size() + added.size());
  double* to = joined.data();
  for (const CrossingPoint& crossing : crossings)
  {
    *to++ = crossing.Position.x;
    *to++ = crossing.Position.y;
  }
  std::copy(added.begin(), added.end(), to);
  return joined;
}

} // namespace

PointsMesh meshPoints(
  PointsView points, const MeshRequest& request, std::vector<std::string>& warnings)
{
  PointsMesh result;
  if (request.SmoothingRounds < 0)
  {
    throw std::invalid_argument("The number of smoothing rounds is " +
      std::to_string(request.SmoothingRounds) + "; give 0 or more.");
  }
  const ConstrainedTriangulation start = triangulateStart(points, request, warnings);
  result.Aborted = start.Mesh.Aborted;
  if (result.Aborted)
  {
    return result;
  }
  const AllPoints all(points, start.Constraints.Crossings);
  const AreaFields fields(all.view(), request, start);
  RefinementOptions options = request.Refinement;
  options.IsEnclosed = isEnclosed(request);
  const double smoothing = request.SmoothingRounds > 0 ? SmoothingShare : 0;
  options.Progress = partOf(request.Refinement.Progress, StartShare, 1 - smoothing);
  fields.apply(options);
  // refine() would still split segments that are too close to a point.
  options.KeepsSegments = options.KeepsSegments || !hasBounds(options);
  result.Mesh = refine(all.view(), start, options);
  if (!result.Mesh.Aborted)
  {
    options.Progress = partOf(request.Refinement.Progress, 1 - smoothing, 1);
    smooth(all.view(), options, request.SmoothingRounds, result.Mesh);
  }
  result.Aborted = result.Mesh.Aborted;
  if (result.Aborted)
  {
    return result;
  }
  if (result.Mesh.triangleCount() == 0 && warnings.empty())
  {
    warnings.push_back(options.IsEnclosed
        ? "No triangles: the lines enclose nothing, so close them, or mesh the convex hull."
        : "No triangles: the polygons and holes leave nothing of the domain.");
  }
  const std::vector<CrossingPoint>& crossings = start.Constraints.Crossings;
  if (request.HasValues)
  {
    result.Blends =
      bufferIn<PointBlend>(options.Memory, crossings.size() + result.Mesh.addedCount());
    std::transform(crossings.begin(), crossings.end(), result.Blends.begin(), blendOf);
    AddedBlends(all.view(), result.Mesh, options.Memory)
      .run(start.Mesh.Ids32, threadCount(options.Threads), result.Blends.data() + crossings.size());
  }
  result.NewXY = joinNew(crossings, std::move(result.Mesh.AddedXY), options.Memory);
  result.Crossings = std::int64_t(crossings.size());
  return result;
}

} // namespace tipp

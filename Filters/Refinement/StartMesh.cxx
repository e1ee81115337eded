// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/StartMesh.h"

#include "Arrays/FindNeighbors.h"
#include "Predicates/Angles.h"
#include "Predicates/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace tipp
{
namespace
{

using Index = RefinementMesh::Index;
using Link = RefinementMesh::Link;

std::size_t nextSlot(std::size_t slot)
{
  return slot % 3 == 2 ? slot - 2 : slot + 1;
}
std::size_t previousSlot(std::size_t slot)
{
  return slot % 3 == 0 ? slot + 2 : slot - 1;
}

InputSegment segmentBetween(PointsView points, Index a, Index b, std::int64_t constraint)
{
  InputSegment segment{ { a, b }, { points[std::size_t(a)], points[std::size_t(b)] } };
  segment.Constraint = constraint;
  return segment;
}

/// The triangles given: corners, neighbours, and which of them are in the domain.
class GivenTriangles
{
public:
  GivenTriangles(const Triangulation& triangulation, const RefinementMesh& segments)
    : Segments(segments)
    , Corners(3 * triangulation.triangleCount())
    , Neighbors(this->Corners.size())
    , IsInside(this->Corners.size() / 3, 1)
  {
    if (this->IsInside.size() > RefinementMesh::MostTriangles)
    {
      throw std::length_error("The mesh would have too many triangles for the memory.");
    }
    if (!triangulation.Ids32.empty())
    {
      std::copy(triangulation.Ids32.begin(), triangulation.Ids32.end(), this->Corners.begin());
    }
    else
    {
      std::copy(triangulation.Ids64.begin(), triangulation.Ids64.end(), this->Corners.begin());
    }
    findNeighbors(this->Corners.data(), this->IsInside.size(), this->Neighbors.data());
  }

  bool isSegment(std::size_t slot) const
  {
    return this->Segments.has(this->Corners[nextSlot(slot)], this->Corners[previousSlot(slot)]);
  }

  /// Calls enter(triangle) for all triangles that can be reached from those in `front` without
  /// crossing a segment, where it returns true.
  template <typename Enter>
  void spread(std::vector<std::size_t> front, const Enter& enter) const
  {
    while (!front.empty())
    {
      const std::size_t t = front.back();
      front.pop_back();
      for (std::size_t slot = 3 * t; slot < 3 * t + 3; ++slot)
      {
        if (this->Neighbors[slot] >= 0 && !this->isSegment(slot) &&
          enter(std::size_t(this->Neighbors[slot])))
        {
          front.push_back(std::size_t(this->Neighbors[slot]));
        }
      }
    }
  }

  /// Removes what can be reached from outside without crossing a segment.
  void keepEnclosed()
  {
    std::vector<std::size_t> front;
    const auto enter = [this](std::size_t t) { return std::exchange(this->IsInside[t], 0) != 0; };
    for (std::size_t slot = 0; slot < this->Corners.size(); ++slot)
    {
      if (this->Neighbors[slot] < 0 && !this->isSegment(slot) && enter(slot / 3))
      {
        front.push_back(slot / 3);
      }
    }
    this->spread(std::move(front), enter);
  }

  /// By triangle: 0, or 1 and the index of the region. Throws std::invalid_argument.
  std::vector<std::uint32_t> regions(
    PointsView points, const std::vector<RefinementRegion>& regions) const
  {
    std::vector<std::uint32_t> result(this->IsInside.size(), 0);
    for (std::size_t r = 0; r < regions.size(); ++r)
    {
      const std::size_t start = this->find(points, regions[r].Seed);
      if (start == this->IsInside.size())
      {
        std::ostringstream text;
        text << "The point (" << regions[r].Seed.x << ", " << regions[r].Seed.y << ") of region "
             << r << " is in no triangle of the domain.";
        throw std::invalid_argument(text.str());
      }
      const auto enter = [&](std::size_t t)
      { return this->IsInside[t] && std::exchange(result[t], std::uint32_t(r + 1)) != r + 1; };
      enter(start);
      this->spread({ start }, enter);
    }
    return result;
  }

  const RefinementMesh& Segments;
  std::vector<Index> Corners;
  std::vector<Index> Neighbors; ///< by corner: the triangle across the opposite edge, or -1
  std::vector<char> IsInside;

private:
  /// The first triangle with a point inside or on its border; the number of triangles if none.
  std::size_t find(PointsView points, Point2 p) const
  {
    for (std::size_t t = 0; t < this->IsInside.size(); ++t)
    {
      const Point2 a = points[std::size_t(this->Corners[3 * t])];
      const Point2 b = points[std::size_t(this->Corners[3 * t + 1])];
      const Point2 c = points[std::size_t(this->Corners[3 * t + 2])];
      if (this->IsInside[t] && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
        orientation(c, a, p) >= 0)
      {
        return t;
      }
    }
    return this->IsInside.size();
  }
};

/// A segment as seen from one of its ends.
struct Ray
{
  Index Id; ///< of the end
  double Direction;
  Index Segment;
  std::size_t End;
  bool HasDomain; ///< the triangles to its left are in the domain
};

/// Finds the ends at which a segment and the next one, seen across the domain, make a sharp angle.
void findSharpEnds(std::vector<Ray> rays, std::vector<InputSegment>& segments)
{
  std::sort(rays.begin(), rays.end(),
    [](const Ray& a, const Ray& b)
    { return a.Id != b.Id ? a.Id < b.Id : a.Direction < b.Direction; });
  for (std::size_t begin = 0, end = 0; begin < rays.size(); begin = end)
  {
    while (end < rays.size() && rays[end].Id == rays[begin].Id)
    {
      ++end;
    }
    for (std::size_t i = begin; i < end && end > begin + 1; ++i)
    {
      const Ray& ray = rays[i];
      const Ray& next = rays[i + 1 < end ? i + 1 : begin];
      const double angle = next.Direction - ray.Direction + (i + 1 < end ? 0 : 360);
      if (ray.HasDomain && angle < 60)
      {
        segments[std::size_t(ray.Segment)].IsSharp[ray.End] = true;
        segments[std::size_t(next.Segment)].IsSharp[next.End] = true;
      }
    }
  }
}

/// Copies triangles into a mesh.
class MeshStart
{
public:
  MeshStart(PointsView points, const GivenTriangles& given, RefinementMesh& mesh)
    : Points(points)
    , Given(given)
    , Mesh(mesh)
    , Vertices(points.size(), -1)
  {
    Index count = 0;
    for (const char isInside : given.IsInside)
    {
      this->Numbers.push_back(isInside ? count++ : -1);
    }
    if (std::size_t(count) + RefinementMesh::TrianglesInGroup > mesh.Triangles.capacity())
    {
      throw std::length_error("The mesh would have too many triangles for the memory.");
    }
    mesh.Triangles.grow(std::size_t(count) + RefinementMesh::TrianglesInGroup);
    mesh.TriangleEnd = addGroups(count, RefinementMesh::TrianglesInGroup, mesh.TriangleGroups);
  }

  void run(const std::vector<std::uint32_t>& regions)
  {
    for (std::size_t slot = 0; slot < this->Given.Corners.size(); ++slot)
    {
      const Index t = this->Numbers[slot / 3];
      if (t >= 0)
      {
        RefinementMesh::Triangle& triangle = this->Mesh.Triangles[std::size_t(t)];
        triangle.State =
          RefinementMesh::IsLive | (regions[slot / 3] << RefinementMesh::RegionShift);
        triangle.Corner[slot % 3] = this->vertexOf(this->Given.Corners[slot]);
        triangle.Across[slot % 3] = this->linkAcross(slot);
      }
    }
    this->Mesh.PointEnd =
      addGroups(this->VertexEnd, RefinementMesh::PointsInGroup, this->Mesh.PointGroups);
    findSharpEnds(std::move(this->Rays), this->Mesh.Segments);
  }

private:
  /// Lists the groups of the first places. Returns the end of the last one.
  static std::int64_t addGroups(std::int64_t places, Index group, std::vector<Index>& groups)
  {
    std::int64_t end = 0;
    for (; end < places; end += group)
    {
      groups.push_back(Index(end));
    }
    return end;
  }

  Index vertexOf(Index id)
  {
    Index& vertex = this->Vertices[std::size_t(id)];
    if (vertex < 0)
    {
      vertex = this->VertexEnd++;
      this->Mesh.Points[std::size_t(vertex)] = this->Points[std::size_t(id)];
      this->Mesh.Origins[std::size_t(vertex)] = RefinementMesh::ofInput(id);
    }
    return vertex;
  }

  /// The link across the edge opposite to a corner of a triangle in the domain.
  Link linkAcross(std::size_t slot)
  {
    const Index start = this->Given.Corners[nextSlot(slot)];
    const Index stop = this->Given.Corners[previousSlot(slot)];
    const Index beside = this->Given.Neighbors[slot];
    if (beside < 0 || this->Numbers[std::size_t(beside)] < 0)
    {
      if (!this->Mesh.has(start, stop))
      {
        this->Mesh.add(segmentBetween(this->Points, start, stop, -1));
      }
      this->addRays(start, stop, true);
      return RefinementMesh::Outside;
    }
    int corner = 0; // opposite to the edge there, which goes from stop to start
    while (this->Given.Corners[nextSlot(3 * std::size_t(beside) + std::size_t(corner))] != stop)
    {
      ++corner;
    }
    const Link link = RefinementMesh::linkTo(this->Numbers[std::size_t(beside)], corner);
    if (!this->Given.isSegment(slot))
    {
      return link;
    }
    this->addRays(start, stop, false);
    return link | RefinementMesh::IsSegment;
  }

  /// Adds a segment with the domain to its left as seen from its start; at the border also as seen
  /// from its end. Otherwise the triangle beside it does so.
  void addRays(Index start, Index stop, bool isBorder)
  {
    const Index number = this->Mesh.segmentBetween(start, stop);
    const InputSegment& segment = this->Mesh.Segments[std::size_t(number)];
    const auto directionOf = [&](std::size_t from)
    {
      const Point2 along = segment.Ends[1 - from] - segment.Ends[from];
      return degreesOf(along.x, along.y);
    };
    const std::size_t from = segment.Ids[0] == start ? 0 : 1;
    this->Rays.push_back({ start, directionOf(from), number, from, true });
    if (isBorder)
    {
      this->Rays.push_back({ stop, directionOf(1 - from), number, 1 - from, false });
    }
  }

  const PointsView Points;
  const GivenTriangles& Given;
  RefinementMesh& Mesh;
  std::vector<Index> Numbers;  ///< of the given triangles in the mesh, or -1
  std::vector<Index> Vertices; ///< of the points in the mesh, or -1
  Index VertexEnd = 0;
  std::vector<Ray> Rays;
};

} // namespace

void startMesh(PointsView points, const ConstrainedTriangulation& triangulation,
  const RefinementOptions& options, RefinementMesh& mesh)
{
  if (points.size() + RefinementMesh::PointsInGroup > mesh.Points.capacity())
  {
    throw std::length_error("The mesh would have too many points for the memory.");
  }
  mesh.Points.grow(points.size() + RefinementMesh::PointsInGroup);
  mesh.Origins.grow(points.size() + RefinementMesh::PointsInGroup);
  for (const IdSegment& segment : triangulation.Constraints.Segments)
  {
    const auto a = Index(segment.A);
    const auto b = Index(segment.B);
    if (!mesh.has(a, b))
    {
      mesh.add(segmentBetween(points, a, b, segment.Constraint));
    }
  }
  GivenTriangles given(triangulation.Mesh, mesh);
  if (options.IsEnclosed)
  {
    given.keepEnclosed();
  }
  const std::vector<std::uint32_t> regions = given.regions(points, options.Regions);
  MeshStart(points, given, mesh).run(regions);
}

} // namespace tipp

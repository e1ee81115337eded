// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/InitialMesh.h"

#include "Kernel/DelaunayKernel.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
namespace
{

double meanLongSide(const Tiling& tiling)
{
  double sum = 0;
  for (PartitionIndex i = 0; i < tiling.size(); ++i)
  {
    const Box2& box = tiling.box(i);
    sum += std::max(box.xmax - box.xmin, box.ymax - box.ymin) / tiling.size();
  }
  return sum;
}

/// The margin, but at least some units in the last place: coordinates may be large and close.
double outward(double bound, double direction, double margin)
{
  double moved = bound + direction * margin;
  for (int i = 0; i < 4; ++i)
  {
    bound = std::nextafter(bound, direction * HUGE_VAL);
  }
  return direction > 0 ? std::max(moved, bound) : std::min(moved, bound);
}

int piecesOf(double side, double spacing)
{
  constexpr double most = 4096;
  return static_cast<int>(std::clamp(std::ceil(side / spacing), 1.0, most));
}

/// The sets of finite triangles with a common edge, where they differ; each pair once. SetOf: of
/// the finite triangles, in the kernel's order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> adjacentSets(
  const DelaunayKernel& kernel, const std::vector<std::uint32_t>& setOf)
{
  constexpr std::uint32_t none = ~0U;
  const HalfEdgeMesh& mesh = kernel.mesh();
  std::vector<std::uint32_t> sets(std::size_t(mesh.end() / 8), none);
  auto set = setOf.begin();
  for (DelaunayKernel::Index t = 0; t < mesh.end(); t += 8)
  {
    if (!kernel.isInfinite(t))
    {
      sets[std::size_t(t / 8)] = *set++;
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (DelaunayKernel::Index t = 0; t < mesh.end(); t += 8)
  {
    for (DelaunayKernel::Index i = 0; i < 3; ++i)
    {
      const std::uint32_t one = sets[std::size_t(t / 8)];
      const std::uint32_t other = sets[std::size_t(HalfEdgeMesh::triangleOf(mesh.twin(t + i)) / 8)];
      if (one < other && other != none)
      {
        pairs.emplace_back(one, other);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

} // namespace

std::vector<SeamVertex> makeArtificialPoints(const Tiling& tiling)
{
  const double margin = meanLongSide(tiling);
  const Box2& domain = tiling.domain();
  const Box2 frame = { outward(domain.xmin, -1, margin), outward(domain.ymin, -1, margin),
    outward(domain.xmax, 1, margin), outward(domain.ymax, 1, margin) };
  const double width = frame.xmax - frame.xmin;
  const double height = frame.ymax - frame.ymin;
  std::vector<SeamVertex> vertices;
  if (!std::isfinite(width) || !std::isfinite(height))
  {
    return vertices;
  }
  const auto add = [&](double x, double y)
  {
    const Point2 p = { x, y };
    vertices.push_back({ p, -1 - std::int64_t(vertices.size()), tiling.locate(p) });
  };
  const int columns = piecesOf(width, margin);
  for (int i = 0; i <= columns; ++i)
  {
    const double x = i < columns ? frame.xmin + width * (double(i) / columns) : frame.xmax;
    add(x, frame.ymin);
    add(x, frame.ymax);
  }
  const int rows = piecesOf(height, margin);
  for (int i = 1; i < rows; ++i)
  {
    const double y = frame.ymin + height * (double(i) / rows);
    add(frame.xmin, y);
    add(frame.xmax, y);
  }
  return vertices;
}

template <typename Id>
std::vector<SeamVertex> chooseInitialPoints(
  const Tiling& tiling, const PointBuckets<Id>& buckets, int perPartition)
{
  std::vector<SeamVertex> vertices;
  for (PartitionIndex p = 0; p < tiling.size(); ++p)
  {
    const std::size_t count = buckets.count(p);
    const std::size_t chosen = std::min(count, static_cast<std::size_t>(perPartition));
    for (std::size_t i = 0; i < chosen; ++i)
    {
      const std::size_t at = (2 * i + 1) * count / (2 * chosen);
      vertices.push_back({ buckets.points(p)[at], buckets.id(p, at), p });
    }
  }
  return vertices;
}

template <typename Boxes>
SeamTriangles triangulateVertices(
  const Boxes& boxes, const std::vector<SeamVertex>& vertices, int threads)
{
  std::vector<Point2> points;
  points.reserve(vertices.size());
  for (const SeamVertex& v : vertices)
  {
    points.push_back(v.Place);
  }
  DelaunayKernel kernel;
  kernel.insert(points.data(), points.size());

  const HalfEdgeMesh& mesh = kernel.mesh();
  const std::int64_t triangles = mesh.end() / 8;
  std::vector<SeamTriangles> parts(static_cast<std::size_t>(threads));
  const auto collect = [&](std::int64_t part)
  {
    const std::int64_t end = triangles * (part + 1) / threads;
    for (std::int64_t t = triangles * part / threads; t < end; ++t)
    {
      if (kernel.isInfinite(static_cast<DelaunayKernel::Index>(8 * t)))
      {
        continue;
      }
      const DelaunayKernel::Index* v = mesh.slots() + 8 * t;
      const SeamTriangles::Corners corners = { kernel.place(v[0]), kernel.place(v[1]),
        kernel.place(v[2]) };
      parts[std::size_t(part)].add(
        boxes, corners, Circumdisk(kernel.point(v[0]), kernel.point(v[1]), kernel.point(v[2])));
    }
  };
  parallelFor(threads, threads, collect);
  SeamTriangles& all = parts[0];
  for (std::size_t i = 1; i < parts.size(); ++i)
  {
    all.appendTriangles(parts[i]);
  }
  all.Vertices = vertices;
  all.AdjacentSets = adjacentSets(kernel, all.SetOf);
  return std::move(all);
}

bool partitionsPay(const SeamTriangles& initialMesh)
{
  constexpr std::size_t most = 3;
  std::size_t met = 0;
  for (const std::uint32_t set : initialMesh.SetOf)
  {
    met += std::size_t(initialMesh.Sets.end(set) - initialMesh.Sets.begin(set));
  }
  return met <= most * initialMesh.size();
}

template SeamTriangles triangulateVertices(const Tiling&, const std::vector<SeamVertex>&, int);
template SeamTriangles triangulateVertices(const Regions&, const std::vector<SeamVertex>&, int);
template std::vector<SeamVertex> chooseInitialPoints(
  const Tiling&, const PointBuckets<std::int32_t>&, int);
template std::vector<SeamVertex> chooseInitialPoints(
  const Tiling&, const PointBuckets<std::int64_t>&, int);

} // namespace tipp

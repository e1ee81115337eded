// SPDX-License-Identifier: BSD-3-Clause
#include "Series/ChosenTriangles.h"

#include "Arrays/IndexSet.h"
#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

void requireFew(const MeshSeries& series, std::int64_t count)
{
  if (count > std::numeric_limits<std::int32_t>::max())
  {
    throw IOError(series.Path, "has more than 2147483647 nodes or triangles; partition it first.");
  }
}

} // namespace

ChosenTriangles::ChosenTriangles(MeshSeries& series, const MakeTest& makeTest, int threads)
{
  Test test;
  SeriesNodes nodes = series.readTriangles(
    [&](const SeriesNodes& known, const SeriesTriangles& triangles)
    {
      test = test ? test : makeTest(known);
      this->take(series, known, triangles, test, threads);
    });
  requireFew(series, nodes.size());
  this->keepNodes(std::move(nodes), threads);
}

void ChosenTriangles::take(MeshSeries& series, const SeriesNodes& nodes,
  const SeriesTriangles& triangles, const Test& test, int threads)
{
  constexpr std::int64_t chunk = 1 << 14;
  const auto count = std::int64_t(triangles.Nodes.size() / 3);
  const auto chunks = std::size_t((count + chunk - 1) / chunk);
  std::vector<std::vector<std::int32_t>> chosen(chunks); ///< indices in `triangles`
  std::vector<Box2> boxes(chunks, Box2::empty());
  requireFew(series, this->Triangles + count);
  forChunks(count, chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      const auto at = std::size_t(begin / chunk);
      for (std::int64_t i = begin; i < end; ++i)
      {
        Box2 box = Box2::empty();
        bool areFinite = true;
        for (std::size_t corner = 0; corner < 3; ++corner)
        {
          const Point2 p = nodes[triangles.Nodes[3 * std::size_t(i) + corner]];
          areFinite = areFinite && isFinite(p);
          box.extend(p);
        }
        if (areFinite) // others contain nothing
        {
          boxes[at].extend(box);
          if (test(box))
          {
            chosen[at].push_back(std::int32_t(i));
          }
        }
      }
    });
  const bool hasCells =
    !this->Cells.empty() || !triangles.Cells.empty() || triangles.FirstCell != this->Triangles;
  if (hasCells && this->Cells.empty())
  {
    this->Cells = this->Indices;
  }
  for (std::size_t i = 0; i < chunks; ++i)
  {
    this->Bounds.extend(boxes[i]);
    for (const std::int32_t triangle : chosen[i])
    {
      const auto first = triangles.Nodes.begin() + 3 * std::ptrdiff_t(triangle);
      this->Corners.insert(this->Corners.end(), first, first + 3);
      this->Indices.push_back(std::int32_t(this->Triangles + triangle));
      if (hasCells)
      {
        this->Cells.push_back(std::int32_t(triangles.cell(std::size_t(triangle))));
      }
    }
  }
  this->Triangles += count;
}

void ChosenTriangles::keepNodes(SeriesNodes nodes, int threads)
{
  IndexSet used(nodes.size());
  for (const std::int32_t node : this->Corners)
  {
    used.add(node);
  }
  if (this->Corners.empty() && nodes.size() > 0)
  {
    used.add(0); // a mesh without triangles needs a node, too
  }
  used.number();
  forIndices(
    std::int64_t(this->Corners.size()),
    [&](std::int64_t i)
    {
      std::int32_t& corner = this->Corners[std::size_t(i)];
      corner = std::int32_t(used.rank(corner));
    },
    threads);
  this->XYZ.reserve(3 * std::size_t(used.count()));
  this->StoredNodes.reserve(std::size_t(used.count()));
  nodes.consume(
    [&](std::int64_t node, Point2 p)
    {
      if (used.contains(node))
      {
        this->XYZ.insert(this->XYZ.end(), { p.x, p.y, 0.0 });
        this->StoredNodes.push_back(std::int32_t(nodes.stored(node)));
      }
    });
}

SimplexMesh ChosenTriangles::mesh() const
{
  SimplexMesh mesh;
  mesh.Points = this->XYZ.data();
  mesh.PointCount = std::int64_t(this->XYZ.size() / 3);
  mesh.Ids = this->Corners.data();
  mesh.Cells = std::int64_t(this->Corners.size() / 3);
  return mesh;
}

ChosenTriangles::Stored ChosenTriangles::storedNodes(std::vector<std::int32_t> chosen) const
{
  for (std::int32_t& node : chosen)
  {
    node = this->StoredNodes[std::size_t(node)];
  }
  if (std::is_sorted(chosen.begin(), chosen.end()))
  {
    return { std::move(chosen), {} };
  }
  // Copies of nodes have the values of those that they are copies of.
  std::vector<std::int32_t> order(chosen.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&chosen](std::int32_t a, std::int32_t b)
    { return chosen[std::size_t(a)] < chosen[std::size_t(b)]; });
  Stored stored{ {}, std::vector<std::int32_t>(chosen.size()) };
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    stored.At.push_back(chosen[std::size_t(order[rank])]);
    stored.Ranks[std::size_t(order[rank])] = std::int32_t(rank);
  }
  return stored;
}

std::vector<std::int32_t> ChosenTriangles::storedCells(std::vector<std::int32_t> chosen) const
{
  const std::vector<std::int32_t>& cells = this->Cells.empty() ? this->Indices : this->Cells;
  for (std::int32_t& triangle : chosen)
  {
    triangle = cells[std::size_t(triangle)];
  }
  return chosen;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesAtPoints.h"

#include "Arrays/IndexSet.h"
#include "Locate/CellLocator.h"
#include "Resample/SimplexMesh.h"
#include "Series/ChosenTriangles.h"
#include "Series/PointCounts.h"

#include <cstddef>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

constexpr double turn = 360;

/// Reads the triangles that may contain one of the points or, if they are longitudes, a point a
/// turn away from one.
ChosenTriangles trianglesAt(
  MeshSeries& series, const std::vector<Point3>& points, bool wraps, int threads)
{
  const PointCounts counts(points);
  const auto holds = [&counts, wraps](const Box2& box)
  {
    const auto shifted = [&box](double by) {
      return Box2{ { box.Min.x + by, box.Min.y }, { box.Max.x + by, box.Max.y } };
    };
    return counts.mayHold(box) ||
      (wraps && (counts.mayHold(shifted(-turn)) || counts.mayHold(shifted(turn))));
  };
  return { series, [&holds](const SeriesNodes&) -> ChosenTriangles::Test { return holds; },
    threads };
}

} // namespace

SeriesAtPoints::SeriesAtPoints(
  MeshSeries& series, std::vector<Point3> points, bool wraps, int threads)
  : Triangles(points.size(), -1)
  , Nodes(points.size())
  , Weights(points.size())
  , Cells(points.size())
{
  const ChosenTriangles triangles = trianglesAt(series, points, wraps, threads);
  this->Bounds = triangles.bounds();
  const SimplexMesh mesh = triangles.mesh();
  std::vector<std::int32_t> inTriangles(points.size(), -1);
  const auto take = [&](const std::int64_t* found, const CellLocation* at, std::int64_t count)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      const auto point = std::size_t(found[i]);
      inTriangles[point] = std::int32_t(at[i].Cell);
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        this->Weights[point][corner] = at[i].Weights[corner];
      }
    }
  };
  for (const double shift : { 0.0, turn, -2 * turn }) // one turn to the east, then to the west
  {
    std::vector<std::int64_t> asked;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      points[i].x += shift;
      if (inTriangles[i] < 0)
      {
        asked.push_back(std::int64_t(i));
      }
    }
    locatePoints(mesh, nullptr, nullptr,
      { points.data(), asked.data(), std::int64_t(asked.size()) }, threads, take);
    if (!wraps)
    {
      break;
    }
  }
  this->store(triangles, inTriangles);
}

/// `found`: the chosen triangle of each point; -1: none.
void SeriesAtPoints::store(const ChosenTriangles& triangles, const std::vector<std::int32_t>& found)
{
  const SimplexMesh mesh = triangles.mesh();
  IndexSet nodes(mesh.PointCount);
  IndexSet cells(mesh.Cells);
  for (const std::int32_t triangle : found)
  {
    for (std::size_t corner = 0; triangle >= 0 && corner < 3; ++corner)
    {
      nodes.add(triangles.node(triangle, corner));
      cells.add(triangle);
    }
  }
  nodes.number();
  cells.number();
  ChosenTriangles::Stored stored = triangles.storedNodes(nodes.elements());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    for (std::size_t corner = 0; found[i] >= 0 && corner < 3; ++corner)
    {
      const auto rank = std::size_t(nodes.rank(triangles.node(found[i], corner)));
      this->Nodes[i][corner] = stored.Ranks.empty() ? rank : std::size_t(stored.Ranks[rank]);
    }
    if (found[i] >= 0)
    {
      this->Triangles[i] = triangles.indexOf(found[i]);
      this->Cells[i] = std::size_t(cells.rank(found[i]));
    }
  }
  this->StoredNodes = std::move(stored.At);
  this->StoredCells = triangles.storedCells(cells.elements());
}

std::vector<double> SeriesAtPoints::valuesOf(
  const SeriesVariable& variable, const std::vector<double>& read) const
{
  std::vector<double> values(this->Triangles.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (this->Triangles[i] < 0)
    {
      continue;
    }
    values[i] = variable.OnCells ? read[this->Cells[i]] : 0;
    for (std::size_t corner = 0; corner < 3 && !variable.OnCells; ++corner)
    {
      values[i] += this->Weights[i][corner] * read[this->Nodes[i][corner]];
    }
  }
  return values;
}

} // namespace tipp

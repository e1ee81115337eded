// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesAtPoints.h"

#include "Locate/CellLocator.h"
#include "Resample/SimplexMesh.h"
#include "Series/SpacePoints.h"

#include <cstddef>
#include <limits>

namespace tipp
{

SeriesAtPoints::SeriesAtPoints(
  MeshSeries& series, std::vector<Point3> points, bool wraps, int threads)
  : Triangles(points.size(), -1)
  , Nodes(points.size())
  , Weights(points.size())
{
  const SeriesMesh read = series.readMesh();
  const SpacePoints nodes(read.XY, threads);
  const SimplexMesh mesh = nodes.meshOf(read.Triangles);
  const auto take = [&](const std::int64_t* found, const CellLocation* at, std::int64_t count)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      const auto point = std::size_t(found[i]);
      this->Triangles[point] = at[i].Cell;
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        this->Nodes[point][corner] = read.Triangles[3 * std::size_t(at[i].Cell) + corner];
        this->Weights[point][corner] = at[i].Weights[corner];
      }
    }
  };
  constexpr double turn = 360;
  for (const double shift : { 0.0, turn, -2 * turn }) // one turn to the east, then to the west
  {
    std::vector<std::int64_t> asked;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      points[i].x += shift;
      if (this->Triangles[i] < 0)
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
    values[i] = variable.OnCells ? read[std::size_t(this->Triangles[i])] : 0;
    for (std::size_t corner = 0; corner < 3 && !variable.OnCells; ++corner)
    {
      values[i] += this->Weights[i][corner] * read[std::size_t(this->Nodes[i][corner])];
    }
  }
  return values;
}

} // namespace tipp

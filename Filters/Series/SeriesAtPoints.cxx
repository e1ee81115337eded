// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesAtPoints.h"

#include "Locate/CellLocator.h"
#include "Resample/SimplexMesh.h"
#include "Series/SpacePoints.h"

#include <cstddef>
#include <limits>

namespace tipp
{

SeriesAtPoints::SeriesAtPoints(MeshSeries& series, const std::vector<Point3>& points, int threads)
  : Triangles(points.size(), -1)
  , Nodes(points.size())
  , Weights(points.size())
{
  const SeriesMesh read = series.readMesh();
  const SpacePoints nodes(read.XY, threads);
  const SimplexMesh mesh = nodes.meshOf(read.Triangles);
  locatePoints(mesh, nullptr, nullptr, { points.data(), nullptr, std::int64_t(points.size()) },
    threads,
    [&](const std::int64_t* found, const CellLocation* at, std::int64_t count)
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
    });
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/CellMeans.h"

#include <limits>

namespace tipp
{
namespace
{

ResidentOptions queryOptions(int threads)
{
  ResidentOptions options;
  options.Threads = threads;
  return options;
}

} // namespace

CellMeans::CellMeans(const MeshPart& part, int threads)
  : Part(part)
  , Mesh(part, queryOptions(threads))
  , Sums(std::size_t(part.Mesh.PointCount), 0)
  , Counts(std::size_t(part.Mesh.PointCount), 0)
{
}

void CellMeans::add(const std::vector<Point3>& points, const std::vector<double>& values)
{
  AnswerOptions wanted;
  wanted.Weights = true;
  const MeshAnswer answer = this->Mesh.answer(points.data(), std::int64_t(points.size()), wanted);
  // One thread adds: the order of additions, and so their rounding, is that of the points.
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::int64_t triangle = answer.Cells[i];
    if (triangle < 0)
    {
      continue;
    }
    const double* const weights = &answer.Weights[3 * i];
    std::int64_t node = cornerOf(this->Part.Mesh, triangle, 0);
    double weight = weights[0];
    for (int corner = 1; corner < 3; ++corner)
    {
      const std::int64_t other = cornerOf(this->Part.Mesh, triangle, corner);
      if (weights[corner] > weight || (weights[corner] == weight && other < node))
      {
        node = other;
        weight = weights[corner];
      }
    }
    this->Sums[std::size_t(node)] += values[i];
    ++this->Counts[std::size_t(node)];
  }
}

double CellMeans::meanOf(std::size_t node) const
{
  return this->Counts[node] > 0 ? this->Sums[node] / double(this->Counts[node])
                                : std::numeric_limits<double>::quiet_NaN();
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed3D/WholeTriangulation3.h"

#include "Kernel3D/DelaunayKernel3.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <utility>

namespace tipp
{

WholeTriangulation3::WholeTriangulation3(
  const Buffer<Point3>& points, const TetrahedralizationOptions& options, int threads)
{
  DelaunayKernel3 kernel;
  this->Aborted = !kernel.triangulate(
    points.data(), points.size(),
    [&](std::size_t inserted)
    { return !options.Progress || options.Progress(double(inserted) / double(points.size())); },
    threads);
  this->Dimension = kernel.dimension();
  if (this->Dimension == 2)
  {
    this->takeTriangles(points, options);
    return;
  }
  kernel.forEach(
    [&](DelaunayKernel3::Index cell)
    {
      if (!kernel.isInfinite(cell))
      {
        const auto [a, b, c, d] = kernel.corners(cell);
        this->Cells.push_back({ kernel.pointIndex(a), kernel.pointIndex(b), kernel.pointIndex(c),
          kernel.pointIndex(d) });
      }
    });
  for (const DelaunayKernel3::Duplicate& duplicate : kernel.duplicates())
  {
    this->Duplicates.push_back({ duplicate.Point, kernel.pointIndex(duplicate.Vertex) });
  }
}

void WholeTriangulation3::takeTriangles(
  const Buffer<Point3>& points, const TetrahedralizationOptions& options)
{
  Tetrahedralization flat;
  Triangulation triangles = triangulateCoplanar(points.data(), points.size(), options, flat);
  this->Aborted = triangles.Aborted;
  this->Duplicates = std::move(triangles.Duplicates);
  const std::int32_t* const ids = triangles.Ids32.data();
  for (std::size_t i = 0; i < triangles.Ids32.size(); i += 3)
  {
    this->Cells.push_back({ ids[i], ids[i + 1], ids[i + 2], ids[i + 2] });
  }
}

} // namespace tipp

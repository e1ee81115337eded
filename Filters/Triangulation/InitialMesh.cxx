// SPDX-License-Identifier: BSD-3-Clause
#include "Triangulation/InitialMesh.h"

#include "Triangulation/Dimension.h"
#include "Triangulation/KernelCells.h"

namespace tipp
{

template <int D>
BoundaryCells<D> triangulateVertices(
  const RegionsOf<D>& regions, const std::vector<VertexOf<Point<D>>>& vertices, int threads)
{
  typename Dimension<D>::Kernel kernel;
  Dimension<D>::triangulate(kernel, positionsOf(vertices));
  BoundaryCells<D> all = findCells<D>(kernel, regions, nullptr, threads).Mesh;
  all.Vertices = vertices;
  all.AdjacentSets = adjacentSets<D + 1>(kernel, setsByNumber(kernel, all.SetOf));
  return all;
}

template BoundaryCells<2> triangulateVertices(
  const RegionsOf<2>& regions, const std::vector<VertexOf<Point<2>>>& vertices, int threads);
template BoundaryCells<3> triangulateVertices(
  const RegionsOf<3>& regions, const std::vector<VertexOf<Point<3>>>& vertices, int threads);

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/TrianglePart.h"

#include <cstddef>
#include <memory>
#include <utility>

namespace tipp
{

MeshPart partOfTriangles(const std::vector<double>& xy, TrianglesView triangles)
{
  const std::size_t nodes = xy.size() / 2;
  auto xyz = std::make_shared<std::vector<double>>(3 * nodes, 0.0);
  for (std::size_t i = 0; i < nodes; ++i)
  {
    (*xyz)[3 * i] = xy[2 * i];
    (*xyz)[3 * i + 1] = xy[2 * i + 1];
  }
  MeshPart part;
  part.Mesh.Points = xyz->data();
  part.Mesh.PointCount = std::int64_t(nodes);
  part.Mesh.Cells = std::int64_t(triangles.size());
  triangles.withIds(
    [&part](const auto* ids)
    {
      part.Mesh.Ids = ids;
      part.Mesh.Wide = sizeof(*ids) == sizeof(std::int64_t);
    });
  part.OwnedCells = part.Mesh.Cells;
  part.Keeps = std::move(xyz);
  return part;
}

} // namespace tipp

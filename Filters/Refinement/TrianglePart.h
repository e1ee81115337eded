// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTrianglePart_h
#define tippTrianglePart_h

#include "Meshes/MeshOptions.h"
#include "Resident/MeshPart.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace tipp
{

/// Makes a mesh for queries from nodes and triangles. The result has a copy of the coordinates, 24
/// bytes per node, and refers to the triangles' ids, which must outlive it.
MeshPart partOfTriangles(const NodesView& nodes, TrianglesView triangles);

/// Makes a mesh for queries from some triangles, whose indices are ascending, and their corners. It
/// must have all triangles at the nodes for which `isOwned` is true; the others are marked as those
/// of another part. MeshPart::PointIds are the indices of nodes in the whole mesh, ascending.
MeshPart partOfTriangles(const NodesView& nodes, TrianglesView triangles,
  const std::int32_t* chosen, std::size_t count,
  const std::function<bool(std::int64_t node)>& isOwned);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTrianglePart_h
#define tippTrianglePart_h

#include "Meshes/MeshOptions.h"
#include "Resident/MeshPart.h"

#include <vector>

namespace tipp
{

/// Makes a mesh for queries from the nodes' x and y, interleaved, and triangles. The result has a
/// copy of the coordinates, 24 bytes per node, and refers to the triangles' ids, which must outlive
/// it.
MeshPart partOfTriangles(const std::vector<double>& xy, TrianglesView triangles);

} // namespace tipp

#endif

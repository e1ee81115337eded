// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadMesh_h
#define tippReadMesh_h

#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

struct TriangleMesh
{
  std::vector<std::int64_t> Triangles; ///< three point ids per triangle, as stored in the file
  std::vector<double> XY;              ///< the file's own points; empty for an .npy file
  std::vector<std::int64_t> Neighbors; ///< three per triangle, if the file has NeighborIds
};

/// Reads triangles from .npy (m x 3 integers), .14 or .grd (ADCIRC) or a VTK file (.vtp, .vtu,
/// .vtk, .ply ... whose cells are all triangles). The ids are not checked. Throws IOError.
VTKTIPPIO_EXPORT TriangleMesh readMesh(const std::string& path);

} // namespace tipp

#endif

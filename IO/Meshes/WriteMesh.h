// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteMesh_h
#define tippWriteMesh_h

#include "Files/OutputPath.h"
#include "Meshes/TrianglesView.h"
#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

struct MeshOptions
{
  /// One point id per point, written as the point array "RepresentativePointId"; empty: no such
  /// array.
  std::vector<std::int64_t> Representatives;
  /// Adds the cell array "NeighborIds": for each corner of a triangle the index of the triangle
  /// opposite to it, or -1.
  bool Neighbors = false;
  /// An ADCIRC grid whose nodes are the first points: another that is written keeps its title,
  /// numbers of nodes and boundaries. Empty: none.
  std::string AdcircLike;
  /// What may be replaced, as for PendingFile.
  std::optional<PathState> Before;
  /// Called once all is written under a temporary name; returning true discards it.
  std::function<bool()> Aborted;
};

/// Whether writeMesh() supports the extension.
VTKTIPPIO_EXPORT bool isMeshFile(const std::string& path);

/// Writes triangles by the path's extension: .npy (m x 3 int64 point ids; points are not written),
/// .vtp or .vtu (appended raw binary: all points, the column named z as third coordinate or else 0,
/// the other columns as point data), or .14, .grd (an ADCIRC grid, see WriteAdcirc.h). The file
/// appears whole or not at all: false if Aborted said so; throws IOError.
VTKTIPPIO_EXPORT bool writeMesh(const std::string& path, const PointTable& points,
  TrianglesView triangles, const MeshOptions& options = {});

} // namespace tipp

#endif

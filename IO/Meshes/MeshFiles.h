// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshFiles_h
#define tippMeshFiles_h

#include "Files/OutputPath.h"
#include "Meshes/Triangles.h"
#include "Points/PointTable.h"
#include "vtkTIPPIOModule.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace tipp
{

/// The content of a data set besides columns of points; each may be null or empty.
struct MeshData
{
  const std::vector<std::int64_t>* Representatives = nullptr; ///< one point id per point
  const std::vector<std::int64_t>* Neighbors = nullptr;       ///< three triangle ids per triangle
};

/// Creates data sets over the caller's memory (only coordinates and cell offsets are copies): they
/// must not outlive it, and are for writers, which do not change it. A column named z is the third
/// coordinate, the others are point data.
vtkSmartPointer<vtkPolyData> makePolyData(
  const PointTable& points, TrianglesView triangles, const MeshData& more);
vtkSmartPointer<vtkUnstructuredGrid> makeUnstructuredGrid(
  const PointTable& points, TrianglesView triangles, const MeshData& more);

struct TriangleMesh
{
  std::vector<std::int64_t> Triangles; ///< three point ids per triangle, as stored in the file
  std::vector<double> XY;              ///< the file's own points; empty for an .npy file
  std::vector<std::int64_t> Neighbors; ///< three per triangle, if the file has NeighborIds
};

/// Reads triangles from .npy (m x 3 integers), .14 or .grd (ADCIRC) or a VTK file (.vtp, .vtu,
/// .vtk, .ply ... whose cells are all triangles). The ids are not checked. Throws IOError.
VTKTIPPIO_EXPORT TriangleMesh readMesh(const std::string& path);

struct MeshOptions
{
  /// One point id per point, written as the point array "RepresentativePointId"; empty: no such
  /// array.
  std::vector<std::int64_t> Representatives;
  /// Adds the cell array "NeighborIds": for each corner of a triangle the index of the triangle
  /// opposite to it, or -1.
  bool Neighbors = false;
  /// An ADCIRC grid whose nodes are the first points; an ADCIRC file that is written keeps its
  /// title, node numbers and boundaries. Empty: none.
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
/// the other columns as point data), or .14, .grd (an ADCIRC grid, see writeAdcircGrid). The file
/// appears only when it is complete. Returns false if Aborted returned true; throws IOError.
VTKTIPPIO_EXPORT bool writeMesh(const std::string& path, const PointTable& points,
  TrianglesView triangles, const MeshOptions& options = {});

} // namespace tipp

#endif

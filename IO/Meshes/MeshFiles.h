// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshFiles_h
#define tippMeshFiles_h

#include "Meshes/MeshOptions.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

// Declared alone: the wheel is built without VTK.
class vtkPolyData;
class vtkUnstructuredGrid;
template <class T>
class vtkSmartPointer;

namespace tipp
{

struct Piece;

/// The cell array of cells across facets.
constexpr const char* neighborIdsName = "NeighborIds";

/// The column of `nodes` that is the third coordinate in files: named z or Z; null: there is none.
const NodeColumn* findZ(const NodesView& nodes);

/// Creates a data set over the caller's memory, which must outlive it and must not be changed
/// through it; only coordinates and cell offsets are copies. A column named z is the third
/// coordinate, the others are point data.
vtkSmartPointer<vtkPolyData> makePolyData(const PointTable& points, TrianglesView triangles);

/// Converts a piece to a VTK data set that takes ownership of its memory: global ids as such,
/// vtkGhostType of points, and of cells if the piece has borrowed ones.
VTKTIPPIO_EXPORT vtkSmartPointer<vtkUnstructuredGrid> makeGrid(Piece&& piece);

/// Triangles read from a file.
struct TriangleMesh
{
  std::vector<std::int64_t> Triangles; ///< three point ids per triangle, as stored in the file
  std::vector<double> XY;              ///< the file's own points; empty for an .npy file
  std::vector<std::int64_t> Neighbors; ///< three per triangle, if the file has NeighborIds
};

/// Reads triangles from .npy (m x 3 integers), a mesh of a model (see readModelMesh()) or a VTK
/// file
/// (.vtp, .vtu, .vtk, .ply ... whose cells are all triangles). The ids of .npy files are not
/// checked. Throws IOError.
VTKTIPPIO_EXPORT TriangleMesh readMesh(const std::string& path);

/// Whether a file is of triangles with points of its own: .14 or .grd (ADCIRC), or a VTK file whose
/// first cell is a triangle. Throws IOError.
VTKTIPPIO_EXPORT bool holdsTriangles(const std::string& path);

/// Writes triangles by the path's extension: .npy (m x 3 int64 point ids; points are not written),
/// .vtp or .vtu (appended raw binary: all points, the column named z as third coordinate or else 0,
/// the other columns as point data), as NetCDF by UGRID (.nc: all columns), or as text for models
/// (.14, .grd, .gr3, .2dm, .msh, .node or .ele: see Meshes/TextMeshes.h). The file appears only
/// when it is complete. Returns false if Aborted returned true; throws IOError.
VTKTIPPIO_EXPORT bool writeMesh(const std::string& path, const NodesView& nodes,
  TrianglesView triangles, const MeshOptions& options = {});

/// The files that belong together: for a file of Triangle (.node, .ele or .poly) the .node and .ele
/// files, with `hasSegments` also the .poly file, and the path itself; otherwise the path alone.
/// writeMesh() writes these files if it writes `path`. `hasSegments`: whether MeshOptions::Segments
/// are given.
VTKTIPPIO_EXPORT std::vector<std::string> filesOfMesh(const std::string& path, bool hasSegments);
/// The same for several paths, without segments.
VTKTIPPIO_EXPORT std::vector<std::string> filesOfMeshes(const std::vector<std::string>& paths);

/// The index of a table's column that is the third coordinate: named z, Z or elevation. Throws
/// IOError, with the file's name `path`, if there is none.
VTKTIPPIO_EXPORT std::size_t requireElevation(const PointTable& points, const std::string& path);

/// Writes tetrahedra of four point ids each: .npy (m x 4 int64; points are not written) or .vtu
/// (appended raw binary: all points, and all columns but the third coordinate as point data).
/// `neighbors`, if not empty, has four tetrahedron indices per tetrahedron and is written as
/// "NeighborIds". The file appears only when it is complete. Returns false if options.Aborted
/// returned true; throws IOError.
VTKTIPPIO_EXPORT bool writeTetrahedra(const std::string& path, PointTable points,
  const std::int32_t* ids, std::size_t tetrahedra, const std::vector<std::int64_t>& neighbors,
  const MeshOptions& options);

/// Tetrahedra read from a file.
struct StoredTetrahedra
{
  std::vector<std::int64_t> Ids;       ///< four point ids each, as stored in the file
  std::vector<double> XYZ;             ///< the file's own points; empty for an .npy file
  std::vector<std::int64_t> Neighbors; ///< four each, if the file has NeighborIds
};

/// Whether a file is of tetrahedra: .npy of four columns of integers, or a VTK file whose first
/// cell is one. Throws IOError.
VTKTIPPIO_EXPORT bool holdsTetrahedra(const std::string& path);

/// Reads tetrahedra from such a file. The ids are not checked. Throws IOError if the file cannot be
/// read or has other cells.
VTKTIPPIO_EXPORT StoredTetrahedra readTetrahedra(const std::string& path);

/// @name Files that VTK reads
/// readMesh(), holdsTriangles(), holdsTetrahedra() and readTetrahedra() for such files. They throw
/// IOError in a build without VTK.
///@{
TriangleMesh readVtkTriangles(const std::string& path);
bool holdsVtkTriangles(const std::string& path);
bool holdsVtkTetrahedra(const std::string& path);
StoredTetrahedra readVtkTetrahedra(const std::string& path);
///@}

} // namespace tipp

#endif

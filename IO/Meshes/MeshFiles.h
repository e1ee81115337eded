// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshFiles_h
#define tippMeshFiles_h

#include "Files/PendingOutput.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
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

/// A view of triangles in the caller's memory: three consecutive point ids each, of 32 or 64 bits.
class TrianglesView
{
public:
  TrianglesView() = default;
  TrianglesView(const std::int32_t* ids, std::size_t triangles)
    : Ids32(ids)
    , Count(triangles)
  {
  }
  TrianglesView(const std::int64_t* ids, std::size_t triangles)
    : Ids64(ids)
    , Count(triangles)
  {
  }

  std::size_t size() const { return this->Count; }

  std::int64_t id(std::size_t triangle, int corner) const
  {
    const std::size_t at = 3 * triangle + std::size_t(corner);
    // If there is a triangle, one of the two pointers is set.
    return this->Ids32 ? this->Ids32[at]
                       : this->Ids64[at]; // NOLINT(clang-analyzer-core.NullDereference)
  }

  /// Returns work(ids) for the pointer to the ids, of whichever size.
  template <typename Work>
  auto withIds(const Work& work) const
  {
    return this->Ids32 ? work(this->Ids32) : work(this->Ids64);
  }

private:
  const std::int32_t* Ids32 = nullptr;
  const std::int64_t* Ids64 = nullptr;
  std::size_t Count = 0;
};

/// The cell array of cells across facets.
constexpr const char* neighborIdsName = "NeighborIds";

/// The column that is the third coordinate in files: named z or Z; null if there is none.
const PointTable::Column* findZ(const PointTable& points);

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

/// Reads triangles from .npy (m x 3 integers), .14 or .grd (ADCIRC) or a VTK file (.vtp, .vtu,
/// .vtk, .ply ... whose cells are all triangles). The ids are not checked. Throws IOError.
VTKTIPPIO_EXPORT TriangleMesh readMesh(const std::string& path);

/// Whether a file is of triangles with points of its own: .14 or .grd (ADCIRC), or a VTK file whose
/// first cell is a triangle. Throws IOError.
VTKTIPPIO_EXPORT bool holdsTriangles(const std::string& path);

/// Options of writeMesh().
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

/// Writes triangles by the path's extension: .npy (m x 3 int64 point ids; points are not written),
/// .vtp or .vtu (appended raw binary: all points, the column named z as third coordinate or else 0,
/// the other columns as point data), or .14, .grd (an ADCIRC grid, see writeAdcircGrid). The file
/// appears only when it is complete. Returns false if Aborted returned true; throws IOError.
VTKTIPPIO_EXPORT bool writeMesh(const std::string& path, const PointTable& points,
  TrianglesView triangles, const MeshOptions& options = {});

/// Writes points and triangles as an ADCIRC grid. The depth of a node is the column depth, else the
/// negated elevation, else 0. `like` is the path of a grid whose nodes are the first points; its
/// title, node numbers and boundary lists are kept. If it is empty, nodes are numbered from 1 and
/// there are no boundaries. Returns false if `aborted` returned true; throws IOError.
bool writeAdcircGrid(const std::string& path, const PointTable& points, TrianglesView triangles,
  const std::string& like, const std::optional<PathState>& before,
  const std::function<bool()>& aborted);

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

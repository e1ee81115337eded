// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionedMesh_h
#define tippPartitionedMesh_h

#include "Files/IOError.h"
#include "Files/MeshDescription.h"
#include "Files/PendingOutput.h"
#include "Files/RawArray.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace tipp
{

/// Returns the box as the predicates need it: infinite bounds become the largest double, and z is 0
/// if the dimension is 2.
inline Box3 boundedBox(const Box3& given, int dimension)
{
  constexpr double most = std::numeric_limits<double>::max();
  Box3 box;
  for (std::size_t axis = 0; axis < std::size_t(dimension); ++axis)
  {
    box.Min[axis] = std::clamp(given.Min[axis], -most, most);
    box.Max[axis] = std::clamp(given.Max[axis], -most, most);
  }
  return box;
}

/// The maximum number of pieces of a mesh.
constexpr std::int64_t mostPieces = 1 << 24;

/// The index's entry for a piece.
struct PieceSummary
{
  Box3 Box;                ///< the partition
  Box3 Extent;             ///< bounding box of the piece's own points; empty if there are none
  std::int64_t Points = 0; ///< excluding GhostPoints
  std::int64_t Cells = 0;  ///< owned
  std::int64_t BorrowedCells = 0;  ///< stored by reference, or duplicated at the end of the piece
  std::int64_t GhostPoints = 0;    ///< points that only borrowed cells use, at the end of the piece
  std::uint64_t FileBytes = 0;     ///< size of the piece's .vtu
  std::uint64_t TableOffset = 0;   ///< offset in bytes of its table in tables.bin
  std::uint64_t TableBytes = 0;    ///< size in bytes of its table
  std::uint64_t TableChecksum = 0; ///< XXH3, 64 bits
};

/// An attribute as every piece stores it. An array that varies in time is one StoredArray per step.
struct StoredArray
{
  std::string Name;
  bool OfPoints = true; ///< false: of cells
  Scalar Type = Scalar::Float64;
  int Components = 1; ///< components per tuple
  int Step = -1;      ///< the time step; -1: static
};

template <typename Archive>
void serialize(Archive& archive, StoredArray& array)
{
  archive(array.Name, array.OfPoints, array.Type, array.Components, array.Step);
}

/// A partitioned mesh on disk, as its index describes it; Documentation/PartitionedMesh.md
/// specifies the format byte for byte.
///
/// Each cell is owned by one piece, the first whose closed box it meets; the others that it meets
/// borrow it. Each point is owned by the first piece whose box contains it, and is a ghost point in
/// the others.
struct PartitionedMesh
{
  std::string Path;                   ///< the folder
  int CellSize = 3;                   ///< 3: triangles, 4: tetrahedra
  Scalar PointType = Scalar::Float64; ///< type of the coordinates
  bool Duplicated = false;            ///< borrowed cells are copied to the borrowers' pieces
  std::int64_t Points = 0;            ///< distinct points of the whole mesh
  std::int64_t Cells = 0;             ///< distinct cells of the whole mesh
  Box3 Domain;                        ///< the box that the pieces' boxes tile
  std::string Tiling;                 ///< as requested: "grid:4x4", "quadtree:100000"
  std::vector<double> Times;          ///< times of the steps, ascending; empty for a static mesh
  MeshDescription Description;        ///< what the numbers mean; empty if the index does not say
  std::vector<StoredArray> Arrays;    ///< point arrays first
  std::vector<PieceSummary> Pieces;   ///< in the order of piece indices
  std::uint64_t PvtuBytes = 0;        ///< size of mesh.pvtu, once it is written
  std::uint64_t PvtuChecksum = 0;
  std::uint64_t VtkHdfBytes = 0; ///< size of mesh.vtkhdf; 0: an older program made the mesh without
  std::uint64_t VtkHdfChecksum = 0;
  std::uint64_t IndexChecksum = 0; ///< the one that the index names; differs between meshes
  PathState IndexState;            ///< of the index when it was opened; nothing if it was not

  std::string piecePath(std::size_t piece) const;
  std::string tablesPath() const;
  std::string indexPath() const;
  std::string pvtuPath() const;
  std::string vtkHdfPath() const;
};

/// Returns a piece's file name, such as "pieces/000012.vtu".
VTKTIPPIO_EXPORT std::string pieceName(std::size_t piece);

/// Reads the index; `path` is the mesh's folder or the index itself. Checks every count in it and
/// the sizes of all files. If the mesh is replaced meanwhile, opens the new one. Throws IOError
/// naming the file and the reason.
VTKTIPPIO_EXPORT PartitionedMesh openPartitionedMesh(const std::string& path);

/// Whether another mesh, or nothing, is now where this one was opened. False for a mesh that was
/// not opened.
VTKTIPPIO_EXPORT bool wasReplaced(const PartitionedMesh& mesh);

/// Throws IOError: the mesh was replaced while it was read.
[[noreturn]] VTKTIPPIO_EXPORT void failReplaced(const std::string& path);

/// Calls read(), which reads files of the mesh. If that fails because the mesh was replaced
/// meanwhile, the IOError says so instead of calling a file damaged.
template <typename Read>
auto readUnchanged(const PartitionedMesh& mesh, const Read& read)
{
  try
  {
    return read();
  }
  catch (const IOError&)
  {
    if (wasReplaced(mesh))
    {
      failReplaced(mesh.Path);
    }
    throw;
  }
}

/// Returns the text of index.json including its checksum.
std::string indexText(const PartitionedMesh& mesh);

/// Parses such a text; `path` is the index's, for errors. Checks everything that needs no other
/// file and throws IOError. PartitionedMesh::Path is left empty.
VTKTIPPIO_EXPORT PartitionedMesh parseIndex(const std::string& text, const std::string& path);

/// Throws IOError unless mesh.pvtu and mesh.vtkhdf, which openPartitionedMesh() does not read, have
/// their checksums.
VTKTIPPIO_EXPORT void verifyViews(const PartitionedMesh& mesh);

/// Whether the path looks like a partitioned mesh, its index or its mesh.vtkhdf; opening it may
/// still fail.
VTKTIPPIO_EXPORT bool isPartitionedMesh(const std::string& path);

} // namespace tipp

#endif

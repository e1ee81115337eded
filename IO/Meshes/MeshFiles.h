// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshFiles_h
#define tippMeshFiles_h

#include "Files/PendingOutput.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <array>
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

  /// The ids; null if they have the other size.
  const std::int32_t* ids32() const { return this->Ids32; }
  const std::int64_t* ids64() const { return this->Ids64; }

private:
  const std::int32_t* Ids32 = nullptr;
  const std::int64_t* Ids64 = nullptr;
  std::size_t Count = 0;
};

/// For triangles that meet edge to edge and have the same orientation, or tetrahedra that meet
/// facet to facet (Corners = 4): finds for each corner the index of the cell across the opposite
/// edge or facet, or -1. The number of corners of all cells must fit in Index.
///
/// Facets whose second cell has not been found are kept in lists, which are found by a hash of the
/// points and linked in `neighbors` itself.
template <std::size_t Corners = 3, typename Id, typename Index>
void findNeighbors(const Id* corners, std::size_t cells, Index* neighbors)
{
  constexpr Index none = -1;
  // A link to slot h is -2 - h, so it is neither a cell nor -1, the end of a list.
  const auto link = [](Index slot) { return Index(-2 - slot); };
  // Of a triangle: the start and the end of the edge opposite to corner h % 3.
  const auto from = [&](std::size_t h) { return corners[h % 3 == 2 ? h - 2 : h + 1]; };
  const auto to = [&](std::size_t h) { return corners[h % 3 == 0 ? h + 2 : h - 1]; };
  // The points of the opposite edge or facet, ascending.
  const auto facetOf = [&](std::size_t h)
  {
    if constexpr (Corners == 3)
    {
      const auto [low, high] = std::minmax({ from(h), to(h) });
      return std::array<Id, 2>{ low, high };
    }
    else
    {
      const Id* const v = corners + h / 4 * 4;
      const std::size_t i = h % 4;
      std::array<Id, 3> facet = { v[i == 0 ? 1 : 0], v[i <= 1 ? 2 : 1], v[i == 3 ? 2 : 3] };
      std::sort(facet.begin(), facet.end());
      return facet;
    }
  };
  std::size_t lists = 1;
  while (lists < (Corners - 2) * cells)
  {
    lists *= 2;
  }
  std::vector<Index> newest(lists, none);
  for (std::size_t h = 0; h < Corners * cells; ++h)
  {
    const auto facet = facetOf(h);
    const auto isSame = [&](std::size_t other)
    {
      if constexpr (Corners == 3)
      {
        return from(other) == to(h) && to(other) == from(h);
      }
      else
      {
        return facetOf(other) == facet;
      }
    };
    // Nearby points have nearby hashes, and the many facets of one point are spread.
    std::size_t hash = 0;
    for (std::size_t i = facet.size(); i-- > 0;)
    {
      hash = 5 * hash + std::size_t(facet[i]);
    }
    Index& first = newest[hash & (lists - 1)];
    Index* at = &first;
    while (*at != none && !isSame(std::size_t(link(*at))))
    {
      at = &neighbors[std::size_t(link(*at))];
    }
    if (*at == none)
    {
      neighbors[h] = first;
      first = link(Index(h));
      continue;
    }
    const Index other = link(*at);
    *at = neighbors[std::size_t(other)];
    neighbors[h] = other / Index(Corners);
    neighbors[std::size_t(other)] = Index(h / Corners);
  }
  std::transform(
    neighbors, neighbors + Corners * cells, neighbors, [=](Index n) { return std::max(n, none); });
}

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

/// Whether writeMesh() supports the extension.
VTKTIPPIO_EXPORT bool isMeshFile(const std::string& path);

/// Writes triangles by the path's extension: .npy (m x 3 int64 point ids; points are not written),
/// .vtp or .vtu (appended raw binary: all points, the column named z as third coordinate or else 0,
/// the other columns as point data), or .14, .grd (an ADCIRC grid, see writeAdcircGrid). The file
/// appears only when it is complete. Returns false if Aborted returned true; throws IOError.
VTKTIPPIO_EXPORT bool writeMesh(const std::string& path, const PointTable& points,
  TrianglesView triangles, const MeshOptions& options = {});

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

} // namespace tipp

#endif

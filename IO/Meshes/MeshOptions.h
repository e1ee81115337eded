// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshOptions_h
#define tippMeshOptions_h

#include "Adcirc/AdcircBoundaries.h"
#include "Files/PendingOutput.h"
#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

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

/// A view of a mesh's nodes in the caller's memory: the points of a table, and further ones behind
/// them if the table has no columns.
class NodesView
{
public:
  NodesView() = default;
  NodesView(const PointTable& table) // NOLINT(google-explicit-constructor): a table is such a view
    : Table(&table)
    , InTable(table.size())
    , Count(table.size())
  {
  }
  /// `xy`: x and y of `count` points.
  NodesView(const PointTable& table, const double* xy, std::size_t count)
    : NodesView(table)
  {
    this->More = xy;
    this->Count += count;
  }

  std::size_t size() const { return this->Count; }
  Point2 operator[](std::size_t node) const
  {
    const bool isInTable = node < this->InTable;
    const double* const at =
      isInTable ? &this->Table->XY[2 * node] : this->More + 2 * (node - this->InTable);
    return { at[0], at[1] };
  }
  /// The columns of the table.
  const std::vector<PointTable::Column>& columns() const
  {
    static const std::vector<PointTable::Column> none;
    return this->Table ? this->Table->Columns : none;
  }
  std::vector<std::string> names() const
  {
    return this->Table ? this->Table->names() : std::vector<std::string>();
  }

private:
  const PointTable* Table = nullptr;
  const double* More = nullptr;
  std::size_t InTable = 0;
  std::size_t Count = 0;
};

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
  /// The boundaries of a new ADCIRC or SCHISM grid, as node indices. Without AdcircLike only.
  AdcircBoundaries Boundaries;
  /// The region of each triangle: a material in .2dm, a physical group in .msh, an attribute in
  /// .ele, the cell array "Region" in .vtp and .vtu. Empty: no regions.
  std::vector<std::int64_t> Regions;
  /// Edges of the mesh as pairs of point ids, which Triangle's .poly lists. Empty: no such file.
  std::vector<std::array<std::int64_t, 2>> Segments;
  std::vector<Point2> Holes; ///< points in holes, for the same file
  /// The reference system that .nc states, by a text that GDAL understands. Empty: none.
  std::string Crs;
  /// What may be replaced, as for PendingFile.
  std::optional<PathState> Before;
  /// Called once all is written under a temporary name; returning true discards it.
  std::function<bool()> Aborted;
};

} // namespace tipp

#endif

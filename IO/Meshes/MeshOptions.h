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
#include <utility>
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

/// A named column of numbers in the caller's memory, one per node.
struct NodeColumn
{
  std::string Name;
  const double* Values;
};

/// A view of a mesh's nodes in the caller's memory, in one or two parts.
class NodesView
{
public:
  NodesView() = default;
  NodesView(const PointTable& table) // NOLINT(google-explicit-constructor): a table is such a view
    : First(table.XY.data())
    , FirstCount(table.size())
    , Count(table.size())
  {
    for (const PointTable::Column& column : table.Columns)
    {
      this->Columns.push_back({ column.Name, column.Values.data() });
    }
  }
  /// `xy`: x and y of each node, interleaved.
  NodesView(const std::vector<double>& xy) // NOLINT(google-explicit-constructor): as above
    : First(xy.data())
    , FirstCount(xy.size() / 2)
    , Count(xy.size() / 2)
  {
  }
  /// The nodes of `first`, and behind them `count` further ones with x and y at `more`. `columns`
  /// replace those of `first`.
  NodesView(
    const PointTable& first, const double* more, std::size_t count, std::vector<NodeColumn> columns)
    : First(first.XY.data())
    , More(more)
    , FirstCount(first.size())
    , Count(first.size() + count)
    , Columns(std::move(columns))
  {
  }

  std::size_t size() const { return this->Count; }
  Point2 operator[](std::size_t node) const
  {
    const double* const at =
      node < this->FirstCount ? this->First + 2 * node : this->More + 2 * (node - this->FirstCount);
    return { at[0], at[1] };
  }
  const std::vector<NodeColumn>& columns() const { return this->Columns; }
  std::vector<std::string> names() const
  {
    std::vector<std::string> names;
    for (const NodeColumn& column : this->Columns)
    {
      names.push_back(column.Name);
    }
    return names;
  }

private:
  const double* First = nullptr;
  const double* More = nullptr;
  std::size_t FirstCount = 0;
  std::size_t Count = 0;
  std::vector<NodeColumn> Columns;
};

/// A view of the regions of triangles in the caller's memory.
class RegionsView
{
public:
  RegionsView() = default;
  RegionsView(const std::int32_t* regions, std::size_t triangles)
    : Regions(regions)
    , Count(triangles)
  {
  }
  // NOLINTNEXTLINE(google-explicit-constructor): an array is such a view
  RegionsView(const std::vector<std::int32_t>& regions)
    : RegionsView(regions.data(), regions.size())
  {
  }

  bool empty() const { return this->Count == 0; }
  std::size_t size() const { return this->Count; }
  std::int32_t operator[](std::size_t triangle) const { return this->Regions[triangle]; }
  const std::int32_t* data() const { return this->Regions; }
  const std::int32_t* begin() const { return this->Regions; }
  const std::int32_t* end() const { return this->Regions + this->Count; }

private:
  const std::int32_t* Regions = nullptr;
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
  RegionsView Regions;
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

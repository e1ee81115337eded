// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshPart_h
#define tippMeshPart_h

#include "Parallel/CountingSort.h"
#include "Partitioned/PieceFile.h"
#include "Partitioned/ReadPiece.h"
#include "Resample/SimplexMesh.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace tipp
{

/// Triangles or tetrahedra in memory with their arrays: a whole mesh, or a piece with its borrowed
/// cells. Cells and points are local indices. The pointers refer to memory that Keeps owns.
struct MeshPart
{
  struct Array
  {
    StoredArray Description;
    const void* Values = nullptr;
  };

  SimplexMesh Mesh;
  std::int64_t OwnedCells = 0;            ///< these come first, borrowed cells follow
  const std::int64_t* CellIds = nullptr;  ///< global id of each cell; null: its index
  const std::int64_t* PointIds = nullptr; ///< global id of each point; null: its index
  /// Per point: not 0 if another piece owns it. Null if all are owned.
  const std::uint8_t* Ghosts = nullptr;
  /// Per cell: index of its tuple in cell arrays. Null if this is the cell's index.
  const std::int64_t* Rows = nullptr;
  std::vector<Array> Arrays;
  std::shared_ptr<const void> Keeps;

  std::int64_t cellId(std::int64_t cell) const
  {
    return this->CellIds ? this->CellIds[cell] : cell;
  }
  bool isHidden(std::int64_t cell) const { return this->Mesh.Hidden && this->Mesh.Hidden[cell]; }
  /// Whether no other piece owns the point.
  bool owns(std::int64_t point) const { return !this->Ghosts || this->Ghosts[point] == 0; }
  /// The index of the cell's tuple in cell arrays.
  std::int64_t row(std::int64_t cell) const { return this->Rows ? this->Rows[cell] : cell; }
  std::int64_t pointId(std::int64_t point) const
  {
    return this->PointIds ? this->PointIds[point] : point;
  }
};

/// Corner i of a cell, as the index of a point.
inline std::int64_t cornerOf(const SimplexMesh& mesh, std::int64_t cell, int i)
{
  const std::int64_t index = cell * (mesh.Dimension + 1) + i;
  return mesh.Wide ? static_cast<const std::int64_t*>(mesh.Ids)[index]
                   : static_cast<const std::int32_t*>(mesh.Ids)[index];
}

/// The part of a stored piece. The result owns the piece's memory.
MeshPart partOf(Piece piece);

/// Evaluates one array of a part by piecewise linear interpolation. Floating-point point arrays are
/// interpolated in double precision. Integer point arrays have the value of the corner with the
/// largest weight, and cell arrays that of the cell.
class PartValues
{
public:
  /// Uses the array with this description or, if it is null, the z of points. `part` must outlive
  /// this. Throws std::logic_error if the part does not have the array.
  PartValues(const MeshPart& part, const StoredArray* array);

  /// Writes the values at `count` locations in the array's type: the value at at[i] becomes tuple
  /// tuples[i] of `values`, which need not be aligned.
  void sample(
    const CellLocation* at, const std::int64_t* tuples, std::int64_t count, char* values) const;
  /// The value of a component at a point of the part (a local index; a cell's row for cell arrays).
  double atPoint(std::int64_t point, int component) const;
  /// The values at all points, if they are contiguous float64 values with one component; otherwise
  /// null.
  const double* doubles() const
  {
    return this->Description.OfPoints && this->Description.Type == Scalar::Float64 &&
        this->Stride == 1
      ? static_cast<const double*>(this->Values)
      : nullptr;
  }

  const StoredArray& description() const { return this->Description; }

private:
  template <typename Value>
  Value valueAt(const CellLocation& at, int component) const;
  std::int64_t corner(std::int64_t cell, int i) const { return cornerOf(this->Part.Mesh, cell, i); }

  const MeshPart& Part;
  StoredArray Description;
  const void* Values = nullptr;
  std::int64_t Stride = 1;
  std::int64_t First = 0;
};

/// The cells at each point of a part, and a map from global ids to local indices. Hidden cells are
/// left out.
///
/// At a point that the piece owns, these are all cells of the whole mesh: they all meet the piece's
/// box.
class PartTopology
{
public:
  explicit PartTopology(const MeshPart& part);

  /// Local indices of the cells with a given point as a corner, ascending.
  struct Cells
  {
    const std::int32_t* First;
    const std::int32_t* Last;
    const std::int32_t* begin() const { return this->First; }
    const std::int32_t* end() const { return this->Last; }
    bool empty() const { return this->First == this->Last; }
  };
  Cells cellsAt(std::int64_t point) const
  {
    const auto at = std::size_t(point);
    return { this->AtPoints.begin(at), this->AtPoints.end(at) };
  }

  /// Prefetches the cells at points (local indices), which are accessed at random.
  [[gnu::always_inline]] void prefetch(const std::int64_t* points, std::int64_t count) const
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      __builtin_prefetch(this->AtPoints.startAddress(std::size_t(points[i])));
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      __builtin_prefetch(this->AtPoints.begin(std::size_t(points[i])));
    }
    const std::size_t bytes = std::size_t(this->corners()) * (this->Mesh.Wide ? 8 : 4);
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (const std::int32_t cell : this->cellsAt(points[i]))
      {
        __builtin_prefetch(static_cast<const char*>(this->Mesh.Ids) + std::size_t(cell) * bytes);
      }
    }
  }

  /// The local index of a global id, or -1 if the part does not have it.
  std::int64_t findPoint(std::int64_t id) const
  {
    return find(this->PointMap, id, this->Mesh.PointCount);
  }
  std::int64_t findCell(std::int64_t id) const { return find(this->CellMap, id, this->Mesh.Cells); }

  /// Corner i of a cell, as the local index of a point.
  std::int64_t corner(std::int64_t cell, int i) const { return cornerOf(this->Mesh, cell, i); }
  int corners() const { return this->Mesh.Dimension + 1; }

  /// Calls visit(index) for each cell, except `cell`, that has all points of the face opposite to
  /// the cell's corner `face`, in ascending order. Local indices.
  template <typename Visit>
  void visitAcross(std::int64_t cell, int face, const Visit& visit) const
  {
    std::int64_t corners[3];
    int count = 0;
    for (int i = 0; i < this->corners(); ++i)
    {
      if (i != face)
      {
        corners[count++] = this->corner(cell, i);
      }
    }
    for (const std::int32_t other : this->cellsAt(corners[0]))
    {
      if (other != cell && this->hasCorners(other, corners, count))
      {
        visit(other);
      }
    }
  }

  bool hasCorners(std::int64_t cell, const std::int64_t* corners, int count) const
  {
    int found = 0;
    for (int k = 0; k < count; ++k)
    {
      for (int i = 0; i < this->corners(); ++i)
      {
        found += this->corner(cell, i) == corners[k] ? 1 : 0;
      }
    }
    return found >= count;
  }

  static std::uint64_t bytesFor(std::uint64_t points, std::uint64_t cells, int corners)
  {
    return points * (8 + 12) + cells * (4 * std::uint64_t(corners) + 12);
  }

private:
  static std::int64_t find(
    const std::optional<GlobalIdMap>& map, std::int64_t id, std::int64_t count)
  {
    return map ? map->find(id) : id >= 0 && id < count ? id : -1;
  }

  const SimplexMesh Mesh;
  GroupedItems<std::int32_t> AtPoints; ///< cells by point
  std::optional<GlobalIdMap> PointMap; ///< none: global ids are local indices
  std::optional<GlobalIdMap> CellMap;
};

} // namespace tipp

#endif

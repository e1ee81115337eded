// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshPart_h
#define tippMeshPart_h

#include "Locate/CellLocation.h"
#include "Partitioned/ReadPiece.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <memory>
#include <string>
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
  std::int64_t Bytes = 0; ///< size of the memory that Keeps owns
  std::shared_ptr<const void> Keeps;

  std::int64_t cellId(std::int64_t cell) const
  {
    return this->CellIds ? this->CellIds[cell] : cell;
  }
  bool isHidden(std::int64_t cell) const { return this->Mesh.Hidden && this->Mesh.Hidden[cell]; }
  std::int64_t pointId(std::int64_t point) const
  {
    return this->PointIds ? this->PointIds[point] : point;
  }
};

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
  std::int64_t corner(std::int64_t cell, int i) const
  {
    const std::int64_t index = cell * this->Corners + i;
    return this->Part.Mesh.Wide ? static_cast<const std::int64_t*>(this->Part.Mesh.Ids)[index]
                                : static_cast<const std::int32_t*>(this->Part.Mesh.Ids)[index];
  }

  const MeshPart& Part;
  StoredArray Description;
  const void* Values = nullptr;
  std::int64_t Stride = 1;
  std::int64_t First = 0;
  int Corners;
};

} // namespace tipp

#endif

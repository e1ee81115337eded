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

/// Triangles or tetrahedra in memory with their arrays: a whole mesh, or a piece of one with the
/// cells that it borrows.
struct MeshPart
{
  struct Array
  {
    StoredArray Description;
    const void* Values = nullptr;
  };

  SimplexMesh Mesh;
  std::int64_t OwnedCells = 0;            ///< the first ones; the others are borrowed
  const std::int64_t* CellIds = nullptr;  ///< global ids; null: the index
  const std::int64_t* PointIds = nullptr; ///< global ids; null: the index
  /// For each point whether another piece owns it (not 0); null: none.
  const std::uint8_t* Ghosts = nullptr;
  /// For each cell the index of its values in the arrays of cells; null: its own index.
  const std::int64_t* Rows = nullptr;
  std::vector<Array> Arrays;
  std::int64_t Bytes = 0; ///< memory that it keeps
  std::shared_ptr<const void> Keeps;

  std::int64_t cellId(std::int64_t cell) const
  {
    return this->CellIds ? this->CellIds[cell] : cell;
  }
  std::int64_t pointId(std::int64_t point) const
  {
    return this->PointIds ? this->PointIds[point] : point;
  }
};

/// A stored piece, whose memory the result keeps.
MeshPart partOf(Piece piece);

/// What piecewise linear interpolation in one array of a part gives: floating-point numbers of
/// points are interpolated in double precision, whole numbers are taken from the corner of largest
/// weight, numbers of cells from the cell.
class PartValues
{
public:
  /// The array with this description; if it is null the z of points. Throws std::logic_error if the
  /// part does not have it.
  PartValues(const MeshPart& part, const StoredArray* array);

  /// Writes the values at `count` locations, in the array's type: those at at[i] become tuple
  /// tuples[i] of `values`, which need not be aligned.
  void sample(
    const CellLocation* at, const std::int64_t* tuples, std::int64_t count, char* values) const;
  /// The value of a component at a point of the part.
  double atPoint(std::int64_t point, int component) const;
  /// The values at all points, if they are float64 and lie one after the other; else null.
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

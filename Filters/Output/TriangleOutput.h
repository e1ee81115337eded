// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTriangleOutput_h
#define tippTriangleOutput_h

#include "Arrays/Buffer.h"
#include "Constraints/ConstraintSegments.h"
#include "Distributed/ConstraintLines.h"
#include "Distributed/PointExchange.h"
#include "Distributed/TriangleExchange.h"
#include "Ranks/Communicator.h"
#include "Triangulation/Triangulate.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

class vtkCellArray;
class vtkDataArray;
class vtkIdTypeArray;
class vtkPointSet;
class vtkPolyData;
class vtkUnsignedCharArray;

namespace tipp
{

/// Returns cells of `cellSize` point ids each that take over the memory of `ids`. 32-bit ids give
/// 32-bit cells unless the last offset exceeds `largestOffset32`: VTK stores ids and offsets in one
/// type, so they are then copied to 64 bits.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int32_t> ids,
  int cellSize, std::int64_t largestOffset32 = std::numeric_limits<std::int32_t>::max());
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(
  Buffer<std::int64_t> ids, int cellSize);

///@{
/// Returns a named array of tuples that takes over the memory of its values.
vtkSmartPointer<vtkIdTypeArray> takeArray(
  const std::string& name, Buffer<std::int64_t> values, int components);
vtkSmartPointer<vtkUnsignedCharArray> takeArray(
  const std::string& name, Buffer<unsigned char> values, int components);
///@}

/// A dataset's points and point data as rows of bytes, to send with the points: the 3D coordinates,
/// and the arrays that every rank with points has.
class PointRows
{
public:
  /// Chooses the arrays that all ranks have. Collective.
  PointRows(Communicator& ranks, vtkPointSet* input);

  struct Column
  {
    std::string Name;
    int Type = 0;
    int Components = 0;
    std::size_t Size = 0; ///< bytes
  };

  const std::vector<Column>& columns() const { return this->Columns; }
  bool areDoubles() const { return this->Doubles; }

  /// Sets the ids and rows of `points`, which refer to this object and are valid while it exists.
  void describe(RankPointData& points) const;

private:
  std::vector<Column> Columns;
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays; ///< empty on a rank without points
  std::vector<const char*> Values;
  vtkSmartPointer<vtkDataArray> Coordinates;
  std::vector<PointId> GlobalIds;
  bool Doubles = false;
};

/// How a piece marks constraints. A null member: not in this way.
struct PieceMarks
{
  const ConstraintSegments* Flags = nullptr; ///< marks them by the array ConstraintEdges
  const ConstraintLines* Lines = nullptr;    ///< as lines, and the array ConstraintId
};

/// Fills `output` with a rank's triangles: the points that they use with their data, and global ids
/// of points and cells. `ghosts`, if not null, are added with the array vtkGhostType.
void fillPiece(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, const PieceMarks& marks, vtkPolyData* output);

} // namespace tipp

#endif

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

/// Returns cells of `cellSize` point ids each, which take over the memory of `ids`. Cells are
/// 32-bit if the ids are, unless the last offset exceeds `largestOffset32`: VTK stores ids and
/// offsets with the same type, so ids are copied to 64 bits in this case.
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(Buffer<std::int32_t> ids,
  int cellSize, std::int64_t largestOffset32 = std::numeric_limits<std::int32_t>::max());
VTKTIPPFILTERS_EXPORT vtkSmartPointer<vtkCellArray> takeCells(
  Buffer<std::int64_t> ids, int cellSize);

///@{
/// Returns an array with this name and number of components, which takes over the memory of
/// `values`.
vtkSmartPointer<vtkIdTypeArray> takeArray(
  const std::string& name, Buffer<std::int64_t> values, int components);
vtkSmartPointer<vtkUnsignedCharArray> takeArray(
  const std::string& name, Buffer<unsigned char> values, int components);
///@}

/// The points and point data of a data set as rows of bytes, which are sent with the points. A row
/// has three doubles for the coordinates, and the values of the arrays that all ranks with points
/// have.
class PointRows
{
public:
  /// Chooses the arrays that all ranks with points have. `input` may be null. Collective: all ranks
  /// must call it.
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

  /// Sets the ids and rows of `points`. They refer to this object, which must outlive them.
  void describe(RankPointData& points) const;

private:
  std::vector<Column> Columns;
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays; ///< empty on a rank without points
  std::vector<const char*> Values;
  vtkSmartPointer<vtkDataArray> Coordinates;
  std::vector<PointId> GlobalIds;
  bool Doubles = false;
};

/// How a piece marks its constraints; null members are not used.
struct PieceMarks
{
  const ConstraintSegments* Flags = nullptr; ///< by the cell array ConstraintEdges
  const ConstraintLines* Lines = nullptr;    ///< by line cells, with the cell array ConstraintId
};

/// Fills `output` with a rank's triangles: the points that they use, the points' data, and global
/// ids of points and cells. `ghosts` may be null; otherwise their triangles are added, with the
/// array vtkGhostType.
void fillPiece(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, const PieceMarks& marks, vtkPolyData* output);

} // namespace tipp

#endif

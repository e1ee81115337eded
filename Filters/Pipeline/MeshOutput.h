// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshOutput_h
#define tippMeshOutput_h

#include "Arrays/Buffer.h"
#include "Constraints/ConstraintSegments.h"
#include "Distributed/ConstrainRanks.h"
#include "Distributed/DistributedTriangulation.h"
#include "Distributed3D/DistributedTetrahedralization.h"
#include "InMemory/AlphaShape.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <limits>
#include <string>

class vtkCellArray;
class vtkDataSet;
class vtkIdTypeArray;
class vtkPolyData;
class vtkUnsignedCharArray;
class vtkUnstructuredGrid;

namespace tipp
{

class PointRows;

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

/// Adds the cell array NeighborIds, with `corners` values for each cell of the output. `ids` may
/// have values of more cells, which are left out.
void addNeighborIds(Buffer<std::int64_t> ids, int corners, vtkDataSet* output);

/// How the output marks constraints; null members are not used.
struct ConstraintMarks
{
  const ConstraintSegments* Flags = nullptr; ///< by the cell array ConstraintEdges
  const ConstraintLines* Lines = nullptr;    ///< by line cells, with the cell array ConstraintId
};

/// Fills `output` with a rank's triangles: the points that they use, the points' data, and global
/// ids of points and cells. `ghosts` may be null; otherwise their triangles are added, with the
/// array vtkGhostType.
void fillOutput(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, const ConstraintMarks& marks, vtkPolyData* output);

/// The alpha shape that is output in place of all cells.
struct AlphaOptions
{
  double Alpha;
  bool Tetrahedra; ///< whether these are output, like the next ones
  bool Triangles;
  bool Lines;
  bool Vertices;
};

/// Sets the cells of an alpha shape.
void setAlphaCells(AlphaShape<std::int32_t>&& shape, vtkUnstructuredGrid* output);

///@{
/// Fills `output` with a rank's share of the alpha shape of all ranks' cells: each cell is on one
/// rank. Cells and their faces are as those of alphaShape() in memory. Adds the points that the
/// share uses, and global ids of points and cells. `ghosts`: of fetchGhosts(). Collective.
void fillAlphaOutput(Communicator& ranks, const DistributedTriangulation& mine,
  const PointRows& rows, const GhostTriangles& ghosts, const AlphaOptions& options,
  vtkPolyData* output);
void fillAlphaOutput(Communicator& ranks, const DistributedTetrahedralization& mine,
  const PointRows& rows, const GhostTetrahedra& ghosts, const AlphaOptions& options,
  vtkUnstructuredGrid* output);
///@}

/// Fills `output` with a rank's cells: the points that they use, the points' data, and global ids
/// of points and cells. `ghosts` may be null; otherwise their cells are added, with the array
/// vtkGhostType. Throws std::length_error for more than 2^31 - 1 points.
void fillOutput(const DistributedTetrahedralization& mine, int rank, const PointRows& rows,
  const GhostTetrahedra* ghosts, vtkUnstructuredGrid* output);

} // namespace tipp

#endif

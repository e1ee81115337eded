// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceOutput_h
#define tippPieceOutput_h

#include "Constraints/ConstraintSegments.h"
#include "Distributed/PointExchange.h"
#include "Distributed/TriangleExchange.h"
#include "Ranks/Communicator.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkPointSet;
class vtkPolyData;

namespace tipp
{

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
  bool hasGlobalIds() const { return this->GivenIds; }
  bool areDoubles() const { return this->Doubles; }

  /// Sets the ids and rows of `points`, which refer to this object and are valid while it exists.
  void describe(RankPoints& points) const;

private:
  std::vector<Column> Columns;
  std::vector<vtkSmartPointer<vtkDataArray>> Arrays; ///< empty on a rank without points
  std::vector<const char*> Values;
  vtkSmartPointer<vtkDataArray> Coordinates;
  std::vector<PointId> GlobalIds;
  bool GivenIds = false;
  bool Doubles = false;
};

/// Fills `output` with a rank's triangles: the points that they use with their data, and global ids
/// of points and cells. `ghosts`, if not null, are added with the array vtkGhostType; and if
/// `segments` are not, the array ConstraintEdges.
void fillPiece(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, const ConstraintSegments* segments, vtkPolyData* output);

} // namespace tipp

#endif

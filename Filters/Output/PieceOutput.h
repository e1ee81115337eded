// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceOutput_h
#define tippPieceOutput_h

#include "Distributed/GhostTriangles.h"
#include "Output/PointRows.h"

class vtkPolyData;

namespace tipp
{

/// A rank's triangles as a dataset: the points they use with their data, global ids of points and
/// cells; and if there are ghosts (null: none were asked for), the array vtkGhostType.
void fillPiece(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, vtkPolyData* output);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceOutput_h
#define tippPieceOutput_h

#include "Distributed/GhostTriangles.h"
#include "Output/PointRows.h"

class vtkPolyData;

namespace tipp
{

/// Fills `output` with a rank's triangles: the points that they use with their data, and global ids
/// of points and cells. `ghosts`, if not null, are added with the array vtkGhostType.
void fillPiece(const DistributedTriangulation& mine, int rank, const PointRows& rows,
  const GhostTriangles* ghosts, vtkPolyData* output);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTetrahedronOutput_h
#define tippTetrahedronOutput_h

#include "Distributed3D/DistributedTetrahedralization.h"
#include "Output/TriangleOutput.h"
#include "Predicates/Points.h"

#include <vector>

class vtkPoints;
class vtkUnstructuredGrid;

namespace tipp
{

/// Returns the coordinates as doubles: the memory of `points`, or `copy` filled with them. Valid as
/// long as both exist.
const Point3* coordinatesOf(vtkPoints* points, std::vector<Point3>& copy);

/// Fills `output` with a rank's cells: the points that they use, the points' data, and global ids
/// of points and cells. `ghosts` may be null; otherwise their cells are added, with the array
/// vtkGhostType. Throws std::length_error for more than 2^31 - 1 points.
void fillPiece(const DistributedTetrahedralization& mine, int rank, const PointRows& rows,
  const GhostTetrahedra* ghosts, vtkUnstructuredGrid* output);

} // namespace tipp

#endif

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

/// The coordinates as doubles: the points' own memory, or a copy in `copy`.
const Point3* coordinatesOf(vtkPoints* points, std::vector<Point3>& copy);

/// Fills `output` with a rank's tetrahedra: the points that they use with their data, and global
/// ids of points and cells. `ghosts`, if not null, are added with the array vtkGhostType.
void fillPiece(const DistributedTetrahedralization& mine, int rank, const PointRows& rows,
  const GhostTetrahedra* ghosts, vtkUnstructuredGrid* output);

} // namespace tipp

#endif

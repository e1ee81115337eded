// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippClosest_h
#define tippClosest_h

#include "Query/ResidentMesh.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// The nearest locations of a mesh to some points.
struct ClosestLocations
{
  std::vector<std::int64_t>
    Cells;                    ///< global ids; -1: the mesh has no cell, or the point is not finite
  std::vector<Point3> Points; ///< of triangles with z = 0; NaN if there is none
  std::vector<double> Distances; ///< 0 inside; infinite if there is none
};

/// Finds the nearest location of the mesh to each point, of triangles in x and y. A point in the
/// mesh is its own, with the cell of ResidentMesh::answer(). Outside the nearest cell is found
/// exactly, and of several that are as near the one with the lowest id. Cells without an area or
/// volume do not count. The same for any pieces and threads. Throws IOError and WorkAborted.
VTKTIPPIO_EXPORT ClosestLocations closestTo(
  const ResidentMesh& mesh, const Point3* points, std::int64_t count);

/// The nearest locations of the meshes of all ranks, as in answerOnRanks(), to this rank's points.
/// Each rank has points of its own, or none. Collective; call it within Communicator::together().
/// Throws IOError.
VTKTIPPIO_EXPORT ClosestLocations closestOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const Point3* points, std::int64_t count);

} // namespace tipp

#endif

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

/// The location in a mesh that is nearest to each point.
struct ClosestLocations
{
  std::vector<std::int64_t>
    Cells;                    ///< global ids; -1 if the mesh has no cell or the point is not finite
  std::vector<Point3> Points; ///< z is 0 for triangles; NaN if there is none
  std::vector<double> Distances; ///< 0 for points in the mesh; infinite if there is none
};

/// Finds the location in the mesh that is nearest to each point. Triangles are searched in x and y.
/// A point in the mesh is its own nearest location, in the cell of ResidentMesh::answer(). For
/// other points, the nearest cell is determined exactly; of equally near cells, the one with the
/// lowest id. Cells without area or volume are ignored. Results do not depend on pieces and
/// threads. Throws IOError and WorkAborted.
///
/// `ranks` are the ranks that share the mesh, as for answerOnRanks(); null: this process alone.
/// Each rank has its own points, or none. With ranks, the function is collective; call it within
/// Communicator::together().
VTKTIPPIO_EXPORT ClosestLocations closestTo(const ResidentMesh& mesh, const Point3* points,
  std::int64_t count, Communicator* ranks = nullptr);

} // namespace tipp

#endif

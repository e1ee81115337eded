// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAround_h
#define tippAround_h

#include "Query/ResidentMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Lists of ids, one after the other: list i is Ids[Starts[i]] ... Ids[Starts[i + 1] - 1].
struct IdLists
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<std::int64_t> Ids;
};

// What lies around cells and points of a mesh. All ids are global; those of a stored mesh are found
// by the id arrays of its pieces, each read at most once a call. The answers are the same for any
// pieces and threads. Every function throws IOError, also for an id that the mesh does not have,
// and WorkAborted. `pieces` may be mesh.piecesOfIds() of the ids, which then are not looked up
// again.

/// For each cell and each of its corners the cell across the face opposite to that corner: of
/// several the lowest id; -1: none.
VTKTIPPIO_EXPORT std::vector<std::int64_t> neighborsOf(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& cells, const std::vector<std::int32_t>& pieces = {});

/// The cells that a piece owns, and their neighbours.
struct OwnedNeighbors
{
  std::vector<std::int64_t> Cells;     ///< global ids
  std::vector<std::int64_t> Neighbors; ///< as of neighborsOf()
};

/// Computed from the cells, even if the mesh has neighbour ids.
OwnedNeighbors neighborsInPiece(const ResidentMesh& mesh, std::size_t piece);

/// The cells at each point, ascending.
VTKTIPPIO_EXPORT IdLists starsOf(const ResidentMesh& mesh, const std::vector<std::int64_t>& points,
  const std::vector<std::int32_t>& pieces = {});

/// The points that 1 to k edges lead to from each point, ascending.
VTKTIPPIO_EXPORT IdLists ringsOfPoints(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& points, int k, const std::vector<std::int32_t>& pieces = {});

/// The cells that each cell reaches in 1 to k steps, each to a cell that shares a point, ascending.
VTKTIPPIO_EXPORT IdLists ringsOfCells(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& cells, int k, const std::vector<std::int32_t>& pieces = {});

/// As ringsOfPoints() or ringsOfCells(), of ids of a part of a mesh in memory; shared[i] is not 0
/// if cells beyond the part have its point i. The list of an id whose steps would go on from such a
/// point is -1 alone.
IdLists ringsWithin(const ResidentMesh& part, const std::vector<std::int64_t>& seeds, bool ofPoints,
  int k, const std::uint8_t* shared);

/// The border of a mesh of triangles as closed lines.
struct BoundaryLoops
{
  IdLists Points;                ///< of each loop, from its lowest edge of point ids on
  std::vector<Point3> Positions; ///< of Points.Ids
};

/// The edges with one triangle, with the mesh on the left: outer borders counter-clockwise, those
/// of holes clockwise. Where borders touch at a point, each follows its own triangles. Loops are in
/// the order of their lowest edges.
VTKTIPPIO_EXPORT BoundaryLoops boundaryOf(const ResidentMesh& mesh);

/// The connected parts of a mesh: cells are connected by common faces.
struct Components
{
  std::vector<std::int64_t> OfCells; ///< the component of each cell id; -1: a hidden cell
  std::vector<std::int64_t> Sizes;   ///< cells of each component; they ascend by their lowest cell
};

/// Takes 8 bytes for each cell of the mesh.
VTKTIPPIO_EXPORT Components componentsOf(const ResidentMesh& mesh);

} // namespace tipp

#endif

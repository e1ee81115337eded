// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAround_h
#define tippAround_h

#include "Query/ResidentMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Lists of global ids in one array: list i is Ids[Starts[i]] ... Ids[Starts[i + 1] - 1].
struct IdLists
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<std::int64_t> Ids;
};

// Topological queries. All ids are global ids. In a stored mesh, the id arrays of pieces are
// searched for them, and each is read at most once per call. Callers that know the result of
// mesh.piecesOfIds() for the ids pass it as `pieces`, and then no ids are searched. Results do not
// depend on pieces and threads. Every function throws IOError, for example for an id that the mesh
// does not have, and WorkAborted.

/// The neighbour ids of cells: for each cell, and each of its corners, the cell across the face
/// opposite to this corner. -1 if there is none; the lowest id if there are several.
VTKTIPPIO_EXPORT std::vector<std::int64_t> neighborsOf(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& cells, const std::vector<std::int32_t>& pieces = {});

/// The cells that a piece owns, and their neighbours.
struct OwnedNeighbors
{
  std::vector<std::int64_t> Cells;     ///< global ids
  std::vector<std::int64_t> Neighbors; ///< as from neighborsOf()
};

/// The neighbours of all cells of a piece, computed from the cells even if the mesh stores
/// neighbour ids.
OwnedNeighbors neighborsInPiece(const ResidentMesh& mesh, std::size_t piece);

/// For each point, the cells that have it as a corner, in ascending order.
VTKTIPPIO_EXPORT IdLists starsOf(const ResidentMesh& mesh, const std::vector<std::int64_t>& points,
  const std::vector<std::int32_t>& pieces = {});

/// For each point, the points that can be reached over 1 to k edges, in ascending order and without
/// the point itself.
VTKTIPPIO_EXPORT IdLists ringsOfPoints(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& points, int k, const std::vector<std::int32_t>& pieces = {});

/// For each cell, the cells that can be reached in 1 to k steps, where a step leads to a cell with
/// a common point. In ascending order and without the cell itself.
VTKTIPPIO_EXPORT IdLists ringsOfCells(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& cells, int k, const std::vector<std::int32_t>& pieces = {});

/// As ringsOfPoints() or ringsOfCells(), for a part of a mesh in memory: the rings as far as they
/// can be computed without the other parts. `indices` are the local indices of the seeds, at least
/// one. shared[i] is not 0 if other parts, too, have cells at point i (a local index). If a ring
/// needs the cells of other parts, its list is only { -1 }.
IdLists ringsWithin(const ResidentMesh& part, const std::vector<std::int64_t>& seeds,
  const std::vector<std::int64_t>& indices, bool ofPoints, int k, const std::uint8_t* shared);

/// The border of a mesh of triangles as closed lines.
struct BoundaryLoops
{
  IdLists Points;                ///< point ids of each loop, starting with its lowest edge
  std::vector<Point3> Positions; ///< position of each of Points.Ids
};

/// The border of a mesh: the edges that only one triangle has. The mesh is on the left of each
/// loop, so outer borders are counter-clockwise, and borders of holes are clockwise. If borders
/// touch at a point, they stay separate loops. Loops are sorted by their lowest edges.
VTKTIPPIO_EXPORT BoundaryLoops boundaryOf(const ResidentMesh& mesh);

/// The connected components of a mesh. Cells are connected by common faces.
struct Components
{
  std::vector<std::int64_t> OfCells; ///< component of each cell, by global id; -1: a hidden cell
  std::vector<std::int64_t> Sizes;   ///< cells of each component; sorted by their lowest cells
};

/// Computes the components. Needs 8 bytes of memory per cell of the mesh.
VTKTIPPIO_EXPORT Components componentsOf(const ResidentMesh& mesh);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAround_h
#define tippAround_h

#include "Query/ResidentMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

class Communicator;

/// Lists of global ids in one array: list i is Ids[Starts[i]] ... Ids[Starts[i + 1] - 1].
struct IdLists
{
  std::vector<std::int64_t> Starts = { 0 };
  std::vector<std::int64_t> Ids;

  /// Appends list i of `from` to the last list, which endList() ends.
  void append(const IdLists& from, std::size_t i)
  {
    this->Ids.insert(
      this->Ids.end(), from.Ids.begin() + from.Starts[i], from.Ids.begin() + from.Starts[i + 1]);
  }
  void endList() { this->Starts.push_back(std::int64_t(this->Ids.size())); }
  void add(const std::vector<std::int64_t>& list)
  {
    this->Ids.insert(this->Ids.end(), list.begin(), list.end());
    this->endList();
  }
};

template <typename Archive>
void serialize(Archive& archive, IdLists& lists)
{
  archive(lists.Starts, lists.Ids);
}

// Topological queries. All ids are global ids. In a stored mesh, the id arrays of pieces are
// searched for them, and each is read at most once per call. Results do not depend on pieces and
// threads. Every function throws IOError, for example for an id that the mesh does not have, and
// WorkAborted.
//
// `ranks` are the ranks that share the mesh, as for answerOnRanks(); null: this process alone. With
// ranks, each passes its own ids, possibly none, and gets their results, which equal those of the
// whole mesh in one process. Parts in memory need global ids of points and cells; only hidden cells
// may occur in several parts, and a face may have at most two cells. A rank may have no cells. The
// functions are then collective; call them within Communicator::together().

/// The neighbour ids of cells: for each cell, and each of its corners, the cell across the face
/// opposite to this corner. -1 if there is none; the lowest id if there are several.
VTKTIPPIO_EXPORT std::vector<std::int64_t> neighborsOf(
  const ResidentMesh& mesh, const std::vector<std::int64_t>& cells, Communicator* ranks = nullptr);

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
VTKTIPPIO_EXPORT IdLists starsOf(
  const ResidentMesh& mesh, const std::vector<std::int64_t>& points, Communicator* ranks = nullptr);

/// For each point, the points that can be reached over 1 to k edges, in ascending order and without
/// the point itself.
VTKTIPPIO_EXPORT IdLists ringsOfPoints(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& points, int k, Communicator* ranks = nullptr);

/// For each cell, the cells that can be reached in 1 to k steps, where a step leads to a cell with
/// a common point. In ascending order and without the cell itself.
VTKTIPPIO_EXPORT IdLists ringsOfCells(const ResidentMesh& mesh,
  const std::vector<std::int64_t>& cells, int k, Communicator* ranks = nullptr);

/// The border of a mesh of triangles as closed lines.
struct BoundaryLoops
{
  IdLists Points;                ///< point ids of each loop, starting with its lowest edge
  std::vector<Point3> Positions; ///< position of each of Points.Ids
};

/// The border of a mesh: the edges that only one triangle has. The mesh is on the left of each
/// loop, so outer borders are counter-clockwise, and borders of holes are clockwise. If borders
/// touch at a point, they stay separate loops. Loops are sorted by their lowest edges. With ranks,
/// the first one gets the whole border, and others get none.
VTKTIPPIO_EXPORT BoundaryLoops boundaryOf(const ResidentMesh& mesh, Communicator* ranks = nullptr);

/// The connected components of a mesh. Cells are connected by common faces.
struct Components
{
  std::vector<std::int64_t> OfCells; ///< component of each cell, by global id; -1: a hidden cell
  std::vector<std::int64_t> Sizes;   ///< cells of each component; sorted by their lowest cells
  /// Only with ranks: the ids of this rank's cells, ascending, whose components OfCells has.
  std::vector<std::int64_t> Cells;
};

/// Computes the components. Needs 8 bytes of memory per cell of the mesh. With ranks, each gets the
/// components of its own cells, and all get the sizes.
VTKTIPPIO_EXPORT Components componentsOf(const ResidentMesh& mesh, Communicator* ranks = nullptr);

} // namespace tipp

#endif

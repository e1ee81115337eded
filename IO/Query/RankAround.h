// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankAround_h
#define tippRankAround_h

#include "Query/Around.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <vector>

namespace tipp
{

// Topological queries for meshes of several ranks, as in Around.h. As for answerOnRanks(), all
// ranks have opened the same stored mesh, or each has a part in memory. Parts in memory need global
// ids of points and cells; only hidden cells may occur in several parts, and a face may have at
// most two cells. Each rank passes its own ids, possibly none, and gets their results, which equal
// those of the whole mesh in one process. A rank may have no cells. All functions are collective;
// call them within Communicator::together(). They throw IOError.

VTKTIPPIO_EXPORT std::vector<std::int64_t> neighborsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& cells);
VTKTIPPIO_EXPORT IdLists starsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& points);
VTKTIPPIO_EXPORT IdLists ringsOfPointsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& points, int k);
VTKTIPPIO_EXPORT IdLists ringsOfCellsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& cells, int k);

/// The whole border on the first rank. Other ranks get none.
VTKTIPPIO_EXPORT BoundaryLoops boundaryOnRanks(Communicator& ranks, const ResidentMesh& mesh);

/// The connected components of a mesh, with the labels of a rank's cells.
struct RankComponents
{
  std::vector<std::int64_t> Cells;   ///< global ids of this rank's cells, ascending
  std::vector<std::int64_t> OfCells; ///< component of each of these cells
  std::vector<std::int64_t> Sizes;   ///< cells per component of the whole mesh, on every rank
};

/// As componentsOf(), but labels stay on the ranks with the cells.
VTKTIPPIO_EXPORT RankComponents componentsOnRanks(Communicator& ranks, const ResidentMesh& mesh);

/// Throws IOError if several ranks have cells and this rank's part lacks global ids. Collective.
void requireIdsOnRanks(Communicator& ranks, const ResidentMesh& mesh);

} // namespace tipp

#endif

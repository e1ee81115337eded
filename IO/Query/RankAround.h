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

// What lies around cells and points of a mesh that several ranks have, as in answerOnRanks(): all
// have opened the same stored mesh, or each has a part in memory. Parts in memory need global ids
// of points and cells, no cell twice but where it is hidden, and at most two cells at a face. Each
// rank asks for ids of its own and gets their answers, which are those of the whole mesh in one
// process. Any rank may ask for nothing, or have no cells. All functions are collective; call them
// within Communicator::together(). They throw IOError.

VTKTIPPIO_EXPORT std::vector<std::int64_t> neighborsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& cells);
VTKTIPPIO_EXPORT IdLists starsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& points);
VTKTIPPIO_EXPORT IdLists ringsOfPointsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& points, int k);
VTKTIPPIO_EXPORT IdLists ringsOfCellsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& cells, int k);

/// The whole border on the first rank; the others get none.
VTKTIPPIO_EXPORT BoundaryLoops boundaryOnRanks(Communicator& ranks, const ResidentMesh& mesh);

/// The connected parts of a mesh, with the labels of the cells that a rank has.
struct RankComponents
{
  std::vector<std::int64_t> Cells;   ///< ids of this rank's cells, ascending
  std::vector<std::int64_t> OfCells; ///< the component of each
  std::vector<std::int64_t> Sizes;   ///< of all components, on every rank
};

/// As componentsOf(), with results that stay on the ranks.
VTKTIPPIO_EXPORT RankComponents componentsOnRanks(Communicator& ranks, const ResidentMesh& mesh);

/// Throws IOError unless the rank's part, if several have cells, has global ids. Collective.
void requireIdsOnRanks(Communicator& ranks, const ResidentMesh& mesh);

} // namespace tipp

#endif

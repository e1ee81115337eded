// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankAnswer_h
#define tippRankAnswer_h

#include "Query/ResidentMesh.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// The pieces [first, end) of a stored mesh that a rank has; of a part in memory its one piece.
std::pair<std::size_t, std::size_t> piecesOfRank(
  const Communicator& ranks, const ResidentMesh& mesh);
/// The rank that has a piece of a stored mesh.
std::size_t rankOfPiece(const Communicator& ranks, const ResidentMesh& mesh, std::int64_t piece);

/// Answers this rank's points with the meshes of all ranks: either all have opened the same stored
/// mesh, whose pieces they share out, so that each is in the memory of one rank; or each has a part
/// in memory, which may be empty. A point goes to the ranks that may have its cell, and the answer
/// comes back. Cells without global ids are numbered rank by rank. Any rank may have no points. All
/// ranks give the same options.
///
/// Collective; call it within Communicator::together(). Throws IOError.
VTKTIPPIO_EXPORT MeshAnswer answerOnRanks(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options = {});

/// Answers on the ranks that have the cells.
struct StayingAnswer
{
  std::vector<std::int64_t> Ranks;   ///< the rank that asked for each point
  std::vector<std::int64_t> Indices; ///< of the point among those that it asked for
  std::vector<Point3> Points;
  MeshAnswer Answer;
};

/// As answerOnRanks(), but answers stay on the rank that has the cell: each rank gets the points of
/// all ranks that lie in its cells, in the order of ranks and indices. Points outside of the mesh
/// are on no rank.
VTKTIPPIO_EXPORT StayingAnswer answerWhereCellsAre(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options = {});

} // namespace tipp

#endif

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

/// The pieces [first, end) of a stored mesh that a rank has. A part in memory is one piece.
std::pair<std::size_t, std::size_t> piecesOfRank(
  const Communicator& ranks, const ResidentMesh& mesh);
/// The rank that has a piece of a stored mesh.
std::size_t rankOfPiece(const Communicator& ranks, const ResidentMesh& mesh, std::int64_t piece);

/// Answers this rank's points with the meshes of all ranks. Either all ranks have opened the same
/// stored mesh: then its pieces are distributed over the ranks, and each is in the memory of one
/// rank. Or each rank has a part in memory, which may be empty. Points are sent to the ranks that
/// may have their cells, and answers are sent back. Cells without global ids are numbered
/// consecutively over the ranks. A rank may have no points. All ranks pass the same options.
///
/// Collective; call it within Communicator::together(). Throws IOError.
VTKTIPPIO_EXPORT MeshAnswer answerOnRanks(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options = {});

/// Answers that stay on the ranks with the cells.
struct StayingAnswer
{
  std::vector<std::int64_t> Ranks;   ///< rank that sent each point
  std::vector<std::int64_t> Indices; ///< index of each point among that rank's points
  std::vector<Point3> Points;
  MeshAnswer Answer;
};

/// As answerOnRanks(), but answers stay on the ranks with the cells: each rank gets the points of
/// all ranks that are in its cells, sorted by rank and index. Points outside the mesh are on no
/// rank.
VTKTIPPIO_EXPORT StayingAnswer answerWhereCellsAre(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options = {});

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankAnswer_h
#define tippRankAnswer_h

#include "Query/ResidentMesh.h"
#include "Ranks/Communicator.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <utility>

namespace tipp
{

/// The pieces [first, end) of a stored mesh that a rank has; of a part in memory its one piece.
std::pair<std::size_t, std::size_t> piecesOfRank(
  const Communicator& ranks, const ResidentMesh& mesh);

/// Answers this rank's points with the meshes of all ranks: either all have opened the same stored
/// mesh, whose pieces they share out, so that each is in the memory of one rank; or each has a part
/// in memory, which may be empty. A point goes to the ranks that may have its cell, and the answer
/// comes back. Cells without global ids are numbered rank by rank. Any rank may have no points. All
/// ranks give the same options.
///
/// Collective; call it within Communicator::together(). Throws IOError.
VTKTIPPIO_EXPORT MeshAnswer answerOnRanks(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options = {});

} // namespace tipp

#endif

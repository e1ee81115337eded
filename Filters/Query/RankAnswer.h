// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankAnswer_h
#define tippRankAnswer_h

#include "Arrays/Concatenated.h"
#include "Ranks/Communicator.h"
#include "Resident/ResidentMesh.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// Whether several ranks share a mesh.
inline bool areSeveral(const Communicator* ranks)
{
  return ranks && ranks->size() > 1;
}

/// Whether to query the mesh of this process: a rank that has no cells does not even know the
/// arrays.
inline bool canQuery(const Communicator* ranks, const ResidentMesh& mesh)
{
  return mesh.mesh().Cells > 0 || !ranks;
}

/// The pieces [first, end) of a mesh that this rank queries. A mesh in memory is one piece.
std::pair<std::size_t, std::size_t> piecesOfRank(
  const Communicator* ranks, const ResidentMesh& mesh);
/// The rank that has a piece of a stored mesh.
std::size_t rankOfPiece(const Communicator& ranks, const ResidentMesh& mesh, std::int64_t piece);

/// Throws IOError on all ranks if several have cells and the part of any lacks global ids.
/// Collective if there are several ranks.
void requireIds(Communicator* ranks, const ResidentMesh& mesh);

/// The items of all ranks on the first rank, none on the others.
template <typename T>
std::vector<T> gathered(Communicator* ranks, std::vector<T> own)
{
  return areSeveral(ranks) ? concatenated(ranks->gather(own)) : std::move(own);
}

/// Sends questions[i] to the rank rankOf[i], and returns the answers in the order of the questions.
/// answer(received) returns one answer for each question of one rank. Collective.
template <typename Question, typename Answer>
auto askRanks(Communicator& ranks, const std::vector<std::size_t>& rankOf,
  std::vector<Question> questions, const Answer& answer)
{
  std::vector<std::vector<Question>> sent(std::size_t(ranks.size()));
  for (std::size_t i = 0; i < rankOf.size(); ++i)
  {
    sent[rankOf[i]].push_back(std::move(questions[i]));
  }
  std::vector<Question>().swap(questions); // frees it before the exchange
  std::vector<decltype(answer(sent[0]))> replies;
  for (const std::vector<Question>& received : ranks.allToAll(sent))
  {
    replies.push_back(answer(received));
  }
  replies = ranks.allToAll(replies);
  decltype(answer(sent[0])) result;
  result.reserve(rankOf.size());
  std::vector<std::size_t> next(replies.size(), 0);
  for (const std::size_t rank : rankOf)
  {
    result.push_back(std::move(replies[rank].at(next[rank]++)));
  }
  return result;
}

/// A description of one rank's part of a mesh, for the other ranks.
struct RankPart
{
  int CellSize = 0; ///< 0 if it has no cells
  std::int64_t Cells = 0;
  Box3 Domain;
  std::vector<StoredArray> Arrays; ///< the requested arrays; these may include the elevation
};

template <typename Archive>
void serialize(Archive& archive, RankPart& part)
{
  archive(part.CellSize, part.Cells, part.Domain, part.Arrays);
}

/// The parts of all ranks, and what those with cells have in common. Collective if there are
/// several ranks. Throws IOError if parts differ in their kind of cells or arrays.
struct RankParts
{
  RankParts(Communicator* ranks, const ResidentMesh& mesh, const std::vector<std::string>& arrays);

  /// Added to this rank's cell ids: cells without global ids are numbered over the ranks.
  std::int64_t firstCell(const Communicator& ranks, const ResidentMesh& mesh) const;

  std::vector<RankPart> All; ///< by rank
  RankPart Common;
};

/// Answers this rank's points with the meshes of all ranks. Either all ranks have opened the same
/// stored mesh: then its pieces are distributed over the ranks, and each is in the memory of one
/// rank. Or each rank has a part in memory, which may be empty. Points are sent to the ranks that
/// may have their cells, and answers are sent back. Cells without global ids are numbered
/// consecutively over the ranks. A rank may have no points. All ranks pass the same options.
///
/// Collective; call it within Communicator::together(). Throws IOError.
VTKTIPPFILTERS_EXPORT MeshAnswer answerOnRanks(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options = {});

/// Answers points with the meshes of all ranks or, if `ranks` is null, with the mesh alone.
inline MeshAnswer answerOf(const ResidentMesh& mesh, const Point3* points, std::int64_t count,
  const AnswerOptions& options, Communicator* ranks)
{
  return ranks ? answerOnRanks(*ranks, mesh, points, count, options)
               : mesh.answer(points, count, options);
}

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
VTKTIPPFILTERS_EXPORT StayingAnswer answerWhereCellsAre(Communicator& ranks,
  const ResidentMesh& mesh, const Point3* points, std::int64_t count,
  const AnswerOptions& options = {});

} // namespace tipp

#endif

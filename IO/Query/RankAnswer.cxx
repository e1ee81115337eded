// SPDX-License-Identifier: BSD-3-Clause
#include "Query/RankAnswer.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// What the ranks know of each other's part of the mesh.
struct RankPart
{
  int CellSize = 0; ///< 0: it has no cells
  bool HasIds = false;
  std::int64_t Cells = 0;
  Bounds Domain{};
  std::vector<Scalar> Types; ///< of the arrays asked for
  std::vector<int> Components;
};

template <typename Archive>
void serialize(Archive& archive, RankPart& part)
{
  archive(part.CellSize, part.HasIds, part.Cells, part.Domain, part.Types, part.Components);
}

/// Answers on their way back, without the names.
struct Reply
{
  std::vector<std::int64_t> Cells;
  std::vector<double> Weights;
  std::vector<CellKey> Keys;
  std::vector<std::vector<char>> Arrays;
};

template <typename Archive>
void serialize(Archive& archive, Reply& reply)
{
  archive(reply.Cells, reply.Weights, reply.Keys, reply.Arrays);
}

RankPart describe(const ResidentMesh& mesh, const AnswerOptions& options)
{
  RankPart part;
  part.Cells = mesh.mesh().Cells;
  part.HasIds = mesh.hasCellIds();
  part.Domain = mesh.mesh().Domain;
  if (part.Cells > 0)
  {
    part.CellSize = mesh.mesh().CellSize;
    for (const std::string& name : options.Arrays)
    {
      const StoredArray* const array = mesh.find(name);
      part.Types.push_back(array ? array->Type : mesh.mesh().PointType);
      part.Components.push_back(array ? array->Components : 1);
    }
  }
  return part;
}

/// The first part with cells; the others must be like it.
RankPart commonPart(const std::vector<RankPart>& parts)
{
  RankPart common;
  for (const RankPart& part : parts)
  {
    if (part.CellSize == 0)
    {
      continue;
    }
    const auto kind = [](const RankPart& p) { return std::tie(p.CellSize, p.Types, p.Components); };
    if (common.CellSize != 0 && kind(common) != kind(part))
    {
      throw IOError("The ranks' parts of the mesh differ in their type of cells or arrays.");
    }
    common = common.CellSize != 0 ? common : part;
  }
  return common;
}

bool holds(const RankPart& part, const Point3& p)
{
  const Bounds& b = part.Domain;
  return part.CellSize != 0 && b[0] <= p.x && p.x <= b[1] && b[2] <= p.y && p.y <= b[3] &&
    (part.CellSize == 3 || (b[4] <= p.z && p.z <= b[5]));
}

/// For each rank the indices of the points that it is asked.
std::vector<std::vector<std::int64_t>> shareOut(const Communicator& communicator,
  const ResidentMesh& mesh, const std::vector<RankPart>& parts, const Point3* points,
  std::int64_t count)
{
  std::vector<std::vector<std::int64_t>> asked(parts.size());
  const std::vector<std::int32_t> pieceOf =
    mesh.isStored() ? mesh.piecesOf(points, count) : std::vector<std::int32_t>();
  for (std::int64_t i = 0; i < count; ++i)
  {
    if (mesh.isStored())
    {
      const std::int64_t piece = pieceOf[std::size_t(i)];
      piece >= 0 ? asked[rankOfPiece(communicator, mesh, piece)].push_back(i) : void();
      continue;
    }
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
    {
      holds(parts[rank], points[i]) ? asked[rank].push_back(i) : void();
    }
  }
  return asked;
}

/// Part [begin, end) of an answer.
Reply cutOut(const MeshAnswer& answer, std::size_t begin, std::size_t end, std::size_t corners)
{
  const auto cut = [&](const auto& values, std::size_t width)
  {
    return values.empty()
      ? values
      : std::decay_t<decltype(values)>(values.data() + begin * width, values.data() + end * width);
  };
  Reply reply{ cut(answer.Cells, 1), cut(answer.Weights, corners), cut(answer.Keys, 1), {} };
  for (const MeshAnswer::Array& array : answer.Arrays)
  {
    const std::size_t bytes = array.tupleBytes();
    reply.Arrays.emplace_back(
      array.Values.data() + begin * bytes, array.Values.data() + end * bytes);
  }
  return reply;
}

/// Without keys one rank alone is asked.
CellKey keyOf(const Reply& reply, std::size_t i)
{
  return reply.Keys.empty() ? noCellKey : reply.Keys[i];
}

/// Takes what a rank says of the points with the indices `asked`, where it is the best so far.
void merge(const Reply& reply, const std::vector<std::int64_t>& asked, std::size_t corners,
  MeshAnswer& answer)
{
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    const auto at = std::size_t(asked[i]);
    const CellKey key = keyOf(reply, i);
    if (reply.Cells[i] < 0 ||
      (answer.Cells[at] >= 0 &&
        std::tie(answer.Keys[at], answer.Cells[at]) <= std::tie(key, reply.Cells[i])))
    {
      continue;
    }
    answer.Cells[at] = reply.Cells[i];
    answer.Keys[at] = key;
    if (!reply.Weights.empty())
    {
      std::copy_n(
        reply.Weights.data() + i * corners, corners, answer.Weights.data() + at * corners);
    }
    for (std::size_t a = 0; a < reply.Arrays.size(); ++a)
    {
      const std::size_t bytes = answer.Arrays[a].tupleBytes();
      std::memcpy(
        answer.Arrays[a].Values.data() + at * bytes, reply.Arrays[a].data() + i * bytes, bytes);
    }
  }
}

/// The points of all ranks, sent to the ranks that may have their cells, and what these find.
class PointsOnRanks
{
public:
  PointsOnRanks(Communicator& ranks, const ResidentMesh& mesh, const Point3* points,
    std::int64_t count, const AnswerOptions& options)
    : Options(options)
  {
    const std::vector<RankPart> parts = ranks.allGather(describe(mesh, options));
    this->Common = commonPart(parts);
    for (int rank = 0; rank < ranks.rank() && !mesh.isStored(); ++rank)
    {
      this->FirstCell += parts[std::size_t(rank)].Cells;
    }
    this->FirstCell = mesh.hasCellIds() ? 0 : this->FirstCell;
    this->Asked = shareOut(ranks, mesh, parts, points, count);
    std::vector<std::vector<Point3>> questions(this->Asked.size());
    for (std::size_t rank = 0; rank < this->Asked.size(); ++rank)
    {
      for (const std::int64_t i : this->Asked[rank])
      {
        questions[rank].push_back(points[i]);
      }
    }
    this->Begins = { 0 };
    for (const std::vector<Point3>& part : ranks.allToAll(questions))
    {
      this->Received.insert(this->Received.end(), part.begin(), part.end());
      this->Begins.push_back(this->Received.size());
    }
    AnswerOptions wanted = options;
    // Of a stored mesh one rank alone is asked for a point.
    wanted.Keys = options.Keys || !mesh.isStored();
    this->Found = this->Received.empty()
      ? this->emptyAnswer(0)
      : mesh.answer(this->Received.data(), std::int64_t(this->Received.size()), wanted);
    for (std::int64_t& cell : this->Found.Cells)
    {
      cell += cell >= 0 ? this->FirstCell : 0;
    }
  }

  /// For each rank the indices of this rank's points that it has been asked for.
  const std::vector<std::vector<std::int64_t>>& asked() const { return this->Asked; }
  const std::vector<Point3>& received() const { return this->Received; }
  const MeshAnswer& found() const { return this->Found; }
  /// The first point of a rank among the received ones.
  std::size_t begin(std::size_t rank) const { return this->Begins[rank]; }
  std::size_t corners() const { return std::size_t(this->Common.CellSize); }

  MeshAnswer emptyAnswer(std::int64_t count) const
  {
    std::vector<StoredArray> arrays(this->Common.Types.size());
    for (std::size_t a = 0; a < arrays.size(); ++a)
    {
      arrays[a].Name = this->Options.Arrays[a];
      arrays[a].Type = this->Common.Types[a];
      arrays[a].Components = this->Common.Components[a];
    }
    return tipp::emptyAnswer(count, arrays, this->Common.CellSize, this->Options.Weights, true);
  }

private:
  const AnswerOptions& Options;
  RankPart Common;
  std::int64_t FirstCell = 0;
  std::vector<std::vector<std::int64_t>> Asked;
  std::vector<Point3> Received;
  std::vector<std::size_t> Begins;
  MeshAnswer Found;
};

/// The ranks that answer this rank's points, for each rank whether it does.
std::vector<std::vector<char>> chooseRanks(const std::vector<std::vector<std::int64_t>>& asked,
  const std::vector<Reply>& replies, std::int64_t count)
{
  struct Best
  {
    CellKey Key;
    std::int64_t Cell = -1;
    std::size_t Rank = 0;
  };
  std::vector<Best> best(static_cast<std::size_t>(count));
  const auto forReplies = [&](const auto& work)
  {
    for (std::size_t rank = 0; rank < asked.size(); ++rank)
    {
      for (std::size_t i = 0; i < asked[rank].size(); ++i)
      {
        work(rank, i, best[std::size_t(asked[rank][i])]);
      }
    }
  };
  forReplies(
    [&](std::size_t rank, std::size_t i, Best& so)
    {
      const CellKey key = keyOf(replies[rank], i);
      const std::int64_t cell = replies[rank].Cells[i];
      if (cell >= 0 && (so.Cell < 0 || std::tie(key, cell) < std::tie(so.Key, so.Cell)))
      {
        so = { key, cell, rank };
      }
    });
  std::vector<std::vector<char>> chosen(asked.size());
  forReplies([&](std::size_t rank, std::size_t, const Best& so)
    { chosen[rank].push_back(char(so.Cell >= 0 && so.Rank == rank)); });
  return chosen;
}

} // namespace

std::pair<std::size_t, std::size_t> piecesOfRank(
  const Communicator& ranks, const ResidentMesh& mesh)
{
  if (!mesh.isStored())
  {
    return { 0, 1 };
  }
  // As rankOfPiece().
  const std::size_t pieces = mesh.mesh().Pieces.size();
  const auto size = std::size_t(ranks.size());
  const auto firstOf = [&](std::size_t rank) { return (rank * pieces + size - 1) / size; };
  return { firstOf(std::size_t(ranks.rank())), firstOf(std::size_t(ranks.rank()) + 1) };
}

std::size_t rankOfPiece(const Communicator& ranks, const ResidentMesh& mesh, std::int64_t piece)
{
  return std::size_t(piece * ranks.size() / std::int64_t(mesh.mesh().Pieces.size()));
}

MeshAnswer answerOnRanks(Communicator& ranks, const ResidentMesh& mesh, const Point3* points,
  std::int64_t count, const AnswerOptions& options)
{
  const PointsOnRanks questions(ranks, mesh, points, count, options);
  std::vector<Reply> replies;
  for (std::size_t rank = 0; rank < std::size_t(ranks.size()); ++rank)
  {
    replies.push_back(cutOut(
      questions.found(), questions.begin(rank), questions.begin(rank + 1), questions.corners()));
  }
  replies = ranks.allToAll(replies);
  MeshAnswer answer = questions.emptyAnswer(count);
  for (std::size_t rank = 0; rank < replies.size(); ++rank)
  {
    merge(replies[rank], questions.asked()[rank], questions.corners(), answer);
  }
  options.Keys ? void() : answer.Keys.clear();
  return answer;
}

StayingAnswer answerWhereCellsAre(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options)
{
  const PointsOnRanks questions(ranks, mesh, points, count, options);
  std::vector<Reply> replies(std::size_t(ranks.size()));
  for (std::size_t rank = 0; rank < replies.size(); ++rank)
  {
    const auto at = [&](const auto& values, std::size_t r)
    { return values.begin() + std::ptrdiff_t(questions.begin(r)); };
    const MeshAnswer& found = questions.found();
    replies[rank].Cells.assign(at(found.Cells, rank), at(found.Cells, rank + 1));
    if (!found.Keys.empty())
    {
      replies[rank].Keys.assign(at(found.Keys, rank), at(found.Keys, rank + 1));
    }
  }
  replies = ranks.allToAll(replies);
  const std::vector<std::vector<char>> chosen =
    ranks.allToAll(chooseRanks(questions.asked(), replies, count));
  const std::vector<std::vector<std::int64_t>> indices = ranks.allToAll(questions.asked());

  StayingAnswer result;
  std::vector<std::size_t> kept; // among the received points
  for (std::size_t rank = 0; rank < chosen.size(); ++rank)
  {
    for (std::size_t i = 0; i < chosen[rank].size(); ++i)
    {
      if (chosen[rank][i])
      {
        kept.push_back(questions.begin(rank) + i);
        result.Ranks.push_back(std::int64_t(rank));
        result.Indices.push_back(indices[rank][i]);
        result.Points.push_back(questions.received()[kept.back()]);
      }
    }
  }
  result.Answer = questions.emptyAnswer(std::int64_t(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    merge(cutOut(questions.found(), kept[k], kept[k] + 1, questions.corners()), { std::int64_t(k) },
      questions.corners(), result.Answer);
  }
  options.Keys ? void() : result.Answer.Keys.clear();
  return result;
}

} // namespace tipp

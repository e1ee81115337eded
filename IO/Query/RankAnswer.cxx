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
std::vector<std::vector<std::int64_t>> shareOut(const ResidentMesh& mesh,
  const std::vector<RankPart>& parts, const Point3* points, std::int64_t count)
{
  const auto ranks = std::int64_t(parts.size());
  std::vector<std::vector<std::int64_t>> asked(parts.size());
  const auto pieces = std::int64_t(mesh.mesh().Pieces.size());
  const std::vector<std::int32_t> pieceOf =
    mesh.isStored() ? mesh.piecesOf(points, count) : std::vector<std::int32_t>();
  for (std::int64_t i = 0; i < count; ++i)
  {
    if (mesh.isStored())
    {
      const std::int64_t piece = pieceOf[std::size_t(i)];
      piece >= 0 ? asked[std::size_t(piece * ranks / pieces)].push_back(i) : void();
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
Reply cutOut(const MeshAnswer& answer, std::size_t begin, std::size_t end, std::size_t corners,
  std::int64_t firstCell)
{
  const auto cut = [&](const auto& values, std::size_t width)
  {
    return values.empty()
      ? values
      : std::decay_t<decltype(values)>(values.data() + begin * width, values.data() + end * width);
  };
  Reply reply{ cut(answer.Cells, 1), cut(answer.Weights, corners), cut(answer.Keys, 1), {} };
  for (std::int64_t& cell : reply.Cells)
  {
    cell += cell >= 0 ? firstCell : 0;
  }
  for (const MeshAnswer::Array& array : answer.Arrays)
  {
    const std::size_t bytes = array.tupleBytes();
    reply.Arrays.emplace_back(
      array.Values.data() + begin * bytes, array.Values.data() + end * bytes);
  }
  return reply;
}

/// Takes what a rank says of the points with the indices `asked`, where it is the best so far.
void merge(const Reply& reply, const std::vector<std::int64_t>& asked, std::size_t corners,
  MeshAnswer& answer)
{
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    const auto at = std::size_t(asked[i]);
    if (reply.Cells[i] < 0 ||
      (answer.Cells[at] >= 0 &&
        std::tie(answer.Keys[at], answer.Cells[at]) <= std::tie(reply.Keys[i], reply.Cells[i])))
    {
      continue;
    }
    answer.Cells[at] = reply.Cells[i];
    answer.Keys[at] = reply.Keys[i];
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

} // namespace

std::pair<std::size_t, std::size_t> piecesOfRank(
  const Communicator& ranks, const ResidentMesh& mesh)
{
  if (!mesh.isStored())
  {
    return { 0, 1 };
  }
  // Piece p is of rank p * ranks / pieces, rounded down.
  const std::size_t pieces = mesh.mesh().Pieces.size();
  const auto size = std::size_t(ranks.size());
  const auto firstOf = [&](std::size_t rank) { return (rank * pieces + size - 1) / size; };
  return { firstOf(std::size_t(ranks.rank())), firstOf(std::size_t(ranks.rank()) + 1) };
}

MeshAnswer answerOnRanks(Communicator& ranks, const ResidentMesh& mesh, const Point3* points,
  std::int64_t count, const AnswerOptions& options)
{
  const std::vector<RankPart> parts = ranks.allGather(describe(mesh, options));
  const RankPart common = commonPart(parts);
  std::int64_t firstCell = 0;
  for (int rank = 0; rank < ranks.rank() && !mesh.isStored(); ++rank)
  {
    firstCell += parts[std::size_t(rank)].Cells;
  }
  firstCell = mesh.hasCellIds() ? 0 : firstCell;

  const std::vector<std::vector<std::int64_t>> asked = shareOut(mesh, parts, points, count);
  std::vector<std::vector<Point3>> questions(asked.size());
  for (std::size_t rank = 0; rank < asked.size(); ++rank)
  {
    for (const std::int64_t i : asked[rank])
    {
      questions[rank].push_back(points[i]);
    }
  }
  const std::vector<std::vector<Point3>> received = ranks.allToAll(questions);
  std::vector<Point3> all;
  for (const std::vector<Point3>& part : received)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  AnswerOptions wanted = options;
  wanted.Keys = true;
  const auto corners = std::size_t(common.CellSize);
  std::vector<Reply> replies(received.size());
  if (!all.empty())
  {
    const MeshAnswer found = mesh.answer(all.data(), std::int64_t(all.size()), wanted);
    std::size_t begin = 0;
    for (std::size_t rank = 0; rank < received.size(); ++rank)
    {
      const std::size_t end = begin + received[rank].size();
      replies[rank] = cutOut(found, begin, end, corners, firstCell);
      begin = end;
    }
  }
  replies = ranks.allToAll(replies);

  std::vector<StoredArray> arrays(common.Types.size());
  for (std::size_t a = 0; a < arrays.size(); ++a)
  {
    arrays[a].Name = options.Arrays[a];
    arrays[a].Type = common.Types[a];
    arrays[a].Components = common.Components[a];
  }
  MeshAnswer answer = emptyAnswer(count, arrays, common.CellSize, options.Weights, true);
  for (std::size_t rank = 0; rank < replies.size(); ++rank)
  {
    merge(replies[rank], asked[rank], corners, answer);
  }
  options.Keys ? void() : answer.Keys.clear();
  return answer;
}

} // namespace tipp

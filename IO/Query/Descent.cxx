// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Query/ForPieces.h"
#include "Query/Lines.h"
#include "Query/PieceDescent.h"
#include "Query/RankAnswer.h"

#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// For each walk, the piece in which it continues, or -1 if it has ended.
std::vector<std::int32_t> piecesOf(const ResidentMesh& mesh, const std::vector<Walk>& walks)
{
  std::vector<std::size_t> open;
  std::vector<Point3> positions;
  for (std::size_t i = 0; i < walks.size(); ++i)
  {
    if (walks[i].Cell >= 0)
    {
      open.push_back(i);
      positions.push_back(walks[i].OfLow);
    }
  }
  const std::vector<std::int32_t> found =
    mesh.piecesOf(positions.data(), std::int64_t(positions.size()));
  std::vector<std::int32_t> pieces(walks.size(), -1);
  for (std::size_t k = 0; k < open.size(); ++k)
  {
    if (found[k] < 0)
    {
      throw IOError(mesh.mesh().Path, "has points outside of all of its pieces.");
    }
    pieces[open[k]] = found[k];
  }
  return pieces;
}

/// Continues walks as long as they are in the pieces [first, end).
void follow(const ResidentMesh& mesh, const std::string& array, int component,
  std::pair<std::size_t, std::size_t> range, std::vector<Walk>& walks)
{
  const StoredArray* const description = fieldOf(mesh, array, component);
  PieceNeeds needs = mesh.needsOf({ array });
  needs.Topology = true;
  const auto groupsOfOpen = [&]
  {
    std::vector<std::int32_t> pieces = piecesOf(mesh, walks);
    for (std::int32_t& piece : pieces)
    {
      const bool isHere = piece >= std::int64_t(range.first) && piece < std::int64_t(range.second);
      piece = isHere ? piece : -1;
    }
    return groupByPiece(pieces);
  };
  for (PieceGroups groups = groupsOfOpen(); !groups.Items.empty(); groups = groupsOfOpen())
  {
    forPieces(mesh, groups, needs,
      [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
      {
        const PartValues values(*piece.Part, description);
        const PieceDescent descent(piece, values, component);
        for (std::int64_t i = begin; i < end; ++i)
        {
          Walk& walk = walks[std::size_t(groups.Items[std::size_t(i)])];
          const std::size_t before = walk.Points.size();
          descent.follow(walk);
          walk.Cell >= 0 && walk.Points.size() == before ? mesh.refuseId(walk.Low, true) : void();
        }
      });
  }
}

std::vector<Walk> begin(const std::vector<Point3>& points, const std::vector<std::int64_t>& cells)
{
  std::vector<Walk> walks(points.size());
  for (std::size_t i = 0; i < walks.size(); ++i)
  {
    walks[i].Cell = cells[i];
    walks[i].At = walks[i].OfLow = { points[i].x, points[i].y, 0 };
  }
  return walks;
}

Descents linesOf(const std::vector<Walk>& walks)
{
  Descents result;
  for (const Walk& walk : walks)
  {
    result.Points.insert(result.Points.end(), walk.Points.begin(), walk.Points.end());
    result.Values.insert(result.Values.end(), walk.Values.begin(), walk.Values.end());
    result.Starts.push_back(std::int64_t(result.Points.size()));
    result.Pits.push_back(walk.Pit);
  }
  return result;
}

/// Sends each unfinished walk to the rank that has its piece, which continues it. Returns whether
/// there was one on any rank.
bool followOnRanks(Communicator& ranks, const ResidentMesh& mesh, const std::string& array,
  int component, std::vector<Walk>& walks)
{
  const std::vector<std::int32_t> pieces = piecesOf(mesh, walks);
  std::vector<std::vector<std::size_t>> sent(std::size_t(ranks.size()));
  std::vector<std::vector<Walk>> messages(sent.size());
  std::vector<std::int64_t> open = { 0 };
  for (std::size_t i = 0; i < walks.size(); ++i)
  {
    if (pieces[i] >= 0)
    {
      const std::size_t rank = rankOfPiece(ranks, mesh, pieces[i]);
      sent[rank].push_back(i);
      messages[rank].push_back(walks[i]); // its points so far stay on this rank
      messages[rank].back().Points.clear();
      messages[rank].back().Values.clear();
      ++open[0];
    }
  }
  ranks.sum(open);
  if (open[0] == 0)
  {
    return false;
  }
  messages = ranks.allToAll(messages);
  for (std::vector<Walk>& message : messages)
  {
    follow(mesh, array, component, piecesOfRank(&ranks, mesh), message);
  }
  messages = ranks.allToAll(messages);
  for (std::size_t rank = 0; rank < sent.size(); ++rank)
  {
    for (std::size_t k = 0; k < sent[rank].size(); ++k)
    {
      Walk& walk = walks[sent[rank][k]];
      Walk& further = messages[rank][k];
      walk.Points.insert(walk.Points.end(), further.Points.begin(), further.Points.end());
      walk.Values.insert(walk.Values.end(), further.Values.begin(), further.Values.end());
      further.Points.swap(walk.Points);
      further.Values.swap(walk.Values);
      walk = std::move(further);
    }
  }
  return true;
}

} // namespace

Descents descentsOf(const ResidentMesh& mesh, const std::vector<Point3>& points,
  const std::string& array, int component, Communicator* ranks)
{
  if (ranks && !mesh.isStored())
  {
    throw IOError("Each rank has a part of the mesh alone; store the mesh for ways down.");
  }
  fieldOf(mesh, array, component);
  std::vector<Walk> walks =
    begin(points, answerOf(mesh, points.data(), std::int64_t(points.size()), {}, ranks).Cells);
  if (!ranks)
  {
    follow(mesh, array, component, piecesOfRank(nullptr, mesh), walks);
    return linesOf(walks);
  }
  while (followOnRanks(*ranks, mesh, array, component, walks))
  {
  }
  return linesOf(walks);
}

} // namespace tipp

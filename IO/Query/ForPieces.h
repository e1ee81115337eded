// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippForPieces_h
#define tippForPieces_h

#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Query/PartTopology.h"
#include "Query/ResidentMesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace tipp
{

inline Point3 positionOf(const MeshPart& part, std::int64_t point)
{
  Point3 position{};
  withAccess(part.Mesh, [&](const auto& access) { position = access.point(point); });
  return position;
}

inline void sortUnique(std::vector<std::int64_t>& ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

inline bool owns(const MeshPart& part, std::int64_t point)
{
  return !part.Ghosts || part.Ghosts[point] == 0;
}

/// Calls work(piece, begin, end) for the items of each group, groups.Items[begin] ... [end - 1], on
/// several threads: each has a piece, or all have the same one.
template <typename Work>
void forPieces(
  const ResidentMesh& mesh, const PieceGroups& groups, const PieceNeeds& needs, const Work& work)
{
  const int threads = threadCount(mesh.options().Threads);
  const auto count = std::int64_t(groups.Groups.size());
  const bool manyPieces = count >= 2 * threads;
  forChunks(count, 1, manyPieces ? threads : 1, {},
    [&](std::int64_t g, std::int64_t, int)
    {
      poll();
      const PieceGroups::Group& group = groups.Groups[std::size_t(g)];
      const ResidentPieces::Lease piece = mesh.pieces().get(group.Piece, needs);
      forChunks(group.End - group.Begin, 1 << 12, manyPieces ? 1 : threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        { work(*piece, group.Begin + begin, group.Begin + end); });
    });
}

/// The pieces [first, end), without items.
template <typename Work>
void forPieceRange(const ResidentMesh& mesh, std::size_t first, std::size_t end, const Work& work)
{
  PieceNeeds needs;
  needs.Topology = true;
  for (std::size_t i = first; i < end; ++i)
  {
    poll();
    const ResidentPieces::Lease piece = mesh.pieces().get(i, needs);
    work(*piece->Part, *piece->Topology);
  }
}

inline PieceNeeds topologyNeeded()
{
  PieceNeeds needs;
  needs.Topology = true;
  return needs;
}

inline PieceGroups groupsOf(
  const ResidentMesh& mesh, const std::vector<std::int64_t>& ids, bool ofPoints)
{
  return groupByPiece(mesh.piecesOfIds(ids, ofPoints), mesh.mesh().Pieces.size());
}

/// The index of an id in the piece that owns it.
inline std::int64_t indexOf(
  const ResidentMesh& mesh, const PartTopology& topology, std::int64_t id, bool ofPoints)
{
  const std::int64_t index = ofPoints ? topology.findPoint(id) : topology.findCell(id);
  if (index < 0)
  {
    mesh.refuseId(id, ofPoints);
  }
  return index;
}

} // namespace tipp

#endif

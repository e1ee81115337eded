// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippForPieces_h
#define tippForPieces_h

#include "Arrays/SortUnique.h"
#include "Locate/MortonOrder.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Query/PartTopology.h"
#include "Query/ResidentMesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

inline Point3 positionOf(const MeshPart& part, std::int64_t point)
{
  Point3 position{};
  withAccess(part.Mesh, [&](const auto& access) { position = access.point(point); });
  return position;
}

inline bool owns(const MeshPart& part, std::int64_t point)
{
  return !part.Ghosts || part.Ghosts[point] == 0;
}

/// Calls work(piece, begin, end) for the items groups.Items[begin] ... [end - 1] of each group.
/// Several threads are used: for different pieces, or for the items of the same piece.
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

/// Calls work(part, topology) for the pieces [first, end), one after the other.
template <typename Work>
void forPieceRange(const ResidentMesh& mesh, std::size_t first, std::size_t end, const Work& work)
{
  PieceNeeds needs;
  needs.Topology = true;
  const bool stay = mesh.pieces().fit(first, end, needs);
  for (std::size_t i = first; i < end; ++i)
  {
    poll();
    const ResidentPieces::Lease piece = mesh.pieces().get(i, needs, stay);
    work(*piece->Part, *piece->Topology);
  }
}

inline bool meets(const Bounds& a, const Bounds& b, int dimension)
{
  bool met = true;
  for (std::size_t axis = 0; axis < std::size_t(dimension); ++axis)
  {
    met = met && a[2 * axis] <= b[2 * axis + 1] && b[2 * axis] <= a[2 * axis + 1];
  }
  return met;
}

inline Bounds boundsOf(const Box<2>& box)
{
  return { box.Low[0], box.High[0], box.Low[1], box.High[1], 0, 0 };
}

inline std::pair<std::size_t, std::size_t> allPieces(const ResidentMesh& mesh)
{
  return { 0, mesh.mesh().Pieces.size() };
}

/// Calls work(part, box, begin, end) for the cells [begin, end) of each piece of [first, last)
/// whose box satisfies wants(box), on several threads. These include borrowed cells: every piece
/// has all cells that meet its box, so a cell may be passed several times. For a mesh in memory,
/// `box` is null.
template <typename Wants, typename Work>
void forCells(const ResidentMesh& mesh, std::pair<std::size_t, std::size_t> pieces,
  const PieceNeeds& needs, const Wants& wants, const Work& work)
{
  std::vector<std::int32_t> wanted;
  for (std::size_t i = pieces.first; i < pieces.second; ++i)
  {
    !mesh.isStored() || wants(mesh.mesh().Pieces[i].Box) ? wanted.push_back(std::int32_t(i))
                                                         : void();
  }
  const int threads = threadCount(mesh.options().Threads);
  const bool manyPieces = std::int64_t(wanted.size()) >= 2 * threads;
  forChunks(std::int64_t(wanted.size()), 1, manyPieces ? threads : 1, {},
    [&](std::int64_t i, std::int64_t, int)
    {
      poll();
      const auto number = std::size_t(wanted[std::size_t(i)]);
      const Bounds* const box = mesh.isStored() ? &mesh.mesh().Pieces[number].Box : nullptr;
      const ResidentPieces::Lease piece = mesh.pieces().get(number, needs);
      forChunks(piece->Part->Mesh.Cells, 1 << 13, manyPieces ? 1 : threads, {},
        [&](std::int64_t begin, std::int64_t end, int) { work(*piece->Part, box, begin, end); });
    });
}

inline PieceNeeds topologyNeeded()
{
  PieceNeeds needs;
  needs.Topology = true;
  return needs;
}

/// Groups ids by the pieces that own them. `pieces` may be the result of mesh.piecesOfIds() for
/// these ids; if it is empty, the pieces are looked up.
inline PieceGroups groupsOf(const ResidentMesh& mesh, const std::vector<std::int64_t>& ids,
  bool ofPoints, const std::vector<std::int32_t>& pieces)
{
  return groupByPiece(pieces.size() == ids.size() ? pieces : mesh.piecesOfIds(ids, ofPoints),
    mesh.mesh().Pieces.size());
}

/// The local index of a global id in the piece that owns it. Throws IOError if the piece does not
/// have it.
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

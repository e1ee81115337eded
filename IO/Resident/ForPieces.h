// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippForPieces_h
#define tippForPieces_h

#include "Locate/MortonOrder.h"
#include "Parallel/ParallelFor.h"
#include "Resident/MeshPart.h"
#include "Resident/ResidentMesh.h"

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

/// The point at the fraction `share` of the way from a to b.
inline Point3 between(const Point3& a, const Point3& b, double share)
{
  return { a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z) };
}

/// The cell across the face opposite to a corner of a cell, or -1 if there is none. Of several, the
/// one with the lowest global id. Cells are local indices.
inline std::int64_t lowestAcross(
  const MeshPart& part, const PartTopology& topology, std::int64_t cell, int face)
{
  std::int64_t found = -1;
  topology.visitAcross(cell, face,
    [&](std::int64_t other)
    {
      const bool isLower = found < 0 || part.cellId(other) < part.cellId(found);
      found = isLower ? other : found;
    });
  return found;
}

/// Calls work(i, threads) for each i of [0, count), where each i stands for a piece. If there are
/// many pieces, each thread processes a piece at a time. Otherwise all threads share one piece
/// after the other.
template <typename Work>
void sharePieces(const ResidentMesh& mesh, std::size_t count, const Work& work)
{
  const int threads = threadCount(mesh.options().Threads);
  const bool areMany = std::int64_t(count) >= 2 * threads;
  forChunks(std::int64_t(count), 1, areMany ? threads : 1, {},
    [&](std::int64_t i, std::int64_t, int)
    {
      poll();
      work(std::size_t(i), areMany ? 1 : threads);
    });
}

/// Calls work(piece, begin, end) for the items groups.Items[begin] ... [end - 1] of each group, on
/// several threads.
template <typename Work>
void forPieces(
  const ResidentMesh& mesh, const PieceGroups& groups, const PieceNeeds& needs, const Work& work)
{
  sharePieces(mesh, groups.Groups.size(),
    [&](std::size_t g, int threads)
    {
      const PieceGroups::Group& group = groups.Groups[g];
      const ResidentPieces::Lease piece = mesh.pieces().get(group.Piece, needs);
      forChunks(group.End - group.Begin, 1 << 12, threads, {},
        [&](std::int64_t begin, std::int64_t end, int)
        { work(*piece, group.Begin + begin, group.Begin + end); });
    });
}

inline PieceNeeds topologyNeeded()
{
  PieceNeeds needs;
  needs.Topology = true;
  return needs;
}

/// Calls work(piece) for the pieces [pieces.first, pieces.second), on `threads` threads; with one
/// thread in ascending order. The pieces stay in memory if all of them fit.
template <typename Work>
void forPieceRange(const ResidentMesh& mesh, std::pair<std::size_t, std::size_t> pieces,
  const PieceNeeds& needs, int threads, const Work& work)
{
  const bool stay = mesh.pieces().fit(pieces.first, pieces.second, needs);
  forChunks(std::int64_t(pieces.second - pieces.first), 1, threads, {},
    [&](std::int64_t i, std::int64_t, int)
    {
      poll();
      const ResidentPieces::Lease piece =
        mesh.pieces().get(pieces.first + std::size_t(i), needs, stay);
      work(*piece);
    });
}

///@{
/// Whether boxes meet, or a box contains a point; with dimension 2 whatever z is.
inline bool meets(const Box3& a, const Box3& b, int dimension)
{
  return dimension == 2 ? projected<2>(a).meets(projected<2>(b)) : a.meets(b);
}
inline bool contains(const Box3& box, const Point3& p, int dimension)
{
  return dimension == 2 ? projected<2>(box).contains(projected<2>(p)) : box.contains(p);
}
///@}

/// Calls work(part, box, begin, end) for the cells [begin, end) of each piece of [first, last)
/// whose box satisfies wants(box), on several threads. These include borrowed cells: every piece
/// has all cells that meet its box, so a cell may be passed several times. For a mesh in memory,
/// `box` is null.
template <typename Wants, typename Work>
void forCells(const ResidentMesh& mesh, std::pair<std::size_t, std::size_t> pieces,
  const PieceNeeds& needs, const Wants& wants, const Work& work)
{
  std::vector<std::size_t> wanted;
  for (std::size_t i = pieces.first; i < pieces.second; ++i)
  {
    if (!mesh.isStored() || wants(mesh.mesh().Pieces[i].Box))
    {
      wanted.push_back(i);
    }
  }
  sharePieces(mesh, wanted.size(),
    [&](std::size_t i, int threads)
    {
      const Box3* const box = mesh.isStored() ? &mesh.mesh().Pieces[wanted[i]].Box : nullptr;
      const ResidentPieces::Lease piece = mesh.pieces().get(wanted[i], needs);
      forChunks(piece->Part->Mesh.Cells, 1 << 13, threads, {},
        [&](std::int64_t begin, std::int64_t end, int) { work(*piece->Part, box, begin, end); });
    });
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Resident/PieceNeighbors.h"

#include "Resident/ForPieces.h"

#include <algorithm>
#include <array>
#include <mutex>

namespace tipp
{
namespace
{

using Ids = std::vector<std::int64_t>;

/// A face, none of whose points is owned by the piece that owns its cell. Ids are global.
struct SharedFace
{
  std::int64_t At; ///< index in the result
  std::int64_t Cell;
  std::array<std::int64_t, 3> Points;
  Point3 Position; ///< of Points[0]
};

/// Finds neighbours across faces of which the owner of the cell may not have all cells. The piece
/// that owns the face's first point has all cells there.
void findAcrossShared(const ResidentMesh& mesh, const std::vector<SharedFace>& faces, Ids& result)
{
  const int count = mesh.mesh().CellSize - 1;
  Ids points;
  std::vector<Point3> positions;
  for (const SharedFace& face : faces)
  {
    points.push_back(face.Points[0]);
    positions.push_back(face.Position);
  }
  const PieceGroups groups = groupByPiece(mesh.piecesAround(points, positions));
  forPieces(mesh, groups, topologyNeeded(),
    [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
    {
      const PartTopology& topology = *piece.Topology;
      for (std::int64_t i = begin; i < end; ++i)
      {
        const SharedFace& face = faces[std::size_t(groups.Items[std::size_t(i)])];
        std::int64_t corners[3] = { -1, -1, -1 };
        std::transform(face.Points.begin(), face.Points.begin() + count, corners,
          [&topology](std::int64_t id) { return topology.findPoint(id); });
        std::int64_t& lowest = result[std::size_t(face.At)];
        if (*std::min_element(corners, corners + count) < 0)
        {
          continue; // no cell of this piece has this face
        }
        for (const std::int32_t cell : topology.cellsAt(corners[0]))
        {
          const std::int64_t id = piece.Part->cellId(cell);
          if (id != face.Cell && topology.hasCorners(cell, corners, count))
          {
            lowest = lowest < 0 ? id : std::min(lowest, id);
          }
        }
      }
    });
}

} // namespace

std::vector<std::int64_t> computedNeighbors(
  const ResidentMesh& mesh, const PieceGroups& groups, const Ids& cells)
{
  const int corners = mesh.mesh().CellSize;
  Ids result(cells.size() * std::size_t(corners), -1);
  std::vector<SharedFace> shared;
  std::mutex mutex;
  forPieces(mesh, groups, topologyNeeded(),
    [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
    {
      const MeshPart& part = *piece.Part;
      const PartTopology& topology = *piece.Topology;
      for (std::int64_t i = begin; i < end; ++i)
      {
        const std::int64_t item = groups.Items[std::size_t(i)];
        const std::int64_t cell = indexOf(mesh, topology, cells[std::size_t(item)], false);
        for (int face = 0; face < corners; ++face)
        {
          SharedFace other{ item * corners + face, cells[std::size_t(item)], {}, {} };
          bool isComplete = false;
          int count = 0;
          for (int k = 0; k < corners; ++k)
          {
            const std::int64_t point = topology.corner(cell, k);
            isComplete = isComplete || (k != face && part.owns(point));
            if (k != face)
            {
              other.Points[std::size_t(count++)] = part.pointId(point);
            }
          }
          if (isComplete)
          {
            const std::int64_t across = lowestAcross(part, topology, cell, face);
            result[std::size_t(other.At)] = across < 0 ? -1 : part.cellId(across);
            continue;
          }
          other.Position = positionOf(part, topology.corner(cell, face == 0 ? 1 : 0));
          const std::lock_guard<std::mutex> lock(mutex);
          shared.push_back(other);
        }
      }
    });
  if (mesh.isTrueOnAnyRank(!shared.empty()))
  {
    findAcrossShared(mesh, shared, result);
  }
  return result;
}

OwnedNeighbors neighborsInPiece(const ResidentMesh& mesh, std::size_t piece)
{
  OwnedNeighbors owned;
  {
    const ResidentPieces::Lease lease = mesh.pieces().get(piece, topologyNeeded());
    const MeshPart& part = *lease->Part;
    for (std::int64_t cell = 0; cell < part.OwnedCells; ++cell)
    {
      owned.Cells.push_back(part.cellId(cell));
    }
  }
  const std::vector<std::int32_t> pieces(owned.Cells.size(), std::int32_t(piece));
  owned.Neighbors = computedNeighbors(mesh, groupByPiece(pieces), owned.Cells);
  return owned;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Files/IOError.h"
#include "Predicates/ExactPredicates.h"
#include "Query/RankAnswer.h"
#include "Query/RankMesh.h"
#include "Resident/ForPieces.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// A border edge as global point ids, with the end point of the next border edge.
struct BorderEdge
{
  std::int64_t From;
  std::int64_t To;
  std::int64_t Next;
  Point3 Position; ///< position of To

  bool operator<(const BorderEdge& other) const
  {
    return std::tie(this->From, this->To) < std::tie(other.From, other.To);
  }
};

/// Collects the border edges that end at points that a piece owns.
class PieceBorderEdges
{
public:
  PieceBorderEdges(
    const MeshPart& part, const PartTopology& topology, std::vector<BorderEdge>& edges)
    : Part(part)
    , Topology(topology)
    , Edges(edges)
  {
  }

  void add(std::int64_t point)
  {
    for (const std::int32_t cell : this->Topology.cellsAt(point))
    {
      int turned[3];
      this->counterClockwise(cell, turned);
      for (int i = 0; i < 3; ++i)
      {
        const std::int64_t to = this->Topology.corner(cell, turned[(i + 1) % 3]);
        if (to == point && lowestAcross(this->Part, this->Topology, cell, turned[(i + 2) % 3]) < 0)
        {
          this->Edges.push_back(
            { this->Part.pointId(this->Topology.corner(cell, turned[i])), this->Part.pointId(point),
              this->Part.pointId(this->next(cell, turned[(i + 2) % 3], point)),
              positionOf(this->Part, point) });
        }
      }
    }
  }

private:
  /// Writes the cell's corners in counter-clockwise order to `turned`. Keeps their order if the
  /// cell has no area.
  void counterClockwise(std::int64_t cell, int (&turned)[3]) const
  {
    Point2 p[3];
    for (int i = 0; i < 3; ++i)
    {
      p[i] = projected<2>(positionOf(this->Part, this->Topology.corner(cell, i)));
      turned[i] = i;
    }
    if (orientation(p[0], p[1], p[2]) < 0)
    {
      std::swap(turned[1], turned[2]);
    }
  }

  /// Goes around `point`, from the cell's border edge that ends there to the border edge that
  /// starts there. Returns the end of the latter. `opposite` is the cell's corner that is not on
  /// its edge.
  std::int64_t next(std::int64_t cell, int opposite, std::int64_t point) const
  {
    std::int64_t end = this->Topology.corner(cell, opposite);
    const auto cells = this->Topology.cellsAt(point);
    for (auto left = cells.end() - cells.begin(); left > 0; --left)
    {
      const std::int64_t other =
        lowestAcross(this->Part, this->Topology, cell, this->third(cell, point, end));
      if (other < 0)
      {
        break;
      }
      cell = other;
      end = this->Topology.corner(cell, this->third(cell, point, end));
    }
    return end;
  }

  /// The corner of a cell that is neither a nor b.
  int third(std::int64_t cell, std::int64_t a, std::int64_t b) const
  {
    int i = 0;
    while (this->Topology.corner(cell, i) == a || this->Topology.corner(cell, i) == b)
    {
      ++i;
    }
    return i;
  }

  const MeshPart& Part;
  const PartTopology& Topology;
  std::vector<BorderEdge>& Edges;
};

BoundaryLoops linked(std::vector<BorderEdge> edges)
{
  std::sort(edges.begin(), edges.end());
  std::vector<char> isUsed(edges.size());
  BoundaryLoops loops;
  for (std::size_t first = 0; first < edges.size(); ++first)
  {
    const std::size_t begin = loops.Points.Ids.size();
    for (std::size_t at = first; at < edges.size() && !isUsed[at];)
    {
      isUsed[at] = 1;
      loops.Points.Ids.push_back(edges[at].To);
      loops.Positions.push_back(edges[at].Position);
      const BorderEdge next{ edges[at].To, edges[at].Next, 0, {} };
      const auto found = std::lower_bound(edges.begin(), edges.end(), next);
      at = found != edges.end() && !(next < *found) ? std::size_t(found - edges.begin())
                                                    : edges.size();
    }
    if (loops.Points.Ids.size() > begin)
    {
      // The loop starts with the first point of the lowest edge, which was added last.
      std::rotate(loops.Points.Ids.begin() + std::ptrdiff_t(begin), loops.Points.Ids.end() - 1,
        loops.Points.Ids.end());
      std::rotate(loops.Positions.begin() + std::ptrdiff_t(begin), loops.Positions.end() - 1,
        loops.Positions.end());
      loops.Points.Starts.push_back(std::int64_t(loops.Points.Ids.size()));
    }
  }
  return loops;
}

/// The border edges that end at points owned by the pieces [pieces.first, pieces.second).
std::vector<BorderEdge> borderIn(
  const ResidentMesh& mesh, std::pair<std::size_t, std::size_t> pieces)
{
  std::vector<BorderEdge> edges;
  forPieceRange(mesh, pieces, topologyNeeded(), 1,
    [&](const ResidentPiece& piece)
    {
      PieceBorderEdges border(*piece.Part, *piece.Topology, edges);
      for (std::int64_t point = 0; point < piece.Part->Mesh.PointCount; ++point)
      {
        if (piece.Part->owns(point))
        {
          border.add(point);
        }
      }
    });
  return edges;
}

} // namespace

BoundaryLoops boundaryOf(const ResidentMesh& mesh, Communicator* ranks)
{
  if (mesh.mesh().CellSize != 3)
  {
    throw IOError("The border of tetrahedra is a surface and no line; ask a mesh of triangles.");
  }
  if (mesh.isStored() || !areSeveral(ranks))
  {
    return linked(gathered(ranks, borderIn(mesh, piecesOfRank(ranks, mesh))));
  }
  const RankMesh own(*ranks, mesh);
  return linked(gathered(ranks, borderIn(own, { 0, own.addFirstShared() })));
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Around.h"

#include "Arrays/SortUnique.h"
#include "Files/IOError.h"
#include "Predicates/ExactPredicates.h"
#include "Query/ForPieces.h"
#include "Query/RankAnswer.h"

#include <algorithm>
#include <set>
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
  Point3 At; ///< position of To

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
      const Point3 corner = positionOf(this->Part, this->Topology.corner(cell, i));
      p[i] = { corner.x, corner.y };
      turned[i] = i;
    }
    orientation(p[0], p[1], p[2]) < 0 ? std::swap(turned[1], turned[2]) : void();
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
      int before = 0; // the corner that is neither `point` nor `end`
      while (
        this->Topology.corner(cell, before) == point || this->Topology.corner(cell, before) == end)
      {
        ++before;
      }
      const std::int64_t other = lowestAcross(this->Part, this->Topology, cell, before);
      if (other < 0)
      {
        break;
      }
      cell = other;
      int i = 0;
      while (this->Topology.corner(cell, i) == point || this->Topology.corner(cell, i) == end)
      {
        ++i;
      }
      end = this->Topology.corner(cell, i);
    }
    return end;
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
      loops.Positions.push_back(edges[at].At);
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

/// The border edges that end at points owned by this rank's pieces.
std::vector<BorderEdge> borderIn(const ResidentMesh& mesh, const Communicator* ranks)
{
  std::vector<BorderEdge> edges;
  forPieceRange(mesh, piecesOfRank(ranks, mesh),
    [&](const MeshPart& part, const PartTopology& topology)
    {
      PieceBorderEdges border(part, topology, edges);
      for (std::int64_t point = 0; point < part.Mesh.PointCount; ++point)
      {
        owns(part, point) ? border.add(point) : void();
      }
    });
  return edges;
}

/// Border triangles of a part in memory: those at the ends of edges that only one triangle of the
/// part has.
struct OpenCells
{
  std::vector<std::int64_t> Cells;  ///< global ids
  std::vector<std::int64_t> Points; ///< global ids, three per cell
  std::vector<Point3> Positions;    ///< position of each of Points
  std::vector<std::int64_t> Ends;   ///< global ids of the ends of these edges
};

template <typename Archive>
void serialize(Archive& archive, OpenCells& open)
{
  archive(open.Cells, open.Points, open.Positions, open.Ends);
}

OpenCells openCells(const MeshPart& part, const PartTopology& topology)
{
  std::set<std::int64_t> ends;
  for (std::int64_t cell = 0; cell < part.Mesh.Cells; ++cell)
  {
    pollAt(cell);
    for (int face = 0; face < 3 && !part.isHidden(cell); ++face)
    {
      bool isOpen = true;
      topology.visitAcross(cell, face, [&isOpen](std::int64_t) { isOpen = false; });
      if (isOpen)
      {
        ends.insert(topology.corner(cell, (face + 1) % 3));
        ends.insert(topology.corner(cell, (face + 2) % 3));
      }
    }
  }
  std::set<std::int64_t> cells;
  OpenCells open;
  for (const std::int64_t point : ends)
  {
    open.Ends.push_back(part.pointId(point));
    cells.insert(topology.cellsAt(point).begin(), topology.cellsAt(point).end());
  }
  for (const std::int64_t cell : cells)
  {
    open.Cells.push_back(part.cellId(cell));
    for (int i = 0; i < 3; ++i)
    {
      open.Points.push_back(part.pointId(topology.corner(cell, i)));
      open.Positions.push_back(positionOf(part, topology.corner(cell, i)));
    }
  }
  return open;
}

/// The border of the parts in the memory of all ranks, from the triangles near it.
std::vector<BorderEdge> borderOfParts(const std::vector<OpenCells>& parts)
{
  std::set<std::int64_t> ends;
  std::vector<std::int64_t> pointIds;
  for (const OpenCells& open : parts)
  {
    ends.insert(open.Ends.begin(), open.Ends.end());
    pointIds.insert(pointIds.end(), open.Points.begin(), open.Points.end());
  }
  sortUnique(pointIds);
  std::vector<Point3> positions(pointIds.size());
  std::vector<std::int64_t> corners;
  std::vector<std::int64_t> cellIds;
  for (const OpenCells& open : parts)
  {
    cellIds.insert(cellIds.end(), open.Cells.begin(), open.Cells.end());
    for (std::size_t i = 0; i < open.Points.size(); ++i)
    {
      const auto at = std::lower_bound(pointIds.begin(), pointIds.end(), open.Points[i]);
      corners.push_back(at - pointIds.begin());
      positions[std::size_t(corners.back())] = open.Positions[i];
    }
  }
  MeshPart part;
  part.Mesh.Points = positions.data();
  part.Mesh.PointCount = std::int64_t(positions.size());
  part.Mesh.Ids = corners.data();
  part.Mesh.Wide = true;
  part.Mesh.Cells = part.OwnedCells = std::int64_t(cellIds.size());
  part.CellIds = cellIds.data();
  part.PointIds = pointIds.data();
  const PartTopology topology(part);
  std::vector<BorderEdge> edges;
  PieceBorderEdges border(part, topology, edges);
  for (const std::int64_t id : ends)
  {
    border.add(topology.findPoint(id));
  }
  return edges;
}

} // namespace

BoundaryLoops boundaryOf(const ResidentMesh& mesh, Communicator* ranks)
{
  requireIds(ranks, mesh);
  if (mesh.mesh().CellSize != 3)
  {
    throw IOError("The border of tetrahedra is a surface and no line; ask a mesh of triangles.");
  }
  if (mesh.isStored() || !areSeveral(ranks))
  {
    return linked(gathered(ranks, borderIn(mesh, ranks)));
  }
  OpenCells open;
  if (mesh.mesh().Cells > 0)
  {
    const ResidentPieces::Lease piece = mesh.pieces().get(0, topologyNeeded());
    open = openCells(*piece->Part, *piece->Topology);
  }
  const std::vector<OpenCells> parts = ranks->gather(open);
  return ranks->isFirst() ? linked(borderOfParts(parts)) : BoundaryLoops();
}

} // namespace tipp

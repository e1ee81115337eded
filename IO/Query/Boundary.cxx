// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Around.h"

#include "Files/IOError.h"
#include "Predicates/ExactPredicates.h"
#include "Query/ForPieces.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace tipp
{
namespace
{

/// An edge of the border, and the end of the next one.
struct BorderEdge
{
  std::int64_t From;
  std::int64_t To;
  std::int64_t Next;
  Point3 At; ///< of To

  bool operator<(const BorderEdge& other) const
  {
    return std::tie(this->From, this->To) < std::tie(other.From, other.To);
  }
};

/// The border at the points that one piece owns.
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
        if (to == point && this->across(cell, turned[(i + 2) % 3]) < 0)
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
  /// The cell's corners counter-clockwise; as they are if it has no area.
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

  /// The cell across the face opposite to a corner: of several the one of lowest id; -1: none.
  std::int64_t across(std::int64_t cell, int face) const
  {
    std::int64_t found = -1;
    this->Topology.visitAcross(cell, face,
      [&](std::int64_t other)
      {
        const bool isLower = found < 0 || this->Part.cellId(other) < this->Part.cellId(found);
        found = isLower ? other : found;
      });
    return found;
  }

  /// Turns around `point` from the cell's border edge that ends there to the one that begins there;
  /// returns its end. `opposite` is the cell's corner that is not on the edge.
  std::int64_t next(std::int64_t cell, int opposite, std::int64_t point) const
  {
    std::int64_t end = this->Topology.corner(cell, opposite);
    const auto cells = this->Topology.cellsAt(point);
    for (auto left = cells.end() - cells.begin(); left > 0; --left)
    {
      int before = 0; // the corner that is neither the point nor the end
      while (
        this->Topology.corner(cell, before) == point || this->Topology.corner(cell, before) == end)
      {
        ++before;
      }
      const std::int64_t other = this->across(cell, before);
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
      // From the lowest edge's first point on, which came last.
      std::rotate(loops.Points.Ids.begin() + std::ptrdiff_t(begin), loops.Points.Ids.end() - 1,
        loops.Points.Ids.end());
      std::rotate(loops.Positions.begin() + std::ptrdiff_t(begin), loops.Positions.end() - 1,
        loops.Positions.end());
      loops.Points.Starts.push_back(std::int64_t(loops.Points.Ids.size()));
    }
  }
  return loops;
}

} // namespace

BoundaryLoops boundaryOf(const ResidentMesh& mesh)
{
  if (mesh.mesh().CellSize != 3)
  {
    throw IOError("The border of tetrahedra is a surface and no line; ask a mesh of triangles.");
  }
  std::vector<BorderEdge> edges;
  forAllPieces(mesh,
    [&](const MeshPart& part, const PartTopology& topology)
    {
      PieceBorderEdges border(part, topology, edges);
      for (std::int64_t point = 0; point < part.Mesh.PointCount; ++point)
      {
        owns(part, point) ? border.add(point) : void();
      }
    });
  return linked(std::move(edges));
}

Components componentsOf(const ResidentMesh& mesh)
{
  std::int64_t count = mesh.mesh().Cells;
  const auto idOf = [&mesh](const MeshPart& part, std::int64_t cell) {
    return mesh.isStored() ? part.cellId(cell) : part.Rows ? part.Rows[cell] : cell;
  };
  forAllPieces(mesh,
    [&](const MeshPart& part, const PartTopology&)
    {
      for (std::int64_t cell = 0; part.Rows && cell < part.Mesh.Cells; ++cell)
      {
        count = std::max(count, part.Rows[cell] + 1);
      }
    });
  std::vector<std::int64_t> parent(std::size_t(count), -1); // of a hidden cell: -1
  const auto rootOf = [&parent](std::int64_t cell)
  {
    while (parent[std::size_t(cell)] != cell)
    {
      const std::int64_t above = parent[std::size_t(parent[std::size_t(cell)])];
      cell = parent[std::size_t(cell)] = above;
    }
    return cell;
  };
  const auto add = [&parent](std::int64_t cell)
  {
    std::int64_t& p = parent[std::size_t(cell)];
    p = p < 0 ? cell : p;
  };
  forAllPieces(mesh,
    [&](const MeshPart& part, const PartTopology& topology)
    {
      for (std::int64_t cell = 0; cell < part.Mesh.Cells; ++cell)
      {
        pollAt(cell);
        if (part.Mesh.Hidden && part.Mesh.Hidden[cell])
        {
          continue;
        }
        add(idOf(part, cell));
        for (int face = 0; face < topology.corners(); ++face)
        {
          topology.visitAcross(cell, face,
            [&](std::int64_t other)
            {
              add(idOf(part, other));
              const std::int64_t a = rootOf(idOf(part, cell));
              const std::int64_t b = rootOf(idOf(part, other));
              parent[std::size_t(std::max(a, b))] = std::min(a, b);
            });
        }
      }
    });
  // A root is the lowest cell of its component.
  Components result;
  result.OfCells = std::move(parent);
  for (std::int64_t cell = 0; cell < count; ++cell)
  {
    std::int64_t& label = result.OfCells[std::size_t(cell)];
    if (label == cell)
    {
      label = std::int64_t(result.Sizes.size());
      result.Sizes.push_back(1);
    }
    else if (label >= 0)
    {
      label = result.OfCells[std::size_t(label)]; // which is lower, and has its label
      ++result.Sizes[std::size_t(label)];
    }
  }
  return result;
}

} // namespace tipp

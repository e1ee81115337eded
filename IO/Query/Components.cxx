// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/SortUnique.h"
#include "Query/Around.h"
#include "Query/ForPieces.h"
#include "Query/RankAnswer.h"
#include "Query/RankAround.h"

#include "Arrays/Random.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace tipp
{

Components componentsOf(const ResidentMesh& mesh)
{
  std::int64_t count = mesh.mesh().Cells;
  const auto idOf = [&mesh](const MeshPart& part, std::int64_t cell) {
    return mesh.isStored() ? part.cellId(cell) : part.Rows ? part.Rows[cell] : cell;
  };
  forPieceRange(mesh, 0, mesh.mesh().Pieces.size(),
    [&](const MeshPart& part, const PartTopology&)
    {
      for (std::int64_t cell = 0; part.Rows && cell < part.Mesh.Cells; ++cell)
      {
        count = std::max(count, part.Rows[cell] + 1);
      }
    });
  std::vector<std::int64_t> parent(std::size_t(count), -1); // -1 for hidden cells
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
  forPieceRange(mesh, 0, mesh.mesh().Pieces.size(),
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
  // The root of a component is its cell with the lowest id.
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
      label = result.OfCells[std::size_t(label)]; // the parent's label, which is set already
      ++result.Sizes[std::size_t(label)];
    }
  }
  return result;
}

namespace
{

using Ids = std::vector<std::int64_t>;

/// A connection between two cells or two components.
struct Link
{
  std::int64_t A;
  std::int64_t B;

  bool operator<(const Link& other) const
  {
    return std::tie(this->A, this->B) < std::tie(other.A, other.B);
  }
  bool operator==(const Link& other) const { return this->A == other.A && this->B == other.B; }
};

/// A face with only one cell on a rank. Unused points are -1.
struct OpenFace
{
  std::array<std::int64_t, 3> Points; ///< global ids, ascending
  std::int64_t Cell;

  bool operator<(const OpenFace& other) const
  {
    return std::tie(this->Points, this->Cell) < std::tie(other.Points, other.Cell);
  }
};

/// The components of a rank's own cells. A component is identified by its lowest cell id.
class OwnComponents
{
public:
  explicit OwnComponents(Ids cells)
    : Cells(std::move(cells))
    , Parent(Cells.size())
  {
    sortUnique(this->Cells);
    this->Parent.resize(this->Cells.size());
    std::iota(this->Parent.begin(), this->Parent.end(), std::size_t(0));
  }

  bool has(std::int64_t cell) const
  {
    return std::binary_search(this->Cells.begin(), this->Cells.end(), cell);
  }
  void join(std::int64_t a, std::int64_t b)
  {
    const std::size_t first = this->rootAt(this->placeOf(a));
    const std::size_t second = this->rootAt(this->placeOf(b));
    this->Parent[std::max(first, second)] = std::min(first, second);
  }
  std::int64_t rootOf(std::int64_t cell) { return this->Cells[this->rootAt(this->placeOf(cell))]; }
  const Ids& cells() const { return this->Cells; }

private:
  std::size_t placeOf(std::int64_t cell) const
  {
    return std::size_t(
      std::lower_bound(this->Cells.begin(), this->Cells.end(), cell) - this->Cells.begin());
  }
  std::size_t rootAt(std::size_t place)
  {
    while (this->Parent[place] != place)
    {
      this->Parent[place] = this->Parent[this->Parent[place]];
      place = this->Parent[place];
    }
    return place;
  }

  Ids Cells; ///< global ids, ascending
  std::vector<std::size_t> Parent;
};

bool isHidden(const MeshPart& part, std::int64_t cell)
{
  return part.Mesh.Hidden && part.Mesh.Hidden[cell];
}

OpenFace faceOf(const MeshPart& part, const PartTopology& topology, std::int64_t cell, int opposite)
{
  OpenFace face{ { -1, -1, -1 }, part.cellId(cell) };
  std::size_t count = 0;
  for (int i = 0; i < topology.corners(); ++i)
  {
    i != opposite ? void(face.Points[count++] = part.pointId(topology.corner(cell, i))) : void();
  }
  std::sort(face.Points.begin(), face.Points.end());
  return face;
}

/// Finds connections between components of different ranks: common faces that have only one cell on
/// each of these ranks.
std::vector<Link> linksAcross(
  Communicator& ranks, const std::vector<OpenFace>& open, OwnComponents& own)
{
  std::vector<std::vector<OpenFace>> byRank(std::size_t(ranks.size()));
  for (OpenFace face : open)
  {
    std::uint64_t hash = 0;
    for (const std::int64_t point : face.Points)
    {
      hash = mixBits(hash + std::uint64_t(point));
    }
    face.Cell = own.rootOf(face.Cell);
    byRank[std::size_t(hash % std::uint64_t(ranks.size()))].push_back(face);
  }
  std::vector<OpenFace> faces;
  for (const std::vector<OpenFace>& part : ranks.allToAll(byRank))
  {
    faces.insert(faces.end(), part.begin(), part.end());
  }
  std::sort(faces.begin(), faces.end());
  std::vector<Link> links;
  for (std::size_t i = 1; i < faces.size(); ++i)
  {
    if (faces[i].Points == faces[i - 1].Points && faces[i].Cell != faces[i - 1].Cell)
    {
      links.push_back({ faces[i - 1].Cell, faces[i].Cell });
    }
  }
  sortUnique(links);
  return links;
}

} // namespace

RankComponents componentsOnRanks(Communicator& ranks, const ResidentMesh& mesh)
{
  requireIdsOnRanks(ranks, mesh);
  const auto [first, end] =
    mesh.mesh().Cells > 0 ? piecesOfRank(ranks, mesh) : std::pair<std::size_t, std::size_t>();
  Ids cells;
  const auto forOwnCells = [&, firstPiece = first, endPiece = end](const auto& work)
  {
    forPieceRange(mesh, firstPiece, endPiece,
      [&](const MeshPart& part, const PartTopology& topology)
      {
        for (std::int64_t cell = 0; cell < part.OwnedCells; ++cell)
        {
          pollAt(cell);
          isHidden(part, cell) ? void() : work(part, topology, cell);
        }
      });
  };
  forOwnCells([&](const MeshPart& part, const PartTopology&, std::int64_t cell)
    { cells.push_back(part.cellId(cell)); });
  OwnComponents own(std::move(cells));
  std::vector<OpenFace> open;
  forOwnCells(
    [&](const MeshPart& part, const PartTopology& topology, std::int64_t cell)
    {
      for (int face = 0; face < topology.corners(); ++face)
      {
        bool hasOwn = false;
        bool hasForeign = false; // of another rank
        topology.visitAcross(cell, face,
          [&](std::int64_t other)
          {
            const bool isOwn = own.has(part.cellId(other));
            isOwn ? own.join(part.cellId(cell), part.cellId(other)) : void();
            hasOwn = hasOwn || isOwn;
            hasForeign = hasForeign || !isOwn;
          });
        !hasOwn || hasForeign ? open.push_back(faceOf(part, topology, cell, face)) : void();
      }
    });
  // The lowest component among those connected with each other.
  std::map<std::int64_t, std::int64_t> above;
  const auto rootOf = [&above](std::int64_t component)
  {
    for (auto at = above.find(component); at != above.end(); at = above.find(component))
    {
      component = at->second;
    }
    return component;
  };
  for (const std::vector<Link>& links : ranks.allGather(linksAcross(ranks, open, own)))
  {
    for (const Link& link : links)
    {
      const std::int64_t a = rootOf(link.A);
      const std::int64_t b = rootOf(link.B);
      a != b ? void(above[std::max(a, b)] = std::min(a, b)) : void();
    }
  }
  RankComponents result;
  result.Cells = own.cells();
  Ids roots;
  for (const std::int64_t cell : result.Cells)
  {
    result.OfCells.push_back(rootOf(own.rootOf(cell)));
  }
  roots = result.OfCells;
  sortUnique(roots);
  Ids all;
  for (const Ids& part : ranks.allGather(roots))
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  sortUnique(all);
  result.Sizes.assign(all.size(), 0);
  for (std::int64_t& component : result.OfCells)
  {
    component = std::lower_bound(all.begin(), all.end(), component) - all.begin();
    ++result.Sizes[std::size_t(component)];
  }
  ranks.sum(result.Sizes);
  return result;
}

} // namespace tipp

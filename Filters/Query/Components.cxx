// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Arrays/Concatenated.h"
#include "Arrays/DisjointSets.h"
#include "Arrays/Random.h"
#include "Parallel/Sort.h"
#include "Query/RankAnswer.h"
#include "Resident/ForPieces.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

using Ids = std::vector<std::int64_t>;

/// The components of the mesh in this process.
Components componentsHere(const ResidentMesh& mesh)
{
  std::int64_t count = mesh.mesh().Cells;
  if (!mesh.isStored())
  {
    const ResidentPieces::Lease piece = mesh.pieces().get(0, {});
    for (std::int64_t cell = 0; cell < piece->Part->Mesh.Cells; ++cell)
    {
      count = std::max(count, piece->Part->row(cell) + 1);
    }
  }
  const auto idOf = [&mesh](const MeshPart& part, std::int64_t cell)
  { return mesh.isStored() ? part.cellId(cell) : part.row(cell); };
  std::vector<std::int64_t> parent(std::size_t(count), -1); // -1 for hidden cells
  const auto add = [&parent](std::int64_t cell)
  {
    std::int64_t& p = parent[std::size_t(cell)];
    p = p < 0 ? cell : p;
  };
  forPieceRange(mesh, { 0, mesh.mesh().Pieces.size() }, topologyNeeded(), 1,
    [&](const ResidentPiece& piece)
    {
      const MeshPart& part = *piece.Part;
      const PartTopology& topology = *piece.Topology;
      for (std::int64_t cell = 0; cell < part.Mesh.Cells; ++cell)
      {
        pollAt(cell);
        if (part.isHidden(cell))
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
              joinIn(parent, idOf(part, cell), idOf(part, other));
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

/// Two components that are connected.
using Link = std::array<std::int64_t, 2>;

/// A face with only one cell on a rank: the global ids of its three points, ascending, and of the
/// cell. Unused points are -1.
using OpenFace = std::array<std::int64_t, 4>;

/// The components of some cells. A component is identified by its lowest cell id.
class CellComponents
{
public:
  explicit CellComponents(Ids cells)
    : Cells(sortedUnique(std::move(cells)))
    , Parents(Cells.size())
  {
    std::iota(this->Parents.begin(), this->Parents.end(), std::int64_t(0));
  }

  bool has(std::int64_t cell) const
  {
    return std::binary_search(this->Cells.begin(), this->Cells.end(), cell);
  }
  void join(std::int64_t a, std::int64_t b)
  {
    joinIn(this->Parents, this->indexOf(a), this->indexOf(b));
  }
  std::int64_t rootOf(std::int64_t cell)
  {
    return this->Cells[std::size_t(rootIn(this->Parents, this->indexOf(cell)))];
  }
  const Ids& cells() const { return this->Cells; }

private:
  std::int64_t indexOf(std::int64_t cell) const
  {
    return std::lower_bound(this->Cells.begin(), this->Cells.end(), cell) - this->Cells.begin();
  }

  const Ids Cells; ///< global ids, ascending
  Ids Parents;     ///< indices in Cells
};

OpenFace faceOf(const MeshPart& part, const PartTopology& topology, std::int64_t cell, int opposite)
{
  OpenFace face{ -1, -1, -1, part.cellId(cell) };
  std::size_t count = 0;
  for (int i = 0; i < topology.corners(); ++i)
  {
    if (i != opposite)
    {
      face[count++] = part.pointId(topology.corner(cell, i));
    }
  }
  std::sort(face.begin(), face.end() - 1);
  return face;
}

/// Finds connections between components of different ranks: common faces that have only one cell on
/// each of these ranks.
std::vector<Link> linksAcross(
  Communicator& ranks, const std::vector<OpenFace>& open, CellComponents& own)
{
  std::vector<std::vector<OpenFace>> byRank(std::size_t(ranks.size()));
  for (OpenFace face : open)
  {
    std::uint64_t hash = 0;
    std::for_each(face.begin(), face.end() - 1,
      [&hash](std::int64_t point) { hash = mixBits(hash + std::uint64_t(point)); });
    face[3] = own.rootOf(face[3]);
    byRank[std::size_t(hash % std::uint64_t(ranks.size()))].push_back(face);
  }
  std::vector<OpenFace> faces = concatenated(ranks.allToAll(byRank));
  std::sort(faces.begin(), faces.end());
  std::vector<Link> links;
  for (std::size_t i = 1; i < faces.size(); ++i)
  {
    if (std::equal(faces[i].begin(), faces[i].end() - 1, faces[i - 1].begin()) &&
      faces[i][3] != faces[i - 1][3])
    {
      links.push_back({ faces[i - 1][3], faces[i][3] });
    }
  }
  sortUnique(links);
  return links;
}

} // namespace

Components componentsOf(const ResidentMesh& mesh, Communicator* ranks)
{
  if (!ranks)
  {
    return componentsHere(mesh);
  }
  requireIds(ranks, mesh);
  const std::pair<std::size_t, std::size_t> pieces =
    mesh.mesh().Cells > 0 ? piecesOfRank(ranks, mesh) : std::pair<std::size_t, std::size_t>();
  Ids cells;
  const auto forOwnCells = [&](const auto& work)
  {
    forPieceRange(mesh, pieces, topologyNeeded(), 1,
      [&](const ResidentPiece& piece)
      {
        for (std::int64_t cell = 0; cell < piece.Part->OwnedCells; ++cell)
        {
          pollAt(cell);
          if (!piece.Part->isHidden(cell))
          {
            work(*piece.Part, *piece.Topology, cell);
          }
        }
      });
  };
  forOwnCells([&](const MeshPart& part, const PartTopology&, std::int64_t cell)
    { cells.push_back(part.cellId(cell)); });
  CellComponents own(std::move(cells));
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
            if (isOwn)
            {
              own.join(part.cellId(cell), part.cellId(other));
            }
            hasOwn = hasOwn || isOwn;
            hasForeign = hasForeign || !isOwn;
          });
        if (!hasOwn || hasForeign)
        {
          open.push_back(faceOf(part, topology, cell, face));
        }
      }
    });
  Ids roots;
  for (const std::int64_t cell : own.cells())
  {
    roots.push_back(own.rootOf(cell));
  }
  CellComponents all(concatenated(ranks->allGather(sortedUnique(roots))));
  for (const Link& link : concatenated(ranks->allGather(linksAcross(*ranks, open, own))))
  {
    all.join(link[0], link[1]);
  }
  Ids lowest; // cells of all components
  std::copy_if(all.cells().begin(), all.cells().end(), std::back_inserter(lowest),
    [&all](std::int64_t cell) { return all.rootOf(cell) == cell; });
  Components result;
  result.Cells = own.cells();
  result.Sizes.assign(lowest.size(), 0);
  for (const std::int64_t root : roots)
  {
    const auto found = std::lower_bound(lowest.begin(), lowest.end(), all.rootOf(root));
    result.OfCells.push_back(found - lowest.begin());
    ++result.Sizes[std::size_t(result.OfCells.back())];
  }
  ranks->sum(result.Sizes);
  return result;
}

} // namespace tipp

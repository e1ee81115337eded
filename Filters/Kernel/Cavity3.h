// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCavity3_h
#define tippCavity3_h

#include "Kernel/KernelPredicates.h"
#include "Kernel/OpenList.h"
#include "Kernel/TetrahedronMesh.h"
#include "Predicates/Geometry.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A facet of a cavity's boundary. The first two members are facet indices (see TetrahedronMesh).
struct CavityFacet3
{
  TetrahedronMesh::Index Inside;  ///< of the removed tetrahedron
  TetrahedronMesh::Index Outside; ///< the same facet of the neighbour outside
};

/// Fills a cavity with new tetrahedra. `Access` tells whether other threads use the mesh: the
/// removed tetrahedra are claimed then, and new ones become live once they are linked.
class CavityFilling3
{
public:
  using Index = TetrahedronMesh::Index;

  /// Prepares for a new mesh.
  void restart()
  {
    this->Numbers.clear();
    this->EdgeTable.resize(MostInTable * MostInTable);
  }
  /// Sets the number of vertices.
  void extend(std::size_t count) { this->Numbers.resize(count, NoNumber); }

  /// Makes a tetrahedron of `vertex` and each facet of the boundary: for facet k, at made[-k].
  template <typename Access>
  void fill(
    TetrahedronMesh& mesh, Index vertex, const OpenList<CavityFacet3>& boundary, const Index* made)
  {
    // A triangulated sphere of n vertices has 2 n - 4 facets.
    if (boundary.size() <= 2 * MostInTable - 4)
    {
      this->makeByEdges<Access>(mesh, vertex, boundary, made);
    }
    else
    {
      makeCells<Access>(mesh, vertex, boundary, made);
      linkAround<Access>(mesh, boundary, made);
    }
  }

private:
  using Facets = OpenList<CavityFacet3>;
  /// Of a facet: the indices of its edges in EdgeTable, in the other direction; the last is unused.
  using Edges = std::array<std::uint16_t, 4>;

  /// If the cavity's boundary has at most this many vertices, a table of its edges gives the
  /// neighbours.
  static constexpr std::size_t MostInTable = 64;
  static constexpr std::uint8_t NoNumber = 0xff;

  /// Makes a tetrahedron for each facet of the boundary: a copy of the removed one, whose corner
  /// opposite to the facet is replaced by `vertex`.
  template <typename Access>
  static void makeCells(
    TetrahedronMesh& mesh, Index vertex, const Facets& boundary, const Index* made)
  {
    Index* const slots = mesh.slots();
    for (const CavityFacet3& facet : boundary)
    {
      const Index cell = *made--;
      const Index old = TetrahedronMesh::cellOf(facet.Inside);
      const Index i = facet.Inside & 3;
      for (Index corner = 0; corner < 4; ++corner)
      {
        Access::store(slots[cell + corner], slots[old + corner]);
      }
      Access::store(slots[cell + i], vertex);
      Access::store(slots[cell + i + 4], facet.Outside);
      Access::store(slots[facet.Outside + 4], cell + i);
    }
  }

  /// Makes and links tetrahedra by a table of the boundary's edges: two of them are neighbours if
  /// their facets share an edge, which they traverse in opposite directions. `vertex` becomes their
  /// last corner, so that all positions but those in the removed tetrahedron are constants. If one
  /// of the facet's corners is at infinity, FacetCorners has it first.
  template <typename Access>
  void makeByEdges(TetrahedronMesh& mesh, Index vertex, const Facets& boundary, const Index* made)
  {
    // Local copies, since a store through a pointer to bytes might change any member.
    Index* const slots = mesh.slots();
    std::uint8_t* const known = this->Numbers.data();
    Index* const table = this->EdgeTable.data();
    const CavityFacet3* const facets = boundary.begin();
    const std::size_t size = boundary.size();
    std::array<Index, MostInTable + 1> vertices;
    unsigned count = 0;
    std::array<Edges, 2 * MostInTable> edges;
    const auto numberOf = [&](Index v)
    {
      vertices[count] = v;
      // NoNumber is larger than any number.
      const unsigned number = std::min<unsigned>(known[v], count);
      known[v] = static_cast<std::uint8_t>(number);
      count += number == count ? 1 : 0;
      return number;
    };
    for (std::size_t k = 0; k < size; ++k)
    {
      const Index inside = facets[k].Inside;
      const Index outside = facets[k].Outside;
      const Index* const old = slots + TetrahedronMesh::cellOf(inside);
      const Index* const f = TetrahedronMesh::FacetCorners[inside & 3];
      const Index cell = made[-std::ptrdiff_t(k)];
      const Index a = old[f[0]];
      const Index b = old[f[2]];
      const Index c = old[f[1]];
      Access::store(slots[cell], a);
      Access::store(slots[cell + 1], b);
      Access::store(slots[cell + 2], c);
      Access::store(slots[cell + 3], vertex);
      Access::store(slots[cell + 7], outside);
      Access::store(slots[outside + 4], cell + 3);
      const unsigned i = numberOf(a);
      const unsigned j = numberOf(b);
      const unsigned l = numberOf(c);
      table[j * MostInTable + l] = cell;
      table[l * MostInTable + i] = cell + 1;
      table[i * MostInTable + j] = cell + 2;
      edges[k] = { std::uint16_t(l * MostInTable + j), std::uint16_t(i * MostInTable + l),
        std::uint16_t(j * MostInTable + i), 0 };
    }
    this->linkByEdges<Access>(mesh, made, edges.data(), size);
    for (unsigned i = 0; i < count; ++i)
    {
      known[vertices[i]] = NoNumber;
    }
  }

  /// Links the new tetrahedra; edges[k]: where the neighbours of made[-k] are in the table.
  template <typename Access>
  void linkByEdges(
    TetrahedronMesh& mesh, const Index* made, const Edges* edges, std::size_t size) const
  {
    Index* const slots = mesh.slots();
    std::uint8_t* const marks = mesh.marks();
    const Index* const table = this->EdgeTable.data();
    for (std::size_t k = 0; k < size; ++k)
    {
      const Index cell = made[-std::ptrdiff_t(k)];
      Access::store(slots[cell + 4], table[edges[k][0]]);
      Access::store(slots[cell + 5], table[edges[k][1]]);
      Access::store(slots[cell + 6], table[edges[k][2]]);
      Access::setMark(marks[cell / 8], TetrahedronMesh::Live);
    }
  }

  /// Does the same for any number of vertices: starts at a facet of a new tetrahedron, and goes
  /// around its edge through removed tetrahedra to the neighbour's facet.
  template <typename Access>
  [[gnu::noinline]] static void linkAround(
    TetrahedronMesh& mesh, const Facets& boundary, const Index* made)
  {
    Index* const slots = mesh.slots();
    std::uint8_t* const marks = mesh.marks();
    // Let each removed tetrahedron refer to the new one on its facet.
    for (std::size_t k = 0; k < boundary.size(); ++k)
    {
      const CavityFacet3 facet = boundary[k];
      const Index fresh = made[-std::ptrdiff_t(k)];
      Access::store(slots[facet.Inside + 4], fresh + (facet.Inside & 3));
      Access::setMark(marks[fresh / 8], TetrahedronMesh::New);
    }
    for (std::size_t k = 0; k < boundary.size(); ++k)
    {
      const CavityFacet3 facet = boundary[k];
      const Index fresh = made[-std::ptrdiff_t(k)];
      for (Index j = 0; j < 4; ++j)
      {
        if (j == (facet.Inside & 3))
        {
          continue;
        }
        Index cell = TetrahedronMesh::cellOf(facet.Inside);
        Index before = facet.Inside & 3; // opposite to the facet that was crossed last
        Index after = j;                 // opposite to the facet to cross next
        Index across = slots[cell + after + 4];
        while (Access::markOf(marks[across / 8]) != TetrahedronMesh::New)
        {
          const Index carried = slots[cell + before];
          cell = TetrahedronMesh::cellOf(across);
          before = across & 3;
          after = TetrahedronMesh::positionOf(slots + cell, carried);
          across = slots[cell + after + 4];
        }
        Access::store(slots[fresh + j + 4], TetrahedronMesh::cellOf(across) + before);
      }
    }
    for (std::size_t k = 0; k < boundary.size(); ++k)
    {
      Access::setMark(marks[made[-std::ptrdiff_t(k)] / 8], TetrahedronMesh::Live);
    }
  }

  std::vector<std::uint8_t> Numbers; ///< by vertex: its number on the boundary, or NoNumber
  /// By the numbers of two vertices: the facet of the new tetrahedron at this edge.
  std::vector<Index> EdgeTable;
};

/// Inserts vertices into a TetrahedronMesh whose vertex 0 is at infinity. In an infinite
/// tetrahedron, vertex 0 is always the first corner. A vertex is an index into the points given to
/// restart(); a tetrahedron is the index of its first slot. Not thread-safe: each thread has its
/// own object.
class Cavity3
{
public:
  using Index = TetrahedronMesh::Index;

  /// A vertex that was not inserted, and the earlier vertex with the same coordinates.
  struct Coincidence
  {
    Index Vertex;
    Index Representative;
  };

  /// Prepares for a new mesh. `points` are not copied; `count` includes the vertex at infinity,
  /// whose coordinates must be NaN. The number in memory behind the last point is read, but not
  /// used.
  void restart(const Point3* points, std::size_t count);

  /// Continues with the same mesh and more points: `points` begin with those so far.
  void extend(const Point3* points, std::size_t count);

  /// Inserts the vertices [first, end) one after the other. Appends to `found` those that have the
  /// coordinates of an earlier vertex. Throws std::length_error if there are too many tetrahedra.
  void insert(TetrahedronMesh& mesh, Index first, Index end, std::vector<Coincidence>& found);

  /// Sets the tetrahedron where the walk to the next vertex starts; it must be finite.
  void continueAt(Index start) { this->Recent = start; }

  /// @name Inserting together with other threads
  ///@{
  /// The largest number of threads that can share a mesh.
  static constexpr int MostSharing = 250;
  /// Prepares for insertShared(). `thread`: the number of this thread among those that share the
  /// mesh. `end`: of all threads: one past the last tetrahedron, in slots.
  void share(std::uint8_t thread, std::atomic<std::uint64_t>& end);
  /// Prepares for insertInRegion(). `regions`: the region of each vertex, other than `region` for
  /// the vertex at infinity.
  void shareRegions(
    const std::uint8_t* regions, std::uint8_t region, std::atomic<std::uint64_t>& end);
  /// Inserts the vertices [begin, end), which are in the region, while other threads insert those
  /// of other regions. continueAt() must have set a tetrahedron in the region. Appends to `left`
  /// those that it does not insert, because the cavity is not inside the region or because the mesh
  /// has no memory left.
  void insertInRegion(TetrahedronMesh& mesh, const Index* begin, const Index* end,
    std::vector<Index>& left, std::vector<Coincidence>& found);
  /// Inserts the vertices [begin, end) while other threads insert others. Appends to `left` those
  /// that it does not insert, because another thread is at work there or because the mesh has no
  /// memory left.
  void insertShared(TetrahedronMesh& mesh, const Index* begin, const Index* end,
    std::vector<Index>& left, std::vector<Coincidence>& found);
  ///@}

private:
  using Links = std::array<Index, 4>;

  /// Where a walk has ended: a tetrahedron that is in conflict with the point, or has a vertex
  /// there.
  struct Location
  {
    Index Cell;                   ///< NoCell: the walk was given up
    Index EqualTo;                ///< the vertex with the same coordinates; 0: none
    std::array<Index, 4> Corners; ///< as the walk has seen them
  };

  /// A tetrahedron of the cavity whose neighbours have been tested against the point. Bit i of the
  /// masks is for neighbour i.
  struct TestedCell
  {
    Index Cell;
    Links Across;     ///< the facets of the neighbours
    unsigned Certain; ///< whether Inside is known
    unsigned Inside;  ///< whether the point is in the neighbour's sphere
  };

  void renewStart(const TetrahedronMesh& mesh);
  template <typename Access>
  void insertEach(TetrahedronMesh& mesh, const Index* begin, const Index* end,
    std::vector<Index>& left, std::vector<Coincidence>& found);
  bool isOwn(Index vertex) const { return vertex == 0 || this->Regions[vertex] == this->Region; }
  template <typename Access>
  bool insertOne(TetrahedronMesh& mesh, Index vertex, std::vector<Coincidence>& found);
  unsigned facetsBefore(const Index* v, const Point3& p, unsigned& inside) const;
  template <typename Access>
  Location locate(const TetrahedronMesh& mesh, const Point3& p);
  template <typename Access>
  bool readLinks(const TetrahedronMesh& mesh, Index cell, Links& across) const;
  template <typename Access>
  bool claimFirst(TetrahedronMesh& mesh, const Point3& p, const Location& at);
  template <typename Access>
  bool testInfinite(TetrahedronMesh& mesh, Index cell, const Point3& p, bool& isIn);
  void testNeighbours(const Index* slots, const Point3& p, TestedCell& tested) const;
  template <typename Access>
  bool testCell(
    const TetrahedronMesh& mesh, std::size_t k, const Point3& p, TestedCell& tested) const;
  template <typename Access>
  bool decide(TetrahedronMesh& mesh, unsigned uncertain, const Point3& p, TestedCell& tested);
  bool areInRegion(const Index* slots, unsigned in, const Links& across) const;
  template <typename Access>
  bool addTested(TetrahedronMesh& mesh, const Point3& p, TestedCell& tested);
  template <typename Access>
  bool findConflicts(TetrahedronMesh& mesh, const Point3& p);
  template <typename Access>
  void retriangulate(TetrahedronMesh& mesh, Index vertex);
  template <typename Access>
  void setMarks(TetrahedronMesh& mesh, std::uint8_t mark) const;
  void makeRoom(TetrahedronMesh& mesh);
  bool takeRoom(TetrahedronMesh& mesh);

  static constexpr Index NoCell = ~Index(0);

  const Point3* Points = nullptr;
  KernelPredicates3 Predicates;
  CavityFilling3 Filling;
  std::uint8_t Claim = TetrahedronMesh::InConflict; ///< the mark of tetrahedra to be removed
  std::atomic<std::uint64_t>* SharedEnd = nullptr;  ///< see share()
  const std::uint8_t* Regions = nullptr;            ///< see shareRegions()
  std::uint8_t Region = 0;
  Index Recent = 0; ///< a finite tetrahedron near the last inserted vertex
  OpenList<Index> Removed;
  OpenList<CavityFacet3> Boundary;
  std::vector<Index> Free; ///< unused tetrahedra below the mesh's end
};

} // namespace tipp

#endif

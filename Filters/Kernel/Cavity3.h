// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCavity3_h
#define tippCavity3_h

#include "Kernel/KernelPredicates.h"
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
  TetrahedronMesh::Index Made;    ///< the new tetrahedron on this facet
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

  /// Makes a tetrahedron of `vertex` and each facet of the boundary. Takes their indices from the
  /// end of `free`, which must suffice.
  template <typename Access>
  void fill(TetrahedronMesh& mesh, Index vertex, std::vector<CavityFacet3>& boundary,
    std::vector<Index>& free)
  {
    this->makeCells<Access>(mesh, vertex, boundary, free);
    if (!this->linkByEdges<Access>(mesh, boundary))
    {
      this->linkAround<Access>(mesh, boundary);
    }
  }

private:
  using Facets = std::vector<CavityFacet3>;

  /// If the cavity's boundary has at most this many vertices, a table of its edges gives the
  /// neighbours.
  static constexpr std::size_t MostInTable = 64;
  static constexpr std::uint8_t NoNumber = 0xff;

  /// Makes a tetrahedron for each facet of the boundary: a copy of the removed one, whose corner
  /// opposite to the facet is replaced by `vertex`.
  template <typename Access>
  void makeCells(TetrahedronMesh& mesh, Index vertex, Facets& boundary, std::vector<Index>& free)
  {
    Index* const slots = mesh.slots();
    const Index* next = free.data() + free.size();
    for (CavityFacet3& facet : boundary)
    {
      const Index old = TetrahedronMesh::cellOf(facet.Inside);
      const Index i = facet.Inside & 3;
      const Index made = *--next;
      for (Index corner = 0; corner < 4; ++corner)
      {
        Access::store(slots[made + corner], slots[old + corner]);
      }
      Access::store(slots[made + i], vertex);
      Access::store(slots[made + i + 4], facet.Outside);
      Access::store(slots[facet.Outside + 4], made + i);
      facet.Made = made;
    }
    free.resize(free.size() - boundary.size());
  }

  /// Links new tetrahedra by a table of the boundary's edges: two of them are neighbours if their
  /// facets share an edge, which they traverse in opposite directions. Returns false if the
  /// boundary has too many vertices for the table.
  template <typename Access>
  bool linkByEdges(TetrahedronMesh& mesh, const Facets& boundary)
  {
    // A triangulated sphere of n vertices has 2 n - 4 facets.
    if (boundary.size() > 2 * MostInTable - 4)
    {
      return false;
    }
    // Local copies, since a store through a pointer to bytes might change any member.
    Index* const slots = mesh.slots();
    std::uint8_t* const marks = mesh.marks();
    std::uint8_t* const known = this->Numbers.data();
    Index* const table = this->EdgeTable.data();
    const CavityFacet3* const facets = boundary.data();
    const std::size_t size = boundary.size();
    std::array<Index, MostInTable + 1> vertices;
    unsigned count = 0;
    std::array<std::array<std::uint16_t, 3>, 2 * MostInTable> edges;
    for (std::size_t k = 0; k < size; ++k)
    {
      const Index made = facets[k].Made;
      const Index* const f = TetrahedronMesh::FacetCorners[facets[k].Inside & 3];
      std::array<unsigned, 3> numbers;
      for (std::size_t i = 0; i < 3; ++i)
      {
        const Index v = slots[made + f[i]];
        const bool isNew = known[v] == NoNumber;
        vertices[count] = v;
        numbers[i] = isNew ? count : known[v];
        known[v] = static_cast<std::uint8_t>(numbers[i]);
        count += isNew ? 1 : 0;
      }
      for (std::size_t i = 0; i < 3; ++i)
      {
        const unsigned from = numbers[(i + 1) % 3];
        const unsigned to = numbers[(i + 2) % 3];
        table[from * MostInTable + to] = made + f[i];
        edges[k][i] = static_cast<std::uint16_t>(to * MostInTable + from);
      }
    }
    for (std::size_t k = 0; k < size; ++k)
    {
      const Index made = facets[k].Made;
      const Index* const f = TetrahedronMesh::FacetCorners[facets[k].Inside & 3];
      for (std::size_t i = 0; i < 3; ++i)
      {
        Access::store(slots[made + f[i] + 4], table[edges[k][i]]);
      }
      Access::setMark(marks[made / 8], TetrahedronMesh::Live);
    }
    for (unsigned i = 0; i < count; ++i)
    {
      known[vertices[i]] = NoNumber;
    }
    return true;
  }

  /// Does the same for any number of vertices: starts at a facet of a new tetrahedron, and goes
  /// around its edge through removed tetrahedra to the neighbour's facet.
  template <typename Access>
  [[gnu::noinline]] void linkAround(TetrahedronMesh& mesh, const Facets& boundary)
  {
    Index* const slots = mesh.slots();
    std::uint8_t* const marks = mesh.marks();
    // Let each removed tetrahedron refer to the new one on its facet.
    for (const CavityFacet3& facet : boundary)
    {
      Access::store(slots[facet.Inside + 4], facet.Made + (facet.Inside & 3));
      Access::setMark(marks[facet.Made / 8], TetrahedronMesh::New);
    }
    for (const CavityFacet3& facet : boundary)
    {
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
        Access::store(slots[facet.Made + j + 4], TetrahedronMesh::cellOf(across) + before);
      }
    }
    for (const CavityFacet3& facet : boundary)
    {
      Access::setMark(marks[facet.Made / 8], TetrahedronMesh::Live);
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

  /// Prepares for a new mesh. `points` are not copied; `count` includes the vertex at infinity.
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

  void renewStart(const TetrahedronMesh& mesh);
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
  template <typename Access>
  bool findConflicts(TetrahedronMesh& mesh, const Point3& p);
  template <typename Access>
  void retriangulate(TetrahedronMesh& mesh, Index vertex);
  template <typename Access>
  void setMarks(TetrahedronMesh& mesh, std::uint8_t mark) const;
  void makeRoom(TetrahedronMesh& mesh);
  bool takeRoom(TetrahedronMesh& mesh);
  unsigned conflictsAcross(
    const Index* slots, Index cell, const Links& across, const Point3& p, unsigned& certain);

  static constexpr Index NoCell = ~Index(0);

  const Point3* Points = nullptr;
  KernelPredicates3 Predicates;
  CavityFilling3 Filling;
  std::uint8_t Claim = TetrahedronMesh::InConflict; ///< the mark of tetrahedra to be removed
  std::atomic<std::uint64_t>* SharedEnd = nullptr;  ///< see share()
  Index Recent = 0; ///< a finite tetrahedron near the last inserted vertex
  std::vector<Index> Removed;
  std::vector<CavityFacet3> Boundary;
  std::vector<Index> Free; ///< unused tetrahedra below the mesh's end
};

} // namespace tipp

#endif

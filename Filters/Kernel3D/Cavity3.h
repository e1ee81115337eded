// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCavity3_h
#define tippCavity3_h

#include "Kernel3D/KernelPredicates3.h"
#include "Kernel3D/TetrahedronMesh.h"
#include "Predicates/Points.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// The part of a mesh that one of several threads may change: the tetrahedra whose finite vertices
/// are all owned by the thread. Three vertices of such a tetrahedron, or two and the infinite one,
/// are also vertices of its neighbour. So no other thread changes the neighbour, and no thread
/// reads data that another one writes.
struct Territory3
{
  const std::uint8_t* Owners;                        ///< by vertex: the owning thread
  std::uint8_t Own;                                  ///< this thread's number in Owners
  const std::vector<TetrahedronMesh::Index>* Starts; ///< some finite tetrahedra of the territory
  std::atomic<std::uint64_t>* End; ///< of all threads: one past the last tetrahedron, in slots
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
  /// Sets the territory for insertWithin(). Its Starts must not be empty.
  void enter(const Territory3& territory)
  {
    this->Within = territory;
    this->NextStart = 0;
    this->Recent = territory.Starts->front();
  }

  /// Inserts the vertices [begin, end) while other threads do so in their territories. Appends to
  /// `left` those that it cannot insert, because the walk to them or their cavity leaves the
  /// territory, or because the mesh has no memory left.
  void insertWithin(TetrahedronMesh& mesh, const Index* begin, const Index* end,
    std::vector<Index>& left, std::vector<Coincidence>& found);

private:
  /// A facet of the cavity's boundary. The first two members are facet indices (see
  /// TetrahedronMesh).
  struct Facet
  {
    Index Inside;  ///< of the removed tetrahedron
    Index Outside; ///< the same facet of the neighbour outside
    Index Made;    ///< the new tetrahedron on this facet
  };

  /// Where a point is: in a tetrahedron that it is in conflict with, or at a vertex.
  struct Location
  {
    Index Cell;    ///< NoCell: the walk left the territory
    Index EqualTo; ///< the vertex with the same coordinates; 0: none
  };

  void insertAll(TetrahedronMesh& mesh, Index first, Index end, std::vector<Coincidence>& found);
  bool insertOne(TetrahedronMesh& mesh, Index vertex, std::vector<Coincidence>& found);
  /// `IsShared`: other threads change the mesh, so stay within the territory.
  template <bool IsShared>
  Location locate(const TetrahedronMesh& mesh, const Point3& p);
  template <bool IsShared>
  bool findConflicts(TetrahedronMesh& mesh, const Point3& p, Index found);
  void retriangulate(TetrahedronMesh& mesh, Index vertex);
  bool isOwn(const Index* v) const;
  void makeRoom(TetrahedronMesh& mesh);
  bool takeRoom(TetrahedronMesh& mesh);
  void moveOn(const TetrahedronMesh& mesh);
  unsigned conflictsAcross(const Index* slots, Index cell, const Point3& p, unsigned& certain);
  void makeCells(TetrahedronMesh& mesh, Index vertex);
  bool linkByEdges(TetrahedronMesh& mesh);
  void linkAround(TetrahedronMesh& mesh);

  /// If the cavity's boundary has at most this many vertices, a table of its edges gives the
  /// neighbours.
  static constexpr std::size_t MostInTable = 64;
  static constexpr std::uint8_t NoNumber = 0xff;
  static constexpr Index NoCell = ~Index(0);

  const Point3* Points = nullptr;
  KernelPredicates3 Predicates;
  Territory3 Within = {};    ///< the territory of insertWithin()
  std::size_t NextStart = 0; ///< index of the next one of its Starts
  std::size_t Failures = 0;  ///< consecutive vertices that could not be inserted
  Index Recent = 0;          ///< a finite tetrahedron near the last inserted vertex
  std::vector<Index> Removed;
  std::vector<Facet> Boundary;
  std::vector<Index> Free;           ///< unused tetrahedra below the mesh's end
  std::vector<std::uint8_t> Numbers; ///< by vertex: its number on the boundary, or NoNumber
  /// By the numbers of two vertices: the facet of the new tetrahedron at this edge.
  std::vector<Index> EdgeTable;
};

} // namespace tipp

#endif

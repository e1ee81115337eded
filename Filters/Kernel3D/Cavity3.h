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
/// are all its own. A neighbour of such a one has three of these vertices, or two and the infinite
/// one, so that no other thread changes it either: threads read nothing that another one writes.
struct Territory3
{
  const std::uint8_t* Owners; ///< by vertex: the thread that owns it
  std::uint8_t Own;
  const std::vector<TetrahedronMesh::Index>* Starts; ///< some of its finite tetrahedra
  std::atomic<std::uint64_t>* End; ///< one past the last tetrahedron of all threads, in slots
};

/// Inserts vertices into a mesh whose vertex 0 is at infinity. Of a tetrahedron at that vertex it
/// is the first corner, always.
class Cavity3
{
public:
  using Index = TetrahedronMesh::Index;

  /// A vertex that was not inserted, and the one with the same coordinates.
  struct Coincidence
  {
    Index Vertex;
    Index Representative;
  };

  /// Begins with a new mesh of `count` points, the vertex at infinity among them.
  void restart(const Point3* points, std::size_t count);

  /// Inserts the vertices [first, end) one after the other. Appends to `found` those at the
  /// position of an earlier one.
  void insert(TetrahedronMesh& mesh, Index first, Index end, std::vector<Coincidence>& found);

  /// Continues at `start`, a finite tetrahedron.
  void continueAt(Index start) { this->Recent = start; }
  /// Enters a territory that has Starts, for insertWithin().
  void enter(const Territory3& territory)
  {
    this->Within = territory;
    this->NextStart = 0;
    this->Recent = territory.Starts->front();
  }

  /// Inserts vertices while other threads do so in territories of their own. Appends to `left`
  /// those that it cannot insert: the walk to them or their cavity leaves the territory, or the
  /// mesh has no memory left.
  void insertWithin(TetrahedronMesh& mesh, const Index* begin, const Index* end,
    std::vector<Index>& left, std::vector<Coincidence>& found);

private:
  /// A facet of the cavity's boundary.
  struct Facet
  {
    Index Inside;  ///< of the tetrahedron that is removed
    Index Outside; ///< of its neighbour
    Index Made;    ///< the new tetrahedron on it
  };

  /// Where a point lies: in a tetrahedron in conflict with it, or at a vertex.
  struct Location
  {
    Index Cell;    ///< NoCell: outside of the territory
    Index EqualTo; ///< the vertex with the same coordinates, or 0
  };

  void insertAll(TetrahedronMesh& mesh, Index first, Index end, std::vector<Coincidence>& found);
  bool insertOne(TetrahedronMesh& mesh, Index vertex, std::vector<Coincidence>& found);
  /// `IsShared`: only within the territory.
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

  /// Up to this many vertices on the cavity's boundary, neighbours are found in a table of its
  /// edges.
  static constexpr std::size_t MostInTable = 64;
  static constexpr std::uint8_t NoNumber = 0xff;
  static constexpr Index NoCell = ~Index(0);

  const Point3* Points = nullptr;
  KernelPredicates3 Predicates;
  Territory3 Within = {};    ///< of insertWithin()
  std::size_t NextStart = 0; ///< of its Starts
  std::size_t Failures = 0;  ///< vertices in a row that it could not insert
  Index Recent = 0;          ///< a finite tetrahedron near the last insertion
  std::vector<Index> Removed;
  std::vector<Facet> Boundary;
  std::vector<Index> Free;           ///< unused indices below the mesh's end
  std::vector<std::uint8_t> Numbers; ///< by vertex: its number on the boundary, or NoNumber
  std::vector<Index> EdgeTable;      ///< by two numbers: the facet of the new tetrahedron there
};

} // namespace tipp

#endif

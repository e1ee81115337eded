// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCavity3_h
#define tippCavity3_h

#include "Kernel3D/KernelPredicates3.h"
#include "Kernel3D/TetrahedronMesh.h"
#include "Predicates/Points.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

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
    Index Cell;
    Index EqualTo; ///< the vertex with the same coordinates, or 0
  };

  void insertAll(TetrahedronMesh& mesh, Index first, Index end, std::vector<Coincidence>& found);
  Location locate(const TetrahedronMesh& mesh, const Point3& p);
  void retriangulate(TetrahedronMesh& mesh, Index vertex, Index found);
  void findConflicts(TetrahedronMesh& mesh, const Point3& p, Index found);
  unsigned conflictsAcross(const Index* slots, Index cell, const Point3& p, unsigned& certain);
  void makeCells(TetrahedronMesh& mesh, Index vertex);
  bool linkByEdges(TetrahedronMesh& mesh);
  void linkAround(TetrahedronMesh& mesh);

  /// Up to this many vertices on the cavity's boundary, neighbours are found in a table of its
  /// edges.
  static constexpr std::size_t MostInTable = 64;
  static constexpr std::uint8_t NoNumber = 0xff;

  const Point3* Points = nullptr;
  KernelPredicates3 Predicates;
  Index Recent = 0; ///< a finite tetrahedron near the last insertion
  std::vector<Index> Removed;
  std::vector<Facet> Boundary;
  std::vector<Index> Free;           ///< unused indices below the mesh's end
  std::vector<std::uint8_t> Numbers; ///< by vertex: its number on the boundary, or NoNumber
  std::vector<Index> EdgeTable;      ///< by two numbers: the facet of the new tetrahedron there
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCavity3_h
#define tippCavity3_h

#include "Kernel3D/CavityFilling3.h"
#include "Kernel3D/KernelPredicates3.h"
#include "Kernel3D/TetrahedronMesh.h"
#include "Predicates/Points.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

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

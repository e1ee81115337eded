// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParallelInsertion3_h
#define tippParallelInsertion3_h

#include "Kernel3D/Cavity3.h"
#include "Kernel3D/TetrahedronMesh.h"
#include "Predicates/Points.h"
#include "Triangulation3D/Tiling3.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Inserts vertices into one mesh by several threads without locks (Marot, Pellerin, Remacle, One
/// machine, one minute, three billion tetrahedra, 2019). Space is divided into tiles, each thread
/// owns the vertices in one of them, and changes only tetrahedra all of whose vertices it owns. The
/// vertices that cannot be inserted so are tried again with other tiles, and the last ones are
/// inserted by the calling thread. Which vertex is inserted when depends on the number of threads;
/// the set of tetrahedra does not, for the kernel's ties are decided by coordinates.
class ParallelInsertion3
{
public:
  using Index = TetrahedronMesh::Index;
  /// As DelaunayKernel3::Monitor; called by the calling thread.
  using Monitor = std::function<bool(std::size_t)>;

  static constexpr Index Few = 1 << 14; ///< fewer vertices are not worth threads

  /// All must outlive this. `count` of `points` includes the vertex at infinity. `first`: inserts
  /// what the threads cannot.
  ParallelInsertion3(
    TetrahedronMesh& mesh, const Point3* points, std::size_t count, Cavity3& first);

  /// Inserts the vertices [first, end). Appends to `found` those at the position of an earlier one.
  /// Returns false if `proceed` did.
  bool insert(Index first, Index end, int threads, const Monitor& proceed,
    std::vector<Cavity3::Coincidence>& found);

private:
  /// What one thread works with.
  struct Worker
  {
    Cavity3 Opened;
    std::vector<Index> Starts; ///< some tetrahedra of its territory
    std::vector<Index> Mine;   ///< vertices to insert
    std::vector<Index> Left;   ///< of these, those that are left
    std::vector<Cavity3::Coincidence> Found;
  };

  void insertTogether(Index end, int threads, const Monitor& proceed);
  void setOwners(const Tiling3& tiling, Index end, int threads);
  void findStarts(std::size_t tiles);
  void work(std::size_t tile, bool isCaller, const Monitor& proceed);
  bool insertLeft(const Monitor& proceed, std::vector<Cavity3::Coincidence>& found);

  TetrahedronMesh& Mesh;
  const Point3* const Points;
  const std::size_t Count;
  Cavity3& First;
  std::vector<Worker> Workers;
  std::vector<std::uint8_t> Owners; ///< by vertex: a tile
  std::vector<Index> Waiting;       ///< to be inserted; ascending
  std::atomic<std::uint64_t> End{ 0 };
  std::atomic<std::size_t> Done{ 0 };
  std::atomic<bool> IsStopped{ false };
};

} // namespace tipp

#endif

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

/// Inserts vertices into one mesh with several threads and without locks (Marot, Pellerin, Remacle:
/// One machine, one minute, three billion tetrahedra, 2019). Space is divided into tiles. Each
/// thread owns the vertices in one tile, and changes only tetrahedra whose finite vertices it all
/// owns. Vertices that cannot be inserted this way are tried again with other tiles; the calling
/// thread inserts the last ones. The number of threads changes the order of insertion but not the
/// set of tetrahedra, because ties are broken by coordinates.
class ParallelInsertion3
{
public:
  using Index = TetrahedronMesh::Index;
  /// As DelaunayKernel3::Monitor. Only the calling thread calls it.
  using Monitor = std::function<bool(std::size_t)>;

  static constexpr Index Few = 1 << 14; ///< fewer vertices are inserted by one thread

  /// `mesh`, `points` and `first` must outlive this object. `count` is the number of points,
  /// including the vertex at infinity. `first` inserts the vertices that the threads cannot insert.
  ParallelInsertion3(
    TetrahedronMesh& mesh, const Point3* points, std::size_t count, Cavity3& first);

  /// Inserts the vertices [first, end). Appends to `found` those that have the coordinates of an
  /// earlier vertex. Returns false if `proceed` did. Throws std::length_error if there are too many
  /// tetrahedra.
  bool insert(Index first, Index end, int threads, const Monitor& proceed,
    std::vector<Cavity3::Coincidence>& found);

private:
  /// The data of one thread.
  struct Worker
  {
    Cavity3 Opened;
    std::vector<Index> Starts; ///< some tetrahedra of the thread's territory
    std::vector<Index> Mine;   ///< vertices to insert
    std::vector<Index> Left;   ///< vertices of Mine that were not inserted
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
  std::vector<std::uint8_t> Owners; ///< by vertex: its tile
  std::vector<Index> Waiting;       ///< vertices that are still to be inserted; ascending
  std::atomic<std::uint64_t> End{ 0 };
  std::atomic<std::size_t> Done{ 0 };
  std::atomic<bool> IsStopped{ false };
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParallelInsertion3_h
#define tippParallelInsertion3_h

#include "Kernel3D/Cavity3.h"
#include "Kernel3D/TetrahedronMesh.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Inserts vertices into one mesh with several threads and without locks. The vertices are along a
/// curve, and each thread has a part of it. A thread claims the tetrahedra that it removes, see
/// SharedAccess3. If another thread is at work there, the vertex is tried again later. This is
/// rare, because the threads are far apart on the curve. The number of threads changes the order of
/// insertion but not the set of tetrahedra, because ties are broken by coordinates.
class ParallelInsertion3
{
public:
  using Index = TetrahedronMesh::Index;
  /// As DelaunayKernel3::Monitor. Only the calling thread calls it.
  using Monitor = std::function<bool(std::size_t)>;

  static constexpr Index Few = 1 << 12; ///< fewer vertices are inserted by one thread

  /// `mesh`, `points` and `first` must outlive this object. `count` is the number of points,
  /// including the vertex at infinity. `first` inserts the vertices that the threads leave.
  ParallelInsertion3(
    TetrahedronMesh& mesh, const Point3* points, std::size_t count, Cavity3& first, int threads);

  /// Inserts the vertices [first, end). Appends to `found` those that have the coordinates of an
  /// earlier vertex. Returns false if `proceed` did. Throws std::length_error if there are too many
  /// tetrahedra.
  bool insert(
    Index first, Index end, const Monitor& proceed, std::vector<Cavity3::Coincidence>& found);

private:
  /// The data of one thread.
  struct Worker
  {
    Cavity3 Opened;
    std::vector<Index> Left; ///< vertices that were not inserted
    std::vector<Cavity3::Coincidence> Found;
  };

  /// The first vertex of the worker's part of Waiting.
  std::size_t beginOf(std::size_t worker) const
  {
    return this->Waiting.size() * worker / this->Workers.size();
  }
  Index startOf(std::size_t worker) const;
  void reserveFor(std::size_t count);
  void insertTogether(const Monitor& proceed);
  void work(std::size_t number, bool isCaller, const Monitor& proceed);
  bool insertLeft(const Monitor& proceed, std::vector<Cavity3::Coincidence>& found);

  TetrahedronMesh& Mesh;
  Cavity3& First;
  std::vector<Worker> Workers;
  std::vector<std::atomic<std::size_t>> Next; ///< by worker: in Waiting, the first vertex to take
  std::vector<Index> Waiting;                 ///< vertices that are still to be inserted; ascending
  std::atomic<std::uint64_t> End{ 0 };
  std::atomic<std::size_t> Done{ 0 };
  std::atomic<bool> IsStopped{ false };
};

} // namespace tipp

#endif

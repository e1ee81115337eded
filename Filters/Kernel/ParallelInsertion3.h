// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippParallelInsertion3_h
#define tippParallelInsertion3_h

#include "Kernel/Cavity3.h"
#include "Kernel/TetrahedronMesh.h"
#include "Predicates/Geometry.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Inserts vertices into one mesh with several threads and without locks. The number of threads
/// changes the order of insertion but not the set of tetrahedra, because ties are broken by
/// coordinates.
///
/// At first each thread has a region of space (VertexRegions), and inserts those of its vertices
/// whose cavities are inside: see RegionAccess3. When the first thread has finished, the others
/// stop. The vertices that are left, those near the regions' borders among them, are shared out
/// along a curve. A thread claims the tetrahedra that it removes, see SharedAccess3. If another
/// thread is at work there, the vertex is tried again later.
class ParallelInsertion3
{
public:
  using Index = TetrahedronMesh::Index;
  /// Called with the number of vertices inserted so far, by the calling thread only. Returns false
  /// to stop.
  using Monitor = std::function<bool(std::size_t)>;

  static constexpr Index Few = 1 << 12; ///< fewer vertices are inserted by one thread

  /// `mesh`, `points` and `first` must outlive this object. `count` is the number of points,
  /// including the vertex at infinity. `first` inserts the vertices that the threads leave.
  ParallelInsertion3(
    TetrahedronMesh& mesh, const Point3* points, std::size_t count, Cavity3& first, int threads);

  /// Inserts the vertices [first, end), which are along a curve. Appends to `found` those that have
  /// the coordinates of an earlier vertex. Returns false if `proceed` did. Throws std::length_error
  /// if there are too many tetrahedra.
  bool insert(
    Index first, Index end, const Monitor& proceed, std::vector<Cavity3::Coincidence>& found);

private:
  /// With fewer vertices, too many are near the borders of regions.
  static constexpr std::size_t FewInRegions = 1 << 14;

  /// The data of one thread.
  struct Worker
  {
    Cavity3 Opened;
    Index Start = 0;                ///< where its first walk starts
    std::vector<Index> NotInserted; ///< vertices
    std::vector<Cavity3::Coincidence> Found;
  };

  std::size_t beginOf(std::size_t worker) const;
  Index startOf(std::size_t worker) const;
  Index startIn(std::size_t region) const;
  void reserveFor(std::size_t count);
  void chooseRegions();
  template <typename Start, typename Work>
  void runWorkers(const Start& start, const Work& work);
  void insertInRegion(std::size_t number, bool isCaller, const Monitor& proceed);
  void insertAlongCurve(std::size_t number, bool isCaller, const Monitor& proceed);
  bool insertLeft(const Monitor& proceed, std::vector<Cavity3::Coincidence>& found);
  bool mustStop(bool isCaller, const Monitor& proceed);

  TetrahedronMesh& Mesh;
  const Point3* Points;
  Cavity3& First;
  std::vector<Worker> Workers;
  std::vector<std::atomic<std::size_t>> Next; ///< by worker: in Waiting, the first vertex to take
  std::vector<Index> Waiting;                 ///< vertices that are still to be inserted; ascending
  std::vector<std::uint8_t> Regions;          ///< by vertex
  bool RegionsPay = true;
  std::atomic<std::size_t> RegionsBegun{ 0 };
  std::atomic<bool> AreRegionsOver{ false };
  std::atomic<std::uint64_t> End{ 0 };
  std::atomic<std::size_t> Done{ 0 };
  std::atomic<bool> IsStopped{ false };
};

} // namespace tipp

#endif

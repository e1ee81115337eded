// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/DelaunayKernel3.h"

#include "Parallel/ParallelFor.h"
#include "Predicates/ExactPredicates3.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
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
  /// Only the calling thread calls it.
  using Monitor = DelaunayKernel3::Monitor;

  static constexpr Index Few = 1 << 12; ///< fewer vertices are inserted by one thread

  /// `mesh`, `points` and `first` must outlive this object. `count` is the number of points,
  /// including the vertex at infinity. `first` inserts the vertices that the threads leave.
  ParallelInsertion3(
    TetrahedronMesh& mesh, const Point3* points, std::size_t count, Cavity3& first, int threads)
    : Mesh(mesh)
    , First(first)
    , Workers(std::size_t(std::clamp(threads, 1, Cavity3::MostSharing)))
    , Next(Workers.size())
  {
    for (Worker& worker : this->Workers)
    {
      worker.Opened.restart(points, count);
    }
  }

  /// Inserts the vertices [first, end). Appends to `found` those that have the coordinates of an
  /// earlier vertex. Returns false if `proceed` did. Throws std::length_error if there are too many
  /// tetrahedra.
  bool insert(
    Index first, Index end, const Monitor& proceed, std::vector<Cavity3::Coincidence>& found)
  {
    this->Waiting.resize(end - first);
    std::iota(this->Waiting.begin(), this->Waiting.end(), first);
    // Threads cannot enlarge the mesh, and vertices are left if it is full.
    std::size_t before = 0;
    while (this->Waiting.size() >= Few && this->Waiting.size() != before && !this->IsStopped)
    {
      before = this->Waiting.size();
      this->Done = end - before;
      this->reserveFor(before);
      this->insertTogether(proceed);
      for (Worker& worker : this->Workers)
      {
        found.insert(found.end(), worker.Found.begin(), worker.Found.end());
        worker.Found.clear();
      }
    }
    return !this->IsStopped && this->insertLeft(proceed, found);
  }

private:
  /// The data of one thread.
  struct Worker
  {
    Cavity3 Opened;
    std::vector<Index> NotInserted; ///< vertices
    std::vector<Cavity3::Coincidence> Found;
  };

  /// The first vertex of the worker's part of Waiting.
  std::size_t beginOf(std::size_t worker) const
  {
    return this->Waiting.size() * worker / this->Workers.size();
  }

  /// Returns a finite tetrahedron at about the same share of the mesh as the worker's part has of
  /// the vertices.
  Index startOf(std::size_t worker) const
  {
    const std::size_t cells = this->Mesh.end() / 8;
    std::size_t cell = cells * worker / this->Workers.size();
    while (this->Mesh.marks()[cell] != TetrahedronMesh::Live || this->Mesh.slots()[8 * cell] == 0)
    {
      cell = (cell + 1) % cells;
    }
    return Index(8 * cell);
  }

  /// Reserves memory for as many tetrahedra as `count` vertices usually add.
  void reserveFor(std::size_t count)
  {
    constexpr std::size_t cellsPerVertex = 8;
    const std::size_t needed = this->Mesh.end() / 8 + cellsPerVertex * count;
    this->Mesh.reserve(std::min<std::size_t>(needed, TetrahedronMesh::MostSlots / 8));
  }

  /// Inserts waiting vertices in all threads. Those that are not inserted stay in Waiting.
  void insertTogether(const Monitor& proceed)
  {
    const std::size_t workers = this->Workers.size();
    for (std::size_t k = 0; k < workers; ++k)
    {
      this->Next[k] = this->beginOf(k);
      this->Workers[k].Opened.continueAt(this->startOf(k));
      this->Workers[k].Opened.share(static_cast<std::uint8_t>(k), this->End);
      this->Workers[k].NotInserted.clear();
    }
    this->End = this->Mesh.end();
    const int caller = threadNumber();
    parallelFor(std::int64_t(workers), int(workers),
      [&](std::int64_t k) { this->work(std::size_t(k), threadNumber() == caller, proceed); });
    this->Mesh.setEnd(Index(this->End));
    this->Waiting.clear();
    for (const Worker& worker : this->Workers)
    {
      this->Waiting.insert(
        this->Waiting.end(), worker.NotInserted.begin(), worker.NotInserted.end());
    }
    std::sort(this->Waiting.begin(), this->Waiting.end());
  }

  /// Inserts the vertices of the worker's own part, then helps with the other parts.
  void work(std::size_t number, bool isCaller, const Monitor& proceed)
  {
    constexpr std::size_t block = 1 << 11;
    Worker& worker = this->Workers[number];
    std::vector<Index> again;
    for (std::size_t k = 0; k < this->Workers.size(); ++k)
    {
      const std::size_t part = (number + k) % this->Workers.size();
      const std::size_t end = this->beginOf(part + 1);
      while (!this->IsStopped)
      {
        if (isCaller && proceed && !proceed(this->Done))
        {
          this->IsStopped = true;
          return;
        }
        const std::size_t first = this->Next[part].fetch_add(block);
        if (first >= end)
        {
          break;
        }
        const Index* const vertices = this->Waiting.data();
        const std::size_t last = std::min(end, first + block);
        const std::size_t before = worker.NotInserted.size();
        again.clear();
        worker.Opened.insertShared(
          this->Mesh, vertices + first, vertices + last, again, worker.Found);
        worker.Opened.insertShared(
          this->Mesh, again.data(), again.data() + again.size(), worker.NotInserted, worker.Found);
        this->Done += last - first - (worker.NotInserted.size() - before);
      }
    }
  }

  /// Inserts the remaining vertices in this thread.
  bool insertLeft(const Monitor& proceed, std::vector<Cavity3::Coincidence>& found)
  {
    this->First.continueAt(this->startOf(0));
    constexpr std::size_t block = 1 << 12;
    for (std::size_t i = 0; i < this->Waiting.size(); ++i)
    {
      if (i % block == 0 && proceed && !proceed(this->Done))
      {
        return false;
      }
      this->First.insert(this->Mesh, this->Waiting[i], this->Waiting[i] + 1, found);
      ++this->Done;
    }
    return true;
  }

  TetrahedronMesh& Mesh;
  Cavity3& First;
  std::vector<Worker> Workers;
  std::vector<std::atomic<std::size_t>> Next; ///< by worker: in Waiting, the first vertex to take
  std::vector<Index> Waiting;                 ///< vertices that are still to be inserted; ascending
  std::atomic<std::uint64_t> End{ 0 };
  std::atomic<std::size_t> Done{ 0 };
  std::atomic<bool> IsStopped{ false };
};

} // namespace

/// Three points are collinear if their projections along all three axes are.
bool areCollinear(const Point3& a, const Point3& b, const Point3& c)
{
  return orientation({ a.x, a.y }, { b.x, b.y }, { c.x, c.y }) == 0 &&
    orientation({ a.y, a.z }, { b.y, b.z }, { c.y, c.z }) == 0 &&
    orientation({ a.z, a.x }, { b.z, b.x }, { c.z, c.x }) == 0;
}

bool DelaunayKernel3::triangulate(
  const Point3* points, std::size_t count, const Monitor& proceed, int threads, std::size_t more)
{
  this->Mesh.clear();
  this->Duplicates.clear();
  this->Coincidences.clear();
  this->Points.reserve(1 + count + more + 1);
  this->Points.resize(1);
  // So that no filter of a predicate decides for the vertex at infinity.
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  this->Points[0] = { none, none, none };
  this->PointIndices.reserve(1 + count + more);
  this->PointIndices.resize(1);
  this->append(points, count);
  if (!this->makeFirst())
  {
    return true;
  }
  // A uniform distribution makes seven tetrahedra per point, including a few free ones. Threads
  // cannot enlarge the mesh, so they get more.
  const std::size_t cellsPerPoint = threads > 1 ? 9 : 7;
  this->Mesh.reserve(cellsPerPoint * (count + more) + 64);
  if (!this->insertAll(proceed, threads))
  {
    this->Mesh.clear();
    this->Dimension = -1;
    return false;
  }
  this->takeCoincidences();
  return true;
}

void DelaunayKernel3::add(const Point3* points, std::size_t count)
{
  const Index first = this->vertexEnd();
  this->append(points, count);
  this->Opened.extend(this->Points.data(), this->Points.size());
  this->insertRange(first, this->vertexEnd(), {});
  this->takeCoincidences();
}

/// Adds vertices in the order of insertion.
void DelaunayKernel3::append(const Point3* points, std::size_t count)
{
  const std::size_t first = this->Points.size();
  const std::size_t before = first - 1; // points
  if (before + count >= std::size_t(1) << InsertionOrder3::IndexBits)
  {
    throw std::length_error("too many points for one partition: use more partitions");
  }
  this->Order.compute(points, count);
  this->Points.reserve(first + count + 1); // Cavity3 reads the number behind each point
  this->Points.resize(first + count);
  this->PointIndices.resize(first + count);
  for (std::size_t k = 0; k < count; ++k)
  {
    this->Points[first + k] = points[this->Order[k]];
    this->PointIndices[first + k] = static_cast<std::uint32_t>(before + this->Order[k]);
  }
  this->Order.release();
}

/// Moves four points that are not coplanar to the front, and makes their tetrahedron and its
/// infinite neighbours. Returns false if there are no such points.
bool DelaunayKernel3::makeFirst()
{
  this->Dimension = -1;
  const std::size_t end = this->Points.size();
  std::size_t next = 1;
  const auto& at = this->Points;
  // Finds the first point from `next` on that does not depend on those before `to`, and swaps it to
  // position `to`.
  const auto extend = [&](std::size_t to, const auto& isDependent)
  {
    while (next < end && isDependent(at[next]))
    {
      ++next;
    }
    if (next == end)
    {
      return false;
    }
    std::swap(this->Points[to], this->Points[next]);
    std::swap(this->PointIndices[to], this->PointIndices[next]);
    ++this->Dimension;
    ++next;
    return true;
  };
  if (!extend(1, [](const Point3&) { return false; }) ||
    !extend(2, [&](const Point3& p) { return p == at[1]; }) ||
    !extend(3, [&](const Point3& p) { return areCollinear(at[1], at[2], p); }) ||
    !extend(4, [&](const Point3& p) { return orientation3(at[1], at[2], at[3], p) == 0; }))
  {
    return false;
  }
  if (orientation3(at[1], at[2], at[3], at[4]) < 0)
  {
    std::swap(this->Points[1], this->Points[2]);
    std::swap(this->PointIndices[1], this->PointIndices[2]);
  }
  this->Mesh.reserve(64);
  Index* const slots = this->Mesh.slots();
  constexpr Index corners[5][4] = { { 1, 2, 3, 4 }, { Infinite, 2, 4, 3 }, { Infinite, 1, 3, 4 },
    { Infinite, 1, 4, 2 }, { Infinite, 1, 2, 3 } };
  for (Index t = 0; t < 5; ++t)
  {
    std::copy_n(corners[t], 4, slots + 8 * t);
    this->Mesh.marks()[t] = TetrahedronMesh::Live;
  }
  for (Index i = 0; i < 4; ++i)
  {
    // Infinite tetrahedron i + 1 is on the facet opposite to corner i, which is vertex i + 1.
    // Across its facet opposite to vertex v is infinite tetrahedron v, the one that lacks v.
    this->Mesh.link(i, 8 * (i + 1));
    for (Index j = 1; j < 4; ++j)
    {
      const Index other = corners[i + 1][j];
      const Index* const there = corners[other];
      const auto position = static_cast<Index>(std::find(there, there + 4, i + 1) - there);
      this->Mesh.link(8 * (i + 1) + j, 8 * other + position);
    }
  }
  this->Mesh.setEnd(40);
  return true;
}

/// Inserts vertices in this thread only. Returns false if `proceed` did.
bool DelaunayKernel3::insertRange(Index first, Index end, const Monitor& proceed)
{
  constexpr Index block = 1 << 12;
  for (; first < end; first += std::min(block, end - first))
  {
    if (proceed && !proceed(first))
    {
      return false;
    }
    this->Opened.insert(this->Mesh, first, std::min(end, first + block), this->Coincidences);
  }
  return true;
}

bool DelaunayKernel3::insertAll(const Monitor& proceed, int threads)
{
  this->Opened.restart(this->Points.data(), this->Points.size());
  std::optional<ParallelInsertion3> together;
  Index first = 5;
  for (const std::size_t last : this->Order.roundEnds())
  {
    const auto end = static_cast<Index>(last + 1);
    if (end <= first)
    {
      continue;
    }
    const bool isLarge = threads > 1 && end - first >= ParallelInsertion3::Few;
    if (isLarge && !together)
    {
      together.emplace(this->Mesh, this->Points.data(), this->Points.size(), this->Opened, threads);
    }
    if (!(isLarge ? together->insert(first, end, proceed, this->Coincidences)
                  : this->insertRange(first, end, proceed)))
    {
      return false;
    }
    first = end;
  }
  return true;
}

/// Makes the lowest index of the points at a vertex the vertex's point; the others become
/// duplicates.
void DelaunayKernel3::takeCoincidences()
{
  for (const Cavity3::Coincidence& found : this->Coincidences)
  {
    std::uint32_t point = this->PointIndices[found.Vertex];
    std::uint32_t& own = this->PointIndices[found.Representative];
    if (point < own)
    {
      std::swap(point, own);
    }
    this->Duplicates.push_back({ point, found.Representative });
  }
  this->Coincidences.clear();
}

void DelaunayKernel3::release()
{
  this->Mesh.release();
  Uninitialised<Point3>().swap(this->Points);
  Uninitialised<std::uint32_t>().swap(this->PointIndices);
  this->Duplicates = {};
  this->Coincidences = {};
  this->Opened = {};
  this->Dimension = -1;
}

std::size_t DelaunayKernel3::bytes() const
{
  return this->Mesh.bytes() + this->Points.capacity() * sizeof(Point3) +
    this->PointIndices.capacity() * sizeof(std::uint32_t);
}

} // namespace tipp

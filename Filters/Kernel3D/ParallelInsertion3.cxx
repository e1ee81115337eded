// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel3D/ParallelInsertion3.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

ParallelInsertion3::ParallelInsertion3(
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

bool ParallelInsertion3::insert(
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

/// Reserves memory for as many tetrahedra as `count` vertices usually add.
void ParallelInsertion3::reserveFor(std::size_t count)
{
  constexpr std::size_t cellsPerVertex = 8;
  const std::size_t needed = this->Mesh.end() / 8 + cellsPerVertex * count;
  if (needed > this->Mesh.capacity())
  {
    this->Mesh.reserve(std::min<std::size_t>(needed, TetrahedronMesh::MostSlots / 8));
  }
}

/// Inserts waiting vertices in all threads. Those that are not inserted stay in Waiting.
void ParallelInsertion3::insertTogether(const Monitor& proceed)
{
  const std::size_t workers = this->Workers.size();
  for (std::size_t k = 0; k < workers; ++k)
  {
    this->Next[k] = this->beginOf(k);
    this->Workers[k].Opened.continueAt(this->startOf(k));
    this->Workers[k].Opened.share(static_cast<std::uint8_t>(k), this->End);
    this->Workers[k].Left.clear();
  }
  this->End = this->Mesh.end();
  const int caller = omp_get_thread_num();
  parallelFor(std::int64_t(workers), int(workers),
    [&](std::int64_t k) { this->work(std::size_t(k), omp_get_thread_num() == caller, proceed); });
  this->Mesh.setEnd(Index(this->End));
  this->Waiting.clear();
  for (const Worker& worker : this->Workers)
  {
    this->Waiting.insert(this->Waiting.end(), worker.Left.begin(), worker.Left.end());
  }
  std::sort(this->Waiting.begin(), this->Waiting.end());
}

/// Inserts the vertices of the worker's own part, then helps with the other parts.
void ParallelInsertion3::work(std::size_t number, bool isCaller, const Monitor& proceed)
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
      const std::size_t before = worker.Left.size();
      again.clear();
      worker.Opened.insertShared(
        this->Mesh, vertices + first, vertices + last, again, worker.Found);
      worker.Opened.insertShared(
        this->Mesh, again.data(), again.data() + again.size(), worker.Left, worker.Found);
      this->Done += last - first - (worker.Left.size() - before);
    }
  }
}

/// Inserts the remaining vertices in this thread.
bool ParallelInsertion3::insertLeft(
  const Monitor& proceed, std::vector<Cavity3::Coincidence>& found)
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

/// Returns a finite tetrahedron at about the same share of the mesh as the worker's part has of the
/// vertices.
TetrahedronMesh::Index ParallelInsertion3::startOf(std::size_t worker) const
{
  const std::size_t cells = this->Mesh.end() / 8;
  std::size_t cell = cells * worker / this->Workers.size();
  while (this->Mesh.marks()[cell] != TetrahedronMesh::Live || this->Mesh.slots()[8 * cell] == 0)
  {
    cell = (cell + 1) % cells;
  }
  return Index(8 * cell);
}

} // namespace tipp

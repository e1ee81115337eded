// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel/ParallelInsertion3.h"

#include "Kernel/VertexRegions.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

ParallelInsertion3::ParallelInsertion3(
  TetrahedronMesh& mesh, const Point3* points, std::size_t count, Cavity3& first, int threads)
  : Mesh(mesh)
  , Points(points)
  , First(first)
  , Workers(std::size_t(std::clamp(threads, 1, Cavity3::MostSharing)))
  , Next(Workers.size())
  , Regions(count)
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
  bool isOfUse = true;
  while (this->Waiting.size() >= Few && isOfUse && !this->IsStopped)
  {
    const std::size_t before = this->Waiting.size();
    this->Done = end - before;
    this->reserveFor(before);
    const bool isInRegions = this->RegionsPay && before >= FewInRegions;
    if (isInRegions)
    {
      this->chooseRegions();
      this->runWorkers([&](std::size_t number) { return this->startIn(number); },
        [&](std::size_t number, bool isCaller)
        { this->insertInRegion(number, isCaller, proceed); });
      this->RegionsPay = this->Waiting.size() < before / 2;
    }
    else
    {
      this->runWorkers([&](std::size_t number) { return this->startOf(number); },
        [&](std::size_t number, bool isCaller)
        { this->insertAlongCurve(number, isCaller, proceed); });
    }
    isOfUse = isInRegions || this->Waiting.size() != before;
    for (Worker& worker : this->Workers)
    {
      found.insert(found.end(), worker.Found.begin(), worker.Found.end());
      worker.Found.clear();
    }
  }
  return !this->IsStopped && this->insertLeft(proceed, found);
}

/// The first vertex of the worker's part of Waiting.
std::size_t ParallelInsertion3::beginOf(std::size_t worker) const
{
  return this->Waiting.size() * worker / this->Workers.size();
}

/// Returns a finite tetrahedron at about the same share of the mesh as the worker's part has of the
/// vertices.
ParallelInsertion3::Index ParallelInsertion3::startOf(std::size_t worker) const
{
  const std::size_t cells = this->Mesh.end() / 8;
  std::size_t cell = cells * worker / this->Workers.size();
  while (this->Mesh.marks()[cell] != TetrahedronMesh::Live || this->Mesh.slots()[8 * cell] == 0)
  {
    cell = (cell + 1) % cells;
  }
  return Index(8 * cell);
}

/// Returns a finite tetrahedron in the region, or Mesh.end() if there is none.
ParallelInsertion3::Index ParallelInsertion3::startIn(std::size_t region) const
{
  const Index end = this->Mesh.end();
  for (Index cell = 0; cell < end; cell += 8)
  {
    const Index* const v = this->Mesh.slots() + cell;
    // No region has the vertex at infinity.
    if (this->Mesh.marks()[cell / 8] == TetrahedronMesh::Live &&
      std::all_of(v, v + 4, [&](Index vertex) { return this->Regions[vertex] == region; }))
    {
      return cell;
    }
  }
  return end;
}

/// Reserves memory for as many tetrahedra as `count` vertices usually add.
void ParallelInsertion3::reserveFor(std::size_t count)
{
  constexpr std::size_t cellsPerVertex = 8;
  const std::size_t needed = this->Mesh.end() / 8 + cellsPerVertex * count;
  this->Mesh.reserve(std::min<std::size_t>(needed, TetrahedronMesh::MostSlots / 8));
}

/// Chooses regions that have equal numbers of waiting vertices, and finds that of each vertex.
void ParallelInsertion3::chooseRegions()
{
  const auto threads = int(this->Workers.size());
  const VertexRegions regions(this->Points, this->Waiting, threads);
  constexpr std::int64_t chunk = 1 << 13;
  forChunks(std::int64_t(this->Waiting.back()) + 1, chunk, threads, {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      for (auto vertex = std::size_t(begin); vertex < std::size_t(end); ++vertex)
      {
        this->Regions[vertex] = regions.of(this->Points[vertex]);
      }
    });
  this->Regions[0] = VertexRegions::None;
  this->RegionsBegun = 0;
  this->AreRegionsOver = false;
}

/// Calls work(number, isCaller) for each worker, in threads; its first walk starts at the
/// tetrahedron start(number). The vertices that are not inserted stay in Waiting.
template <typename Start, typename Work>
void ParallelInsertion3::runWorkers(const Start& start, const Work& work)
{
  for (std::size_t k = 0; k < this->Workers.size(); ++k)
  {
    this->Next[k] = this->beginOf(k);
    this->Workers[k].Start = start(k);
    this->Workers[k].NotInserted.clear();
  }
  this->End = this->Mesh.end();
  const int caller = threadNumber();
  parallelFor(std::int64_t(this->Workers.size()), int(this->Workers.size()),
    [&](std::int64_t k) { work(std::size_t(k), threadNumber() == caller); });
  this->Mesh.setEnd(Index(this->End));
  this->Waiting.clear();
  for (const Worker& worker : this->Workers)
  {
    this->Waiting.insert(this->Waiting.end(), worker.NotInserted.begin(), worker.NotInserted.end());
  }
  std::sort(this->Waiting.begin(), this->Waiting.end());
}

/// Whether the run is stopped. The calling thread asks `proceed`.
bool ParallelInsertion3::mustStop(bool isCaller, const Monitor& proceed)
{
  if (isCaller && proceed && !this->IsStopped && !proceed(this->Done))
  {
    this->IsStopped = true;
  }
  return this->IsStopped;
}

/// Inserts the vertices of a region, until another thread has finished its region, or if too many
/// are not inserted.
void ParallelInsertion3::insertInRegion(std::size_t number, bool isCaller, const Monitor& proceed)
{
  ++this->RegionsBegun;
  constexpr std::size_t firstBlock = 1 << 8; // enough to see whether cavities are inside
  constexpr std::size_t block = 1 << 9;
  Worker& worker = this->Workers[number];
  std::vector<Index>& left = worker.NotInserted;
  worker.Opened.shareRegions(this->Regions.data(), std::uint8_t(number), this->End);
  worker.Opened.continueAt(worker.Start);
  bool isOver = worker.Start == this->Mesh.end();
  std::size_t tried = 0;
  std::vector<Index> own;
  for (std::size_t i = 0; i < this->Waiting.size();)
  {
    own.clear();
    const std::size_t most = tried == 0 ? firstBlock : block;
    for (; i < this->Waiting.size() && own.size() < most; ++i)
    {
      if (this->Regions[this->Waiting[i]] == number)
      {
        own.push_back(this->Waiting[i]);
      }
    }
    isOver = isOver || this->AreRegionsOver || this->mustStop(isCaller, proceed) ||
      left.size() > tried / 4 * 3;
    if (isOver)
    {
      left.insert(left.end(), own.begin(), own.end());
      continue;
    }
    const std::size_t before = left.size();
    worker.Opened.insertInRegion(
      this->Mesh, own.data(), own.data() + own.size(), left, worker.Found);
    tried += own.size();
    this->Done += own.size() - (left.size() - before);
  }
  if (this->RegionsBegun == this->Workers.size())
  {
    this->AreRegionsOver = true;
  }
}

/// Inserts the vertices of the worker's own part, then helps with the other parts.
void ParallelInsertion3::insertAlongCurve(std::size_t number, bool isCaller, const Monitor& proceed)
{
  constexpr std::size_t block = 1 << 11;
  Worker& worker = this->Workers[number];
  worker.Opened.share(static_cast<std::uint8_t>(number), this->End);
  worker.Opened.continueAt(worker.Start);
  std::vector<Index> again;
  for (std::size_t k = 0; k < this->Workers.size(); ++k)
  {
    const std::size_t part = (number + k) % this->Workers.size();
    const std::size_t end = this->beginOf(part + 1);
    while (!this->mustStop(isCaller, proceed))
    {
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

} // namespace tipp

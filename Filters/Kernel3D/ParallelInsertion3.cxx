// SPDX-License-Identifier: BSD-3-Clause
#include "Kernel3D/ParallelInsertion3.h"

#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <numeric>

namespace tipp
{

ParallelInsertion3::ParallelInsertion3(
  TetrahedronMesh& mesh, const Point3* points, std::size_t count, Cavity3& first)
  : Mesh(mesh)
  , Points(points)
  , Count(count)
  , First(first)
{
}

bool ParallelInsertion3::insert(Index first, Index end, int threads, const Monitor& proceed,
  std::vector<Cavity3::Coincidence>& found)
{
  if (this->Workers.empty())
  {
    constexpr int mostTiles = 255; // Owners has a byte for a tile
    this->Workers.resize(std::size_t(std::min(threads, mostTiles)));
    this->Owners.resize(this->Count);
    for (Worker& worker : this->Workers)
    {
      worker.Opened.restart(this->Points, this->Count);
    }
  }
  this->Waiting.resize(end - first);
  std::iota(this->Waiting.begin(), this->Waiting.end(), first);
  constexpr int passes = 3;
  for (int pass = 0; pass < passes && this->Waiting.size() >= Few / 8 && !this->IsStopped; ++pass)
  {
    this->Done = end - this->Waiting.size();
    this->insertTogether(end, threads, proceed);
    for (Worker& worker : this->Workers)
    {
      found.insert(found.end(), worker.Found.begin(), worker.Found.end());
      worker.Found.clear();
    }
  }
  return !this->IsStopped && this->insertLeft(proceed, found);
}

/// Inserts waiting vertices in all threads, as far as their territories allow.
void ParallelInsertion3::insertTogether(Index end, int threads, const Monitor& proceed)
{
  constexpr std::size_t perTile = 1024;
  const std::size_t wanted = perTile * this->Workers.size();
  const std::size_t step = std::max<std::size_t>(1, this->Waiting.size() / wanted);
  std::vector<Point3> sample;
  for (std::size_t i = step / 2; i < this->Waiting.size(); i += step)
  {
    sample.push_back(this->Points[this->Waiting[i]]);
  }
  const Tiling3 tiling(std::move(sample), int(this->Workers.size()));
  this->setOwners(tiling, end, threads);
  this->findStarts(std::size_t(tiling.size()));
  for (Worker& worker : this->Workers)
  {
    worker.Mine.clear();
    worker.Left.clear();
  }
  for (const Index vertex : this->Waiting)
  {
    this->Workers[this->Owners[vertex]].Mine.push_back(vertex);
  }
  this->End = this->Mesh.end();
  const int caller = omp_get_thread_num();
  parallelFor(tiling.size(), threads,
    [&](std::int64_t tile)
    { this->work(std::size_t(tile), omp_get_thread_num() == caller, proceed); });
  this->Mesh.setEnd(Index(this->End));
  this->Waiting.clear();
  for (const Worker& worker : this->Workers)
  {
    this->Waiting.insert(this->Waiting.end(), worker.Left.begin(), worker.Left.end());
  }
  std::sort(this->Waiting.begin(), this->Waiting.end());
}

void ParallelInsertion3::setOwners(const Tiling3& tiling, Index end, int threads)
{
  constexpr std::int64_t chunk = 1 << 14;
  forChunks(end, chunk, threads, {},
    [&](std::int64_t from, std::int64_t to, int)
    {
      for (std::int64_t v = from; v < to; ++v)
      {
        this->Owners[std::size_t(v)] =
          static_cast<std::uint8_t>(tiling.locate(this->Points[std::size_t(v)]));
      }
    });
}

/// Finds some finite tetrahedra in each territory that has any.
void ParallelInsertion3::findStarts(std::size_t tiles)
{
  for (Worker& worker : this->Workers)
  {
    worker.Starts.clear();
  }
  constexpr std::size_t perTile = 1024;
  const std::size_t cells = this->Mesh.end() / 8;
  const std::size_t step = std::max<std::size_t>(1, cells / (perTile * tiles));
  const Index* const slots = this->Mesh.slots();
  for (std::size_t cell = 0; cell < cells; cell += step)
  {
    const Index* const v = slots + 8 * cell;
    if (this->Mesh.marks()[cell] == TetrahedronMesh::Live && v[0] != 0)
    {
      const std::uint8_t owner = this->Owners[v[0]];
      const bool isOwn =
        this->Owners[v[1]] == owner && this->Owners[v[2]] == owner && this->Owners[v[3]] == owner;
      isOwn ? this->Workers[owner].Starts.push_back(Index(8 * cell)) : void();
    }
  }
}

void ParallelInsertion3::work(std::size_t tile, bool isCaller, const Monitor& proceed)
{
  Worker& worker = this->Workers[tile];
  if (worker.Starts.empty())
  {
    worker.Left = worker.Mine;
    return;
  }
  worker.Opened.enter(
    { this->Owners.data(), static_cast<std::uint8_t>(tile), &worker.Starts, &this->End });
  constexpr std::size_t block = 1 << 12;
  constexpr std::size_t few = 2048;
  const Index* const vertices = worker.Mine.data();
  const std::size_t count = worker.Mine.size();
  for (std::size_t first = 0; first < count && !this->IsStopped; first += block)
  {
    const std::size_t last = std::min(count, first + block);
    if (isCaller && proceed && !proceed(this->Done))
    {
      this->IsStopped = true;
    }
    else if (worker.Left.size() > few && 2 * worker.Left.size() > first)
    {
      // Most tetrahedra reach into other territories, so inserting does not pay here.
      worker.Left.insert(worker.Left.end(), vertices + first, vertices + count);
      return;
    }
    else
    {
      const std::size_t before = worker.Left.size();
      worker.Opened.insertWithin(
        this->Mesh, vertices + first, vertices + last, worker.Left, worker.Found);
      this->Done += last - first - (worker.Left.size() - before);
    }
  }
}

/// Inserts the remaining vertices in this thread.
bool ParallelInsertion3::insertLeft(
  const Monitor& proceed, std::vector<Cavity3::Coincidence>& found)
{
  Index start = 0;
  while (this->Mesh.marks()[start / 8] != TetrahedronMesh::Live || this->Mesh.slots()[start] == 0)
  {
    start += 8;
  }
  this->First.continueAt(start);
  constexpr std::size_t block = 1 << 12;
  for (std::size_t i = 0; i < this->Waiting.size();)
  {
    if (i % block == 0 && proceed && !proceed(this->Done))
    {
      return false;
    }
    const Index vertex = this->Waiting[i];
    Index end = vertex;
    do
    {
      ++end;
      ++i;
    } while (i < this->Waiting.size() && this->Waiting[i] == end && i % block != 0);
    this->First.insert(this->Mesh, vertex, end, found);
    this->Done += end - vertex;
  }
  return true;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceRun.h"

#include "Distributed/VertexLabelling.h"
#include "Triangulation/DegenerateInput.h"

#include <algorithm>
#include <thread>
#include <utility>

namespace tipp
{
namespace
{

/// The lowest point of each place is to stand for the others, also where another one was in the
/// initial mesh: once its partition is finished, all triangles that have it are those of its
/// worker. Renames it everywhere.
void preferLowest(std::vector<Duplicate>& duplicates, SeamGroups& seams, std::int32_t* interior,
  std::size_t corners, std::int64_t first)
{
  std::unordered_map<std::int64_t, std::int64_t> lowest;
  for (const Duplicate& duplicate : duplicates)
  {
    if (duplicate.Point < duplicate.Representative)
    {
      std::int64_t& low = lowest.emplace(duplicate.Representative, duplicate.Point).first->second;
      low = std::min(low, duplicate.Point);
    }
  }
  if (lowest.empty())
  {
    return;
  }
  const auto renamed = [&](std::int64_t id)
  {
    const auto found = lowest.find(id);
    return found == lowest.end() ? id : found->second;
  };
  for (Duplicate& duplicate : duplicates)
  {
    const std::int64_t low = renamed(duplicate.Representative);
    duplicate = { duplicate.Point == low ? duplicate.Representative : duplicate.Point, low };
  }
  for (PlainVertex& v : seams.Vertices)
  {
    v.Id = renamed(v.Id);
  }
  for (std::size_t i = 0; i < corners; ++i)
  {
    interior[i] = std::int32_t(renamed(first + interior[i]) - first);
  }
}

} // namespace

/// What one thread works with.
struct PieceRun::Place
{
  PartitionIndex Piece = -1;
  std::unique_ptr<Worker<std::int32_t>> Triangulator; ///< for that piece
  SeamGrouping Grouping;
  VertexLabelling Labelling;
  std::vector<PlainVertex> Vertices;
};

PieceRun::PieceRun(const PiecePlan& plan, const SpilledPoints& points, double factor,
  const PointRowLayout& rows, const PartitionedMesh& mesh, const MemoryPlan& memory, int threads,
  std::function<bool(std::int64_t)> progress)
  : Plan(plan)
  , Points(points)
  , Factor(factor)
  , Rows(rows)
  , Mesh(mesh)
  , Memory(memory)
  , Threads(threads)
  , Progress(std::move(progress))
  , Finished(std::size_t(plan.pieces()))
{
}

std::uint64_t PieceRun::bytesOf(PartitionIndex piece) const
{
  return MemoryPlan::pieceBytes(this->Points.count(piece), this->Rows.Words);
}

std::unique_ptr<LoadedPiece> PieceRun::load(PartitionIndex piece) const
{
  auto loaded = std::make_unique<LoadedPiece>();
  const auto count = std::size_t(this->Points.count(piece));
  loaded->Rows = Buffer<double>(count * this->Rows.Words);
  this->Points.read(piece, loaded->Rows.data());
  const PointsView view(loaded->Rows.data(), count, this->Rows.Words);
  const Tiling& inner = this->Plan.Inner[std::size_t(piece)];
  loaded->Buckets = bucketPoints<std::int32_t>(view.scaled(this->Factor), inner, 1);
  loaded->InteriorCounts.assign(std::size_t(inner.size()), 0);
  loaded->Rim.assign(count, 0);
  return loaded;
}

void PieceRun::loadPieces()
{
  for (PartitionIndex piece = this->Plan.pieces() - 1; piece >= 0; --piece)
  {
    const std::uint64_t bytes = this->bytesOf(piece);
    {
      std::unique_lock<std::mutex> lock(this->Mutex);
      if (!this->Schedule->isToLoad(piece))
      {
        continue;
      }
      this->Changed.wait(lock,
        [&]
        {
          return this->Stopped || this->LoadedBytes == 0 ||
            this->LoadedBytes + bytes <= this->Memory.LoadedBytes;
        });
      if (this->Stopped)
      {
        return;
      }
      this->LoadedBytes += bytes;
    }
    std::unique_ptr<LoadedPiece> loaded = this->load(piece);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Schedule->addLoaded(piece, std::move(loaded));
    this->Changed.notify_all();
  }
}

PartitionIndex PieceRun::acquire(Place& place)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  for (;;)
  {
    if (this->Stopped || this->Schedule->allActivated())
    {
      return -1;
    }
    const PartitionIndex partition = this->Schedule->activateNext(place.Vertices);
    if (partition >= 0)
    {
      return partition;
    }
    this->Changed.wait(lock);
    this->tell(lock);
  }
}

/// The caller's progress, in the caller's thread.
void PieceRun::tell(std::unique_lock<std::mutex>& lock)
{
  if (this->Stopped || this->PointsDone == this->PointsTold ||
    std::this_thread::get_id() != this->Caller)
  {
    return;
  }
  const std::int64_t done = this->PointsTold = this->PointsDone;
  lock.unlock();
  const bool goesOn = this->Progress(done);
  lock.lock();
  this->Stopped = this->Stopped || !goesOn;
  this->Changed.notify_all();
}

PartitionResult PieceRun::triangulate(Place& place, PartitionIndex partition)
{
  const PartitionIndex piece = this->Plan.PieceOf[std::size_t(partition)];
  const PartitionIndex firstPartition = this->Plan.FirstPartition[std::size_t(piece)];
  const std::int64_t first = this->Points.starts()[std::size_t(piece)];
  LoadedPiece& loaded = this->Schedule->loaded(piece);
  if (place.Piece != piece)
  {
    place.Triangulator.reset(); // gives its kernel to the next
    place.Triangulator =
      std::make_unique<Worker<std::int32_t>>(this->Plan.Partitions, loaded.Buckets, first);
    place.Triangulator->setTiling(this->Plan.Partitions, -firstPartition);
    place.Piece = piece;
  }
  Worker<std::int32_t>& worker = *place.Triangulator;
  worker.triangulate(partition, place.Labelling.label(this->Plan.Partitions, place.Vertices));
  PartitionResult result;
  result.Partition = partition;
  result.Seams = place.Grouping.group(worker.seams());
  result.InteriorCount = worker.interiorCount();
  result.Duplicates = worker.duplicates();
  result.Vertices = worker.vertexCount();
  preferLowest(result.Duplicates, result.Seams,
    loaded.Buckets.triangles(partition - firstPartition), 3 * result.InteriorCount, first);
  return result;
}

void PieceRun::bringBack(PartitionResult result)
{
  const PartitionIndex piece = this->Plan.PieceOf[std::size_t(result.Partition)];
  const PartitionIndex inPiece = result.Partition - this->Plan.FirstPartition[std::size_t(piece)];
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->PointsDone += std::int64_t(this->Schedule->loaded(piece).Buckets.count(inPiece));
  this->Duplicates += std::int64_t(result.Duplicates.size());
  this->WorkerVertices += std::int64_t(result.Vertices);
  const bool isWhole = this->Schedule->complete(std::move(result));
  this->PeakRimTriangles =
    std::max(this->PeakRimTriangles, std::int64_t(this->Schedule->rimTriangles()));
  this->Changed.notify_all();
  this->tell(lock);
  if (isWhole && !this->Stopped)
  {
    this->finishPiece(piece, lock);
  }
  this->writeBorders(lock);
  this->saveSometimes(lock);
}

/// When all of its partitions are finished.
void PieceRun::finishPiece(PartitionIndex piece, std::unique_lock<std::mutex>& lock)
{
  this->Schedule->findRim(piece);
  lock.unlock();
  this->writeInterior(piece);
  lock.lock();
  this->Schedule->finishInterior(piece);
  this->LoadedBytes -= this->bytesOf(piece);
  this->BytesSinceSaved += this->bytesOf(piece);
  this->PeakBorderBytes = std::max(this->PeakBorderBytes, this->Schedule->borderBytes());
  this->Changed.notify_all();
}

void PieceRun::writeInterior(PartitionIndex piece)
{
  this->writeLoaded(piece, this->Schedule->loaded(piece), this->Schedule->growing(piece));
}

void PieceRun::writeLoaded(PartitionIndex piece, LoadedPiece& loaded, GrowingPiece& growing)
{
  std::sort(loaded.Seams.begin(), loaded.Seams.end());
  GrowingPiece::Interior interior;
  interior.Rows = loaded.Rows.data();
  interior.Rim = loaded.Rim.data();
  interior.Representatives = &loaded.Representatives;
  for (PartitionIndex p = 0; p < loaded.Buckets.partitions(); ++p)
  {
    interior.Triangles.push_back(
      { loaded.Buckets.triangles(p), loaded.InteriorCounts[std::size_t(p)] });
  }
  if (!loaded.Seams.empty())
  {
    interior.Triangles.push_back({ loaded.Seams.front().data(), loaded.Seams.size() });
  }
  growing.writeInterior(this->Mesh, this->Plan.number(piece), this->Rows, interior);
}

/// A piece without a border.
void PieceRun::writeWhole(PartitionIndex piece, LoadedPiece& loaded)
{
  GrowingPiece growing(this->Points.starts()[std::size_t(piece)], this->Points.count(piece));
  this->writeLoaded(piece, loaded, growing);
  const std::size_t number = this->Plan.number(piece);
  this->Finished[number] = growing.writeBorder(this->Mesh, number, this->Rows);
  this->Duplicates += std::int64_t(loaded.Representatives.size());
}

void PieceRun::writeBorders(std::unique_lock<std::mutex>& lock)
{
  while (!this->Stopped)
  {
    const PartitionIndex piece = this->Schedule->takeComplete();
    if (piece < 0)
    {
      return;
    }
    lock.unlock();
    const std::size_t number = this->Plan.number(piece);
    FinishedPiece finished =
      this->Schedule->growing(piece).writeBorder(this->Mesh, number, this->Rows);
    lock.lock();
    this->Finished[number] = std::move(finished);
    this->Schedule->finishBorder(piece);
  }
}

void PieceRun::work()
{
  Place place;
  for (;;)
  {
    const PartitionIndex partition = this->acquire(place);
    if (partition < 0)
    {
      return;
    }
    this->bringBack(this->triangulate(place, partition));
  }
}

void PieceRun::stop(const std::exception_ptr& reason)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Stopped = true;
  this->Failure = this->Failure ? this->Failure : reason;
  this->Changed.notify_all();
}

void PieceRun::guard(const std::function<void()>& body)
{
  try
  {
    body();
  }
  catch (...)
  {
    this->stop(std::current_exception());
  }
}

void PieceRun::runThreads()
{
  std::vector<std::thread> threads;
  try
  {
    threads.emplace_back([this] { this->guard([this] { this->loadPieces(); }); });
    for (int i = 1; i < this->Threads; ++i)
    {
      threads.emplace_back([this] { this->guard([this] { this->work(); }); });
    }
  }
  catch (...)
  {
    this->stop(std::current_exception());
  }
  this->guard([this] { this->work(); });
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->tell(lock); // of what the other threads did last
}

/// A run from the beginning.
void PieceRun::start()
{
  this->Schedule = std::make_unique<PieceSchedule>(
    this->Plan, this->Points, this->Rows, this->Plan.initialMesh(this->Threads));
  // Pieces without points may own triangles all the same.
  for (PartitionIndex piece = 0; piece < this->Plan.pieces(); ++piece)
  {
    if (this->Points.count(piece) == 0)
    {
      this->Schedule->growing(piece).writeInterior(
        this->Mesh, this->Plan.number(piece), this->Rows, {});
      this->Schedule->finishInterior(piece);
    }
  }
}

bool PieceRun::triangulate()
{
  if (!this->startFromCheckpoint())
  {
    this->start();
  }
  this->runThreads();
  std::unique_lock<std::mutex> lock(this->Mutex);
  if (!this->Stopped)
  {
    this->Schedule->repairHull();
    this->writeBorders(lock);
  }
  if (!this->CheckpointPath.empty())
  {
    SaveArchive archive;
    this->save(archive);
    writeCheckpoint(this->CheckpointPath, archive);
  }
  return !this->Stopped;
}

bool PieceRun::writePointsAlone()
{
  for (PartitionIndex piece = 0; piece < this->Plan.pieces(); ++piece)
  {
    const std::unique_ptr<LoadedPiece> loaded = this->load(piece);
    const auto count = std::size_t(this->Points.count(piece));
    const PointsView view(loaded->Rows.data(), count, this->Rows.Words);
    for (const Duplicate& duplicate : sortOutDuplicates(view))
    {
      loaded->Representatives.emplace(
        std::int32_t(duplicate.Point), std::int32_t(duplicate.Representative));
    }
    this->writeWhole(piece, *loaded);
    this->PointsDone += std::int64_t(count);
    if (!this->Progress(this->PointsDone))
    {
      return false;
    }
  }
  return true;
}

bool PieceRun::triangulateAlone()
{
  const std::unique_ptr<LoadedPiece> loaded = this->load(0);
  Worker<std::int32_t> worker(this->Plan.Partitions, loaded->Buckets);
  if (!worker.triangulateAlone(
        [this](std::size_t inserted) { return this->Progress(std::int64_t(inserted)); }))
  {
    return false;
  }
  loaded->InteriorCounts[0] = worker.interiorCount();
  for (const Duplicate& duplicate : worker.duplicates())
  {
    loaded->Representatives.emplace(
      std::int32_t(duplicate.Point), std::int32_t(duplicate.Representative));
  }
  this->WorkerVertices = std::int64_t(worker.vertexCount());
  this->writeWhole(0, *loaded);
  return true;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceRun.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace tipp
{

PieceRun::PieceRun(const PieceWork& work, const MemoryPlan& memory, int threads,
  std::function<bool(std::int64_t)> progress, Postbox* ranks)
  : Work(work)
  , Memory(memory)
  , Threads(threads)
  , Progress(std::move(progress))
  , Post(ranks)
  , Own(work)
  , Ranks(std::size_t(ranks ? ranks->size() : 1))
  , NextToLoad(work.Plan.pieces() - 1)
  , Finished(std::size_t(work.Plan.pieces()))
{
}

/// The next piece for the rank to load, if it has the memory; else -1.
PartitionIndex PieceRun::takeToLoad(int rank)
{
  while (this->NextToLoad >= 0 && !this->Schedule->isToLoad(this->NextToLoad))
  {
    --this->NextToLoad;
  }
  if (this->NextToLoad < 0)
  {
    return -1;
  }
  const std::uint64_t bytes = this->Own.bytesOf(this->NextToLoad);
  std::uint64_t& loaded = this->Ranks[std::size_t(rank)].LoadedBytes;
  if (loaded > 0 && loaded + bytes > this->Memory.LoadedBytes)
  {
    return -1;
  }
  loaded += bytes;
  return this->NextToLoad--;
}

void PieceRun::loadPieces()
{
  Lock lock(this->Mutex);
  while (!this->Stopped && this->NextToLoad >= 0)
  {
    const PartitionIndex piece = this->takeToLoad(0);
    if (piece < 0)
    {
      if (this->NextToLoad >= 0)
      {
        this->Changed.wait(lock);
      }
      continue;
    }
    const std::vector<PartitionIndex> finished = this->Schedule->finishedPartitions(piece);
    lock.unlock();
    this->Own.load(piece, finished);
    lock.lock();
    this->addLoaded(piece, 0, lock);
  }
}

void PieceRun::addLoaded(PartitionIndex piece, int rank, Lock& lock)
{
  if (this->Schedule->addLoaded(piece, rank))
  {
    this->finishPiece(piece, lock);
  }
  this->Changed.notify_all();
}

PartitionIndex PieceRun::acquire(Place& place)
{
  Lock lock(this->Mutex);
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
void PieceRun::tell(Lock& lock)
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

void PieceRun::bringBack(PartitionResult result)
{
  const PartitionIndex piece = this->Work.Plan.PieceOf[std::size_t(result.Partition)];
  Lock lock(this->Mutex);
  this->PointsDone += result.Points;
  this->Figures.Duplicates += result.Duplicates;
  this->Figures.WorkerVertices += result.Vertices;
  const bool isWhole = this->Schedule->complete(std::move(result));
  this->countRim();
  this->Changed.notify_all();
  this->tell(lock);
  if (isWhole && !this->Stopped)
  {
    this->finishPiece(piece, lock);
  }
  this->writeBorders(lock);
  this->saveSometimes();
}

void PieceRun::countRim()
{
  this->Figures.PeakRimTriangles =
    std::max(this->Figures.PeakRimTriangles, std::int64_t(this->Schedule->rimTriangles()));
  this->Figures.PeakRimBytes = std::max(this->Figures.PeakRimBytes, this->Schedule->rimBytes());
  if (this->SpilledRim)
  {
    const std::uint64_t written = this->SpilledRim->written();
    this->Figures.RimSpilledBytes += written - std::exchange(this->RimBytesCounted, written);
  }
}

void PieceRun::takeInterior(PartitionIndex piece, GrowingPiece interior)
{
  this->Schedule->finishInterior(piece, std::move(interior));
  const std::uint64_t bytes = this->Own.bytesOf(piece);
  this->Ranks[std::size_t(this->Schedule->rankOf(piece))].LoadedBytes -= bytes;
  this->BytesSinceSaved += bytes;
  this->Figures.PeakBorderBytes =
    std::max(this->Figures.PeakBorderBytes, this->Schedule->borderBytes());
  this->Changed.notify_all();
}

void PieceRun::writeBorders(Lock& lock)
{
  while (!this->Stopped)
  {
    const PartitionIndex piece = this->Schedule->takeComplete();
    if (piece < 0)
    {
      return;
    }
    lock.unlock();
    const std::size_t number = this->Work.Plan.number(piece);
    FinishedPiece finished =
      this->Schedule->border(piece).writeBorder(this->Work.Mesh, number, this->Work.Rows);
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
    this->bringBack(this->Own.triangulate(place, partition));
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
  const auto work = [this] { this->guard([this] { this->work(); }); };
  std::vector<std::thread> threads;
  try
  {
    threads.emplace_back([this] { this->guard([this] { this->loadPieces(); }); });
    for (int i = this->hasOtherRanks() ? 0 : 1; i < this->Threads; ++i)
    {
      threads.emplace_back(work);
    }
  }
  catch (...)
  {
    this->stop(std::current_exception());
  }
  this->hasOtherRanks() ? this->guard([this] { this->serve(); }) : work();
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
  Lock lock(this->Mutex);
  this->tell(lock); // of what the other threads did last
}

/// What an earlier run has left unfinished must not take the place of this one's files. Pieces are
/// written anew.
void PieceRun::clearPieces()
{
  if (this->Work.Mesh.Path.empty())
  {
    return;
  }
  std::error_code ignored; // what cannot be removed cannot be written either
  const auto folder = std::filesystem::path(this->Work.Mesh.piecePath(0)).parent_path();
  std::filesystem::create_directories(folder, ignored);
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
  {
    if (entry.path().extension() == GrowingPiece::NextName)
    {
      std::filesystem::remove(entry.path(), ignored);
    }
  }
}

/// A run from the beginning.
void PieceRun::start()
{
  this->clearPieces();
  this->Schedule = std::make_unique<PieceSchedule>(this->Work.Plan, this->Work.Points,
    this->Work.Rows, this->Work.Plan.initialMesh(this->Threads));
  this->useFiles();
  // Pieces without points may own triangles all the same.
  for (PartitionIndex piece = 0; piece < this->Work.Plan.pieces(); ++piece)
  {
    if (this->Work.Points.count(piece) == 0)
    {
      GrowingPiece empty = this->Schedule->growing(piece);
      empty.writeInterior(this->Work.Mesh, this->Work.Plan.number(piece), this->Work.Rows, {});
      this->Schedule->finishInterior(piece, std::move(empty));
    }
  }
}

void PieceRun::useFiles()
{
  if (this->Aside)
  {
    this->Schedule->putAside(*this->Aside, this->Memory.BorderBytes);
    this->Schedule->spillRim(*this->SpilledRim, this->Memory.RimBytes);
  }
}

bool PieceRun::triangulate()
{
  if (!this->startFromCheckpoint())
  {
    this->start();
  }
  this->runThreads();
  Lock lock(this->Mutex);
  if (!this->Stopped)
  {
    this->writeBorders(lock);
    this->Schedule->repairHull();
    this->writeBorders(lock);
  }
  if (!this->CheckpointPath.empty())
  {
    this->saveNow();
  }
  return !this->Stopped;
}

bool PieceRun::writePointsAlone()
{
  for (PartitionIndex piece = 0; piece < this->Work.Plan.pieces(); ++piece)
  {
    this->Figures.Duplicates +=
      this->Own.writePointsAlone(piece, this->Finished[this->Work.Plan.number(piece)]);
    this->PointsDone += this->Work.Points.count(piece);
    if (!this->Progress(this->PointsDone))
    {
      return false;
    }
  }
  return true;
}

bool PieceRun::triangulateAlone()
{
  PartitionResult result;
  const bool isDone = this->Own.triangulateAlone([this](std::size_t inserted)
    { return this->Progress(std::int64_t(inserted)); },
    result, this->Finished[0]);
  this->Figures.Duplicates = result.Duplicates;
  this->Figures.WorkerVertices = result.Vertices;
  return isDone;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
// The part of PieceRun that saves its state and goes on from it.
#include "OutOfCore/PieceRun.h"

#include "Files/IOError.h"

#include <filesystem>
#include <utility>

namespace tipp
{

template <typename Archive>
void PieceRun::exchangeFinished(Archive& archive)
{
  archive(this->Duplicates);
  archive(this->WorkerVertices);
  archive(this->PeakRimTriangles);
  archive(this->PeakBorderBytes);
  archive(this->PointsDone);
  for (FinishedPiece& piece : this->Finished)
  {
    exchange(archive, piece);
  }
}

void PieceRun::save(SaveArchive& archive)
{
  this->exchangeFinished(archive);
  this->Schedule->save(archive);
}

/// So seldom that it is an eighth of what is written at most.
void PieceRun::saveSometimes(std::unique_lock<std::mutex>& lock)
{
  constexpr std::uint64_t part = 8;
  if (this->CheckpointPath.empty() || this->IsSaving || this->Stopped ||
    this->BytesSinceSaved == 0 || this->BytesSinceSaved < part * this->SavedBytes)
  {
    return;
  }
  this->IsSaving = true;
  this->BytesSinceSaved = 0;
  SaveArchive archive;
  archive.Writer.reserve(this->SavedBytes + this->SavedBytes / 4); // it grows slowly
  this->save(archive);
  this->SavedBytes = archive.Writer.size();
  lock.unlock();
  writeCheckpoint(this->CheckpointPath, archive);
  lock.lock();
  this->IsSaving = false;
}

bool PieceRun::startFromCheckpoint()
{
  std::error_code ignored;
  if (this->CheckpointPath.empty() || !std::filesystem::exists(this->CheckpointPath, ignored))
  {
    return false;
  }
  try
  {
    const Bytes bytes = readCheckpoint(this->CheckpointPath);
    LoadArchive archive(bytes);
    this->exchangeFinished(archive);
    this->Schedule = std::make_unique<PieceSchedule>(this->Plan, this->Points, this->Rows, archive);
  }
  catch (const IOError&)
  {
    throw;
  }
  catch (const std::runtime_error&)
  {
    throw IOError(this->CheckpointPath, "is not of this run; remove its folder and start again.");
  }
  for (PartitionIndex piece = this->Plan.pieces() - 1; piece >= 0; --piece)
  {
    if (this->Schedule->wasLoaded(piece))
    {
      this->reload(piece);
    }
  }
  return true;
}

void PieceRun::reload(PartitionIndex piece)
{
  std::unique_ptr<LoadedPiece> loaded = this->load(piece);
  this->makeInteriors(piece, *loaded);
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->LoadedBytes += this->bytesOf(piece);
  if (this->Schedule->addLoaded(piece, std::move(loaded)))
  {
    this->finishPiece(piece, lock);
  }
}

/// Interior triangles depend on a partition's own points alone, so those of finished partitions are
/// made again rather than saved.
void PieceRun::makeInteriors(PartitionIndex piece, LoadedPiece& loaded) const
{
  const PartitionIndex first = this->Plan.FirstPartition[std::size_t(piece)];
  Worker<std::int32_t> worker(this->Plan.Partitions, loaded.Buckets);
  worker.setTiling(this->Plan.Partitions, -first);
  for (PartitionIndex p = 0; p < loaded.Buckets.partitions(); ++p)
  {
    if (!this->Schedule->isFinished(first + p))
    {
      continue;
    }
    worker.triangulate(first + p, this->Plan.Artificial);
    loaded.InteriorCounts[std::size_t(p)] = worker.interiorCount();
    for (const Duplicate& duplicate : worker.duplicates())
    {
      loaded.Representatives.emplace(
        std::int32_t(duplicate.Point), std::int32_t(duplicate.Representative));
    }
  }
}

} // namespace tipp

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
void PieceRun::saveSometimes(Lock& lock)
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
    this->Schedule =
      std::make_unique<PieceSchedule>(this->Work.Plan, this->Work.Points, this->Work.Rows, archive);
  }
  catch (const IOError&)
  {
    throw;
  }
  catch (const std::runtime_error&)
  {
    throw IOError(this->CheckpointPath, "is not of this run; remove its folder and start again.");
  }
  return true;
}

} // namespace tipp

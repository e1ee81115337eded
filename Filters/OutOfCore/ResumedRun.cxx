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
  archive(this->PeakRimBytes);
  archive(this->RimSpilledBytes);
  archive(this->PeakBorderBytes);
  archive(this->PointsDone);
  for (FinishedPiece& piece : this->Finished)
  {
    exchange(archive, piece);
  }
}

void PieceRun::save(SaveArchive& archive)
{
  archive(this->Aside ? this->Aside->end() : std::uint64_t(0));
  this->exchangeFinished(archive);
  this->Schedule->save(archive);
}

std::uint64_t PieceRun::saveNow()
{
  return writeCheckpoint(
    this->CheckpointPath, [this](SaveArchive& archive) { this->save(archive); });
}

/// So seldom that it is an eighth of what is written at most.
void PieceRun::saveSometimes()
{
  constexpr std::uint64_t part = 8;
  if (this->CheckpointPath.empty() || this->Stopped || this->BytesSinceSaved == 0 ||
    this->BytesSinceSaved < part * this->SavedBytes)
  {
    return;
  }
  this->BytesSinceSaved = 0;
  this->SavedBytes = this->saveNow();
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
    std::uint64_t end = 0;
    archive(end);
    this->Aside->goOnFrom(end);
    this->exchangeFinished(archive);
    this->Schedule =
      std::make_unique<PieceSchedule>(this->Work.Plan, this->Work.Points, this->Work.Rows, archive);
    this->useFiles();
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

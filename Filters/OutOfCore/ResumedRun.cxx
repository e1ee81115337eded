// SPDX-License-Identifier: BSD-3-Clause
// The part of PieceRun that saves its state and goes on from it.
#include "OutOfCore/PieceRun.h"

#include "Files/IOError.h"
#include "Parallel/ForChunks.h"

#include <filesystem>
#include <utility>

namespace tipp
{

void PieceRun::save(SaveArchive& archive)
{
  archive(this->Aside ? this->Aside->end() : std::uint64_t(0));
  archive(this->Figures);
  archive(this->PointsDone);
  for (FinishedPiece& piece : this->Finished)
  {
    exchange(archive, piece);
  }
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

/// False if there is no saved state, or what belongs to it is damaged: the spilled points are
/// enough to start from.
bool PieceRun::startFromCheckpoint()
{
  std::error_code ignored;
  if (this->CheckpointPath.empty() || !std::filesystem::exists(this->CheckpointPath, ignored))
  {
    return false;
  }
  try
  {
    this->loadCheckpoint();
    this->Stopped = !this->verifyWritten();
  }
  catch (const IOError& error)
  {
    this->Figures = {};
    this->PointsDone = 0;
    this->Finished.assign(this->Finished.size(), {});
    this->Aside->goOnFrom(0);
    this->Warn(error.path() +
      ": is damaged or missing; all pieces are made again from the points that were spilled.");
    return false;
  }
  if (!this->Stopped)
  {
    this->isolateInteriors();
  }
  this->useFiles();
  return true;
}

void PieceRun::loadCheckpoint()
{
  const Bytes bytes = readCheckpoint(this->CheckpointPath);
  LoadArchive archive(bytes);
  std::uint64_t asideEnd = 0;
  archive(asideEnd);
  this->Aside->goOnFrom(asideEnd);
  archive(this->Figures);
  archive(this->PointsDone);
  for (FinishedPiece& piece : this->Finished)
  {
    exchange(archive, piece);
  }
  this->Schedule =
    std::make_unique<PieceSchedule>(this->Work.Plan, this->Work.Points, this->Work.Rows, archive);
  this->Schedule->putAside(*this->Aside, this->Memory.BorderBytes);
}

/// Reads what earlier processes have written of pieces. False if progress ended it.
bool PieceRun::verifyWritten()
{
  return forChunks(
    this->Work.Plan.pieces(), 1, this->Threads,
    [this](double) { return this->Progress(this->PointsDone); },
    [this](std::int64_t at, std::int64_t, int)
    {
      const auto piece = static_cast<PartitionIndex>(at);
      const std::size_t number = this->Work.Plan.number(piece);
      if (this->Schedule->hasInterior(piece))
      {
        this->Schedule->border(piece).verifyInterior(this->Work.Mesh, number);
      }
      else if (this->Schedule->isDone(piece))
      {
        verifyFinished(this->Work.Mesh, number, this->Finished[number]);
      }
    });
}

void PieceRun::isolateInteriors()
{
  for (PartitionIndex piece = 0; piece < this->Work.Plan.pieces(); ++piece)
  {
    if (this->Schedule->hasInterior(piece))
    {
      this->Schedule->border(piece).isolateInterior(this->Work.Mesh, this->Work.Plan.number(piece));
    }
  }
}

} // namespace tipp

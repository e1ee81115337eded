// SPDX-License-Identifier: BSD-3-Clause
// The part of PieceSchedule that saves and restores it.
#include "OutOfCore/PieceSchedule.h"

namespace tipp
{
namespace
{

std::vector<PartitionIndex> readUnfinished(LoadArchive& archive, const PiecePlan& plan)
{
  std::vector<PartitionIndex> unfinished;
  archive(unfinished);
  for (const PartitionIndex p : unfinished)
  {
    if (p < 0 || p >= plan.Partitions.size())
    {
      throw std::runtime_error("A saved partition is not in the tiling.");
    }
  }
  return unfinished;
}

} // namespace

template <typename Archive>
void PieceSchedule::exchangePiece(Archive& archive, PartitionIndex piece)
{
  constexpr bool isSaving = std::is_same<Archive, SaveArchive>::value;
  State& state = this->Pieces[std::size_t(piece)];
  archive(state.WaitsForHull);
  Stage stage = state.At == Stage::Taken ? Stage::Interior : state.At;
  archive(stage);
  if constexpr (isSaving)
  {
    if (stage == Stage::Loaded)
    {
      archive(state.Loaded->Seams);
      std::vector<std::int32_t> rim;
      for (std::size_t i = 0; i < state.Loaded->Rim.size(); ++i)
      {
        if (state.Loaded->Rim[i] != 0)
        {
          rim.push_back(std::int32_t(i));
        }
      }
      archive(rim);
    }
  }
  else
  {
    state.WasLoaded = stage == Stage::Loaded;
    state.At = state.WasLoaded ? Stage::Waiting : stage;
    if (state.WasLoaded)
    {
      archive(state.SavedSeams);
      archive(state.SavedRim);
    }
  }
  if (stage == Stage::Interior)
  {
    state.Growing.exchangeInterior(archive);
  }
  if (stage != Stage::Done)
  {
    state.Growing.exchangeBorder(archive);
  }
}

void PieceSchedule::save(SaveArchive& archive)
{
  std::vector<PartitionIndex> unfinished;
  for (PartitionIndex p = 0; p < this->Plan.Partitions.size(); ++p)
  {
    if (!this->isFinished(p))
    {
      unfinished.push_back(p);
    }
  }
  archive(unfinished);
  this->Rim.liveGroups().write(archive.Writer);
  archive(this->Hull);
  archive(this->HullRepaired);
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    this->exchangePiece(archive, piece);
  }
}

PieceSchedule::PieceSchedule(const PiecePlan& plan, const SpilledPoints& points,
  const PointRowLayout& rows, LoadArchive& archive)
  : PieceSchedule(plan, points, rows, readUnfinished(archive, plan))
{
  this->Rim.add(SeamGroups::read(archive.Reader));
  archive(this->Hull);
  archive(this->HullRepaired);
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    this->exchangePiece(archive, piece);
  }
}

} // namespace tipp

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
  State& state = this->Pieces[std::size_t(piece)];
  archive(state.WaitsForHull);
  archive(state.RowsMissing);
  Stage stage = state.At < Stage::Interior ? Stage::Waiting
    : state.At == Stage::Taken             ? Stage::Interior
                                           : state.At;
  archive(stage);
  if (stage < Stage::Interior)
  {
    archive(state.Seams);
    archive(state.Wanted);
    this->exchangeRim(archive, piece);
  }
  if (stage == Stage::Interior)
  {
    archive(state.Aside);
    state.Growing.exchangeInterior(archive);
  }
  if (stage != Stage::Done)
  {
    state.Growing.exchangeBorder(archive);
  }
  if constexpr (std::is_same<Archive, LoadArchive>::value)
  {
    state.At = stage;
  }
}

template <typename Archive>
void PieceSchedule::exchangeRim(Archive& archive, PartitionIndex piece)
{
  std::vector<std::uint8_t>& rim = this->Pieces[std::size_t(piece)].Rim;
  std::vector<std::int32_t> places = placesOfRim(rim);
  archive(places);
  if (!places.empty())
  {
    rim.assign(std::size_t(this->Points.count(piece)), 0);
  }
  for (const std::int32_t place : places)
  {
    rim.at(std::size_t(place)) = 1;
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
  this->Rim.save(archive.Writer);
  this->Hull.exchange(archive);
  archive(this->HullRepaired);
  archive(this->WantedFromAside);
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    this->exchangePiece(archive, piece);
  }
}

PieceSchedule::PieceSchedule(const PiecePlan& plan, const SpilledPoints& points,
  const PointRowLayout& rows, LoadArchive& archive)
  : PieceSchedule(plan, points, rows, readUnfinished(archive, plan))
{
  this->Rim.restore(archive.Reader);
  this->Hull.exchange(archive);
  archive(this->HullRepaired);
  archive(this->WantedFromAside);
  for (PartitionIndex piece = 0; piece < this->pieces(); ++piece)
  {
    this->exchangePiece(archive, piece);
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
// The parts of PiecePlan and SpilledPoints that save and restore them.
#include "Files/IOError.h"
#include "OutOfCore/Checkpoint.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/SpillPoints.h"
#include "Triangulation/InitialMesh.h"

namespace tipp
{

void PiecePlan::save(SaveArchive& archive) const
{
  archive(this->IsAlone);
  archive(this->Pieces.save());
  for (const Tiling& inner : this->Inner)
  {
    archive(inner.save());
  }
  archive(this->Initial);
}

PiecePlan::PiecePlan(LoadArchive& archive)
{
  archive(this->IsAlone);
  const auto loadTiling = [&]
  {
    std::vector<char> bytes;
    archive(bytes);
    return Tiling::load(bytes);
  };
  this->Pieces = loadTiling();
  for (PartitionIndex piece = 0; piece < this->Pieces.size(); ++piece)
  {
    this->Inner.push_back(loadTiling());
  }
  archive(this->Initial);
  this->numberPartitions();
  if (!this->IsAlone)
  {
    this->Artificial = makeArtificialPoints(this->Partitions);
  }
}

void SpilledPoints::save(SaveArchive& archive) const
{
  archive(this->Starts);
  archive(this->Rows.save());
}

SpilledPoints::SpilledPoints(
  const std::string& file, const PiecePlan& plan, const PointRowLayout& rows, LoadArchive& archive)
  : Starts(
      [&]
      {
        std::vector<std::int64_t> starts;
        archive(starts);
        return starts;
      }())
  , Rows(file, std::size_t(plan.pieces()), 8 * rows.Words,
      [&]
      {
        std::vector<std::uint64_t> saved;
        archive(saved);
        return saved;
      }())
{
  bool isOurs = this->Starts.size() == std::size_t(plan.pieces()) + 1 && this->Starts[0] == 0;
  for (PartitionIndex piece = 0; isOurs && piece < plan.pieces(); ++piece)
  {
    isOurs = this->count(piece) == this->Rows.rows(std::size_t(piece));
  }
  if (!isOurs)
  {
    throw IOError(file, "has points of other pieces; start again.");
  }
}

} // namespace tipp

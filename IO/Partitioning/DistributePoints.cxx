// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/DistributePoints.h"

#include "Files/InputFile.h"
#include "Parallel/Poll.h"
#include "Partitioning/Columns.h"
#include "Partitioning/ForeignPoint.h"
#include "Partitioning/PartitionRun.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// A copy of a point for a piece.
struct Copy
{
  std::uint32_t Place; ///< the point's index in the chunk
  std::int32_t Piece;
  std::uint64_t Flags;
};

class PointDistribution
{
public:
  explicit PointDistribution(PartitionRun& run)
    : Run(run)
    , Homes(run.homes().Path)
    , Data(columnsOf(run))
  {
  }

  void spillChunk(std::int64_t chunk);

private:
  static std::vector<RawArray> columnsOf(const PartitionRun& run)
  {
    std::vector<RawArray> columns{ run.Mesh.Points };
    columns.insert(columns.end(), run.PointData.begin(), run.PointData.end());
    return columns;
  }

  std::vector<ForeignPoint> foreignPoints(std::int64_t chunk) const;
  std::vector<Copy> copiesOf(std::int64_t chunk, std::int64_t first, std::int64_t count) const;

  PartitionRun& Run;
  InputFile Homes;
  Columns Data;
};

std::vector<ForeignPoint> PointDistribution::foreignPoints(std::int64_t chunk) const
{
  const std::vector<char> raw = this->Run.ForeignPoints->readAll(std::size_t(chunk));
  std::vector<ForeignPoint> points(raw.size() / sizeof(ForeignPoint));
  if (points.empty())
  {
    return points;
  }
  std::memcpy(points.data(), raw.data(), points.size() * sizeof(ForeignPoint));
  makeDistinct(points);
  return points;
}

std::vector<Copy> PointDistribution::copiesOf(
  std::int64_t chunk, std::int64_t first, std::int64_t count) const
{
  std::vector<std::int32_t> homes(static_cast<std::size_t>(count));
  this->Homes.read(std::uint64_t(first) * 4, homes.data(), homes.size() * 4);
  const std::vector<ForeignPoint> foreign = this->foreignPoints(chunk);
  std::vector<Copy> copies;
  copies.reserve(homes.size() + foreign.size());
  auto next = foreign.begin();
  for (std::uint32_t i = 0; i < homes.size(); ++i)
  {
    pollAt(i);
    copies.push_back({ i, homes[i] < 0 ? -1 - homes[i] : homes[i], 0 });
    for (; next != foreign.end() && next->Point == first + i; ++next)
    {
      const std::uint64_t ghost = next->GhostOnly != 0 ? RowLayout::GhostOnly : 0;
      copies.push_back({ i, next->Piece, RowLayout::Foreign | ghost });
    }
  }
  return copies;
}

void PointDistribution::spillChunk(std::int64_t chunk)
{
  const std::int64_t first = chunk * this->Run.ChunkPoints;
  const std::int64_t count = std::min(this->Run.ChunkPoints, this->Run.Mesh.Points.Tuples - first);
  this->Data.read(first, count, this->Run.Threads);
  const std::vector<Copy> copies = this->copiesOf(chunk, first, count);
  poll();
  this->Run.Statistics.CopiedPoints += std::int64_t(copies.size()) - count;
  this->Run.Points->add(
    copies.size(), this->Run.Threads, [&](std::size_t i) { return copies[i].Piece; },
    [&](std::size_t i, char* to)
    {
      const std::uint64_t id = std::uint64_t(first + copies[i].Place) << 2 | copies[i].Flags;
      std::memcpy(to, &id, 8);
      this->Data.copyRow(copies[i].Place, to + 8);
    });
}

} // namespace

void distributePoints(PartitionRun& run)
{
  const Ranks& ranks = run.Team;
  ranks.attempt(
    [&]
    {
      run.Points.emplace(run.scratch("points"), ranks.rank(), run.pieces(), run.Rows.PointBytes);
      const std::int64_t chunks = (run.Mesh.Points.Tuples + run.ChunkPoints - 1) / run.ChunkPoints;
      const auto [first, last] = ranks.shareOf(chunks);
      PointDistribution distribution(run);
      for (std::int64_t chunk = first; chunk < last; ++chunk)
      {
        distribution.spillChunk(chunk);
        run.report(0.5 + 0.2 * double(chunk + 1 - first) / double(last - first));
      }
    });
  run.Statistics.SpilledBytes += run.Points->bytes();
  run.Points->exchange(ranks);
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Query/PieceIds.h"

#include "Arrays/SortUnique.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Partitioned/PieceFile.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace tipp
{

/// Reads the global ids of the cells or points that a piece owns.
std::vector<std::int64_t> PieceIds::read(std::size_t piece, bool ofPoints) const
{
  const PieceFile file(this->Mesh, piece);
  // Borrowed cells are in the last part of the piece, if they are duplicated.
  const std::size_t parts = file.partStarts(ofPoints).size() - 1 - (this->Mesh.Duplicated ? 1 : 0);
  const auto count = std::size_t(file.partStarts(ofPoints)[parts]);
  std::vector<std::int64_t> ids(count);
  file.read(file.find(ofPoints ? PieceRole::PointIds : PieceRole::CellIds), 0, parts, ids.data());
  file.requireIds(ids.data(), count, ofPoints ? this->Mesh.Points : this->Mesh.Cells);
  if (ofPoints)
  {
    std::vector<std::uint8_t> ghosts(count);
    file.read(file.find(PieceRole::PointGhosts), 0, parts, ghosts.data());
    std::size_t own = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      ids[own] = ids[i];
      own += ghosts[i] == 0 ? 1 : 0;
    }
    ids.resize(own);
  }
  return ids;
}

std::vector<std::int32_t> PieceIds::find(const std::vector<std::int64_t>& ids, bool ofPoints,
  int threads, std::size_t firstPiece, std::size_t endPiece) const
{
  const std::vector<std::int64_t> asked = sortedUnique(ids);
  const GlobalIdMap map(asked.data(), nullptr, asked.size());
  std::vector<std::int32_t> owners(asked.size(), -1);
  std::vector<Range> ranges;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Ranges[ofPoints].resize(this->Mesh.Pieces.size());
    ranges = this->Ranges[ofPoints];
  }
  // Searches pieces with a known range of ids first, since these may own all ids.
  std::vector<std::size_t> order(endPiece - firstPiece);
  std::iota(order.begin(), order.end(), firstPiece);
  std::stable_partition(order.begin(), order.end(),
    [&ranges](std::size_t piece) { return ranges[piece].High != INT64_MAX; });
  std::atomic<std::size_t> missing{ asked.size() };
  forChunks(std::int64_t(order.size()), 1, threads, {},
    [&](std::int64_t i, std::int64_t, int)
    {
      poll();
      const std::size_t piece = order[std::size_t(i)];
      Range& range = ranges[piece];
      const auto first = std::lower_bound(asked.begin(), asked.end(), range.Low);
      if (missing == 0 || first == asked.end() || *first > range.High)
      {
        return;
      }
      const std::vector<std::int64_t> own = this->read(piece, ofPoints);
      range = own.empty() ? Range{ INT64_MAX, -1 }
                          : Range{ *std::min_element(own.begin(), own.end()),
                              *std::max_element(own.begin(), own.end()) };
      for (const std::int64_t id : own)
      {
        const std::int64_t at = map.find(id);
        if (at >= 0)
        {
          owners[std::size_t(at)] = std::int32_t(piece);
          --missing;
        }
      }
    });
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Ranges[ofPoints] = ranges;
  }
  std::vector<std::int32_t> result;
  result.reserve(ids.size());
  for (const std::int64_t id : ids)
  {
    const std::int64_t at = map.find(id);
    result.push_back(owners[std::size_t(at)]);
  }
  return result;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PartitionJob.h"

#include "Files/OutputFile.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Partitioned/PieceWriter.h"
#include "Partitioning/PartitionMesh.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tipp
{

RawArray PartitionJob::owners() const
{
  return { "owners", this->scratch("owners"), 0, Scalar::Int32, 1, this->Mesh.Points.Tuples };
}

LoaderOptions PartitionJob::loaderOptions() const
{
  LoaderOptions options = this->Options.Loading;
  options.MemoryLimit = this->Options.MemoryLimit / 4;
  options.Threads = this->Threads;
  return options;
}

void PartitionJob::report(double fraction)
{
  this->Fraction = fraction;
  poll();
}

namespace
{

/// Greedy runs of weight at most `most`, which no single piece exceeds, leaving at least one piece
/// for each later rank. The last rank gets the rest.
std::vector<std::size_t> runsOf(
  const std::vector<std::int64_t>& weights, std::size_t ranks, std::int64_t most)
{
  std::vector<std::size_t> starts = { 0 };
  std::size_t piece = 0;
  for (std::size_t later = ranks - 1; later > 0; --later)
  {
    const std::size_t end = weights.size() > later ? weights.size() - later : 0;
    std::int64_t sum = 0;
    const std::size_t first = piece;
    for (; piece < end && weights[piece] <= most - sum; ++piece)
    {
      sum += weights[piece];
    }
    // With fewer pieces than ranks, the first ranks get one each.
    piece = std::min(std::max(piece, first + 1), weights.size());
    starts.push_back(piece);
  }
  starts.push_back(weights.size());
  return starts;
}

} // namespace

std::vector<std::size_t> assignPieces(std::vector<std::int64_t> weights, int ranks)
{
  std::int64_t low = 0;
  std::int64_t high = 0;
  for (std::int64_t& weight : weights)
  {
    weight = std::max<std::int64_t>(weight, 0);
    low = std::max(low, weight);
    high += weight;
  }
  const auto count = static_cast<std::size_t>(std::max(ranks, 1));
  // Bisection for the least possible weight of the heaviest run.
  while (low < high)
  {
    const std::int64_t most = low + (high - low) / 2;
    const auto last = std::ptrdiff_t(runsOf(weights, count, most)[count - 1]);
    if (std::accumulate(weights.begin() + last, weights.end(), std::int64_t(0)) <= most)
    {
      high = most;
    }
    else
    {
      low = most + 1;
    }
  }
  return runsOf(weights, count, low);
}

namespace
{

/// This rank's pieces: [first, last).
std::pair<std::size_t, std::size_t> shareOfPieces(const PartitionJob& job)
{
  std::vector<std::int64_t> weights;
  for (std::size_t piece = 0; piece < job.pieces(); ++piece)
  {
    weights.push_back(1 + job.Cells->rows(piece) + job.Points->rows(piece));
  }
  const std::vector<std::size_t> starts = assignPieces(weights, job.Team.size());
  const auto rank = std::size_t(job.Team.rank());
  return { starts[rank], starts[rank + 1] };
}

std::size_t bufferBytes(const PartitionJob& job)
{
  const std::size_t columns = job.Result.Arrays.size() + 8;
  const std::size_t share =
    std::size_t(job.Options.MemoryLimit / 8) / (columns * std::size_t(job.Threads));
  return std::clamp<std::size_t>(share, std::size_t(1) << 14, std::size_t(1) << 19);
}

std::vector<FinishedPiece> writeShare(PartitionJob& job)
{
  const auto [first, last] = shareOfPieces(job);
  // The heaviest first, for load balance.
  std::vector<std::size_t> order(last - first);
  std::iota(order.begin(), order.end(), first);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return job.Cells->rows(a) > job.Cells->rows(b); });
  std::vector<FinishedPiece> finished(order.size());
  forChunks(
    std::int64_t(order.size()), 1, job.Threads,
    [&job](double done)
    {
      job.report(0.7 + 0.25 * done);
      return true;
    },
    [&, first = first](std::int64_t i, std::int64_t, int)
    {
      const std::size_t piece = order[std::size_t(i)];
      finished[piece - first] = writeSpilledPiece(job, piece, bufferBytes(job));
    });
  return finished;
}

} // namespace

void writePieces(PartitionJob& job)
{
  std::vector<FinishedPiece> mine;
  job.Team.attempt([&] { mine = writeShare(job); });
  const std::vector<std::vector<FinishedPiece>> all = job.Team.gather(mine);
  job.Team.attempt(
    [&]
    {
      // The data have been written back to the disk since the first piece was complete.
      const auto [first, last] = shareOfPieces(job);
      for (std::size_t piece = first; piece < last; ++piece)
      {
        poll();
        syncToDisk(job.Result.piecePath(piece));
      }
    });
  job.Team.attempt(
    [&]
    {
      if (job.Team.isFirst())
      {
        std::vector<FinishedPiece> pieces;
        for (const std::vector<FinishedPiece>& ofRank : all)
        {
          pieces.insert(pieces.end(), ofRank.begin(), ofRank.end());
        }
        job.Statistics.MeshBytes = publishPieces(job.Result, pieces).Bytes;
      }
    });
}

} // namespace tipp

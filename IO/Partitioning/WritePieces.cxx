// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputFile.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Partitioned/PublishPieces.h"
#include "Partitioning/PartitionJob.h"
#include "Partitioning/PartitionMesh.h"
#include "Partitioning/SpilledPieceWriter.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

std::int64_t weightOf(const std::vector<std::int64_t>& weights, std::size_t piece)
{
  return std::max<std::int64_t>(weights[piece], 0);
}

// Greedy runs of weight at most `most`, leaving at least one piece for each later rank. The last
// rank gets the rest.
std::vector<std::size_t> runsOf(
  const std::vector<std::int64_t>& weights, std::size_t ranks, std::int64_t most)
{
  std::vector<std::size_t> starts = { 0 };
  std::size_t piece = 0;
  for (std::size_t rank = 0; rank + 1 < ranks; ++rank)
  {
    const std::size_t later = ranks - 1 - rank;
    const std::size_t end = weights.size() > later ? weights.size() - later : 0;
    std::int64_t sum = 0;
    const std::size_t first = piece;
    while (piece < end && (piece == first || weightOf(weights, piece) <= most - sum))
    {
      sum += weightOf(weights, piece);
      ++piece;
    }
    // With fewer pieces than ranks, the first ranks get one each.
    piece = std::min(std::max(piece, first + 1), weights.size());
    starts.push_back(piece);
  }
  starts.push_back(weights.size());
  return starts;
}

std::int64_t heaviest(
  const std::vector<std::int64_t>& weights, const std::vector<std::size_t>& starts)
{
  std::int64_t most = 0;
  for (std::size_t rank = 0; rank + 1 < starts.size(); ++rank)
  {
    std::int64_t sum = 0;
    for (std::size_t piece = starts[rank]; piece < starts[rank + 1]; ++piece)
    {
      sum += weightOf(weights, piece);
    }
    most = std::max(most, sum);
  }
  return most;
}

} // namespace

std::vector<std::size_t> assignPieces(const std::vector<std::int64_t>& weights, int ranks)
{
  const auto count = static_cast<std::size_t>(std::max(ranks, 1));
  std::int64_t low = 0;
  std::int64_t high = 0;
  for (std::size_t piece = 0; piece < weights.size(); ++piece)
  {
    low = std::max(low, weightOf(weights, piece));
    high += weightOf(weights, piece);
  }
  // Bisection for the least possible weight of the heaviest run.
  while (low < high)
  {
    const std::int64_t most = low + (high - low) / 2;
    if (heaviest(weights, runsOf(weights, count, most)) <= most)
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
  const std::vector<std::size_t> starts = assignPieces(weights, job.Team.count());
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
  std::atomic<std::size_t> done{ 0 };
  // Only the calling thread may report progress; it does so after each batch.
  const std::size_t batch = std::max<std::size_t>(std::size_t(job.Threads), order.size() / 16);
  for (std::size_t at = 0; at < order.size(); at += batch)
  {
    const std::size_t count = std::min(batch, order.size() - at);
    parallelFor(std::int64_t(count), job.Threads,
      [&, at, first = first](std::int64_t i)
      {
        const std::size_t piece = order[at + std::size_t(i)];
        SpilledPieceWriter writer(job, piece, bufferBytes(job));
        writer.write();
        finished[piece - first] = { writer.summary(), writer.table() };
        ++done;
      });
    job.report(0.7 + 0.25 * double(done) / double(order.size()));
  }
  return finished;
}

/// Serializes a finished piece for the first rank: its summary and, as in tables.bin, its table.
void pack(const FinishedPiece& piece, std::string& bytes)
{
  const std::vector<std::uint64_t> table = packTable(piece.Table);
  const std::uint64_t words = table.size();
  bytes.append(reinterpret_cast<const char*>(&piece.Summary), sizeof(PieceSummary));
  bytes.append(reinterpret_cast<const char*>(&words), 8);
  bytes.append(reinterpret_cast<const char*>(table.data()), table.size() * 8);
}

/// All pieces in order, from the bytes that pack() made on all ranks.
std::vector<FinishedPiece> unpack(const std::vector<std::string>& all, PartitionedMesh& mesh)
{
  std::vector<FinishedPiece> pieces;
  for (const std::string& bytes : all)
  {
    for (std::size_t at = 0; at < bytes.size();)
    {
      const auto take = [&](void* to, std::size_t count)
      {
        bytes.copy(static_cast<char*>(to), count, at);
        at += count;
      };
      PieceSummary& summary = mesh.Pieces[pieces.size()];
      std::uint64_t words = 0;
      take(&summary, sizeof(PieceSummary));
      take(&words, 8);
      std::vector<std::uint64_t> table(words);
      take(table.data(), words * 8);
      pieces.push_back({ summary, unpackTable(mesh, pieces.size(), std::move(table)) });
    }
  }
  return pieces;
}

} // namespace

void writePieces(PartitionJob& job)
{
  std::string mine;
  job.Team.attempt(
    [&]
    {
      for (const FinishedPiece& piece : writeShare(job))
      {
        pack(piece, mine);
      }
    });
  const std::vector<std::string> all = job.Team.gather(mine);
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
        std::vector<FinishedPiece> pieces = unpack(all, job.Result);
        job.Statistics.MeshBytes = publishPieces(job.Result, pieces).Bytes;
      }
    });
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/AssemblePieces.h"

#include "Files/OutputFile.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Partitioned/PublishPieces.h"
#include "Partitioning/AssignPieces.h"
#include "Partitioning/PartitionRun.h"
#include "Partitioning/PieceAssembly.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

/// This rank's pieces: [first, last).
std::pair<std::size_t, std::size_t> shareOfPieces(const PartitionRun& run)
{
  std::vector<std::int64_t> weights;
  for (std::size_t piece = 0; piece < run.pieces(); ++piece)
  {
    weights.push_back(1 + run.Cells->rows(piece) + run.Points->rows(piece));
  }
  const std::vector<std::size_t> starts = assignPieces(weights, run.Team.count());
  const auto rank = std::size_t(run.Team.rank());
  return { starts[rank], starts[rank + 1] };
}

std::size_t bufferBytes(const PartitionRun& run)
{
  const std::size_t columns = run.Result.Arrays.size() + 8;
  const std::size_t share =
    std::size_t(run.Options.MemoryLimit / 8) / (columns * std::size_t(run.Threads));
  return std::clamp<std::size_t>(share, std::size_t(1) << 14, std::size_t(1) << 19);
}

std::vector<FinishedPiece> assembleShare(PartitionRun& run)
{
  const auto [first, last] = shareOfPieces(run);
  // The heaviest first, for load balance.
  std::vector<std::size_t> order(last - first);
  std::iota(order.begin(), order.end(), first);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return run.Cells->rows(a) > run.Cells->rows(b); });
  std::vector<FinishedPiece> finished(order.size());
  std::atomic<std::size_t> done{ 0 };
  // Only the calling thread may report progress; it does so after each batch.
  const std::size_t stretch = std::max<std::size_t>(std::size_t(run.Threads), order.size() / 16);
  for (std::size_t at = 0; at < order.size(); at += stretch)
  {
    const std::size_t count = std::min(stretch, order.size() - at);
    parallelFor(std::int64_t(count), run.Threads,
      [&, at, first = first](std::int64_t i)
      {
        const std::size_t piece = order[at + std::size_t(i)];
        PieceAssembly assembly(run, piece, bufferBytes(run));
        assembly.assemble();
        finished[piece - first] = { assembly.summary(), assembly.table() };
        ++done;
      });
    run.report(0.7 + 0.25 * double(done) / double(order.size()));
  }
  return finished;
}

/// Serialises a finished piece for the first rank: its summary and, as in tables.bin, its table.
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

void assemblePieces(PartitionRun& run)
{
  std::string mine;
  run.Team.attempt(
    [&]
    {
      for (const FinishedPiece& piece : assembleShare(run))
      {
        pack(piece, mine);
      }
    });
  const std::vector<std::string> all = run.Team.gather(mine);
  run.Team.attempt(
    [&]
    {
      // The data have been written back to the disk since the first piece was complete.
      const auto [first, last] = shareOfPieces(run);
      for (std::size_t piece = first; piece < last; ++piece)
      {
        poll();
        syncToDisk(run.Result.piecePath(piece));
      }
    });
  run.Team.attempt(
    [&]
    {
      if (run.Team.isFirst())
      {
        std::vector<FinishedPiece> pieces = unpack(all, run.Result);
        run.Statistics.MeshBytes = publishPieces(run.Result, pieces).Bytes;
      }
    });
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/AssemblePieces.h"

#include "Files/OutputFile.h"
#include "Partitioned/PublishPieces.h"
#include "Partitioning/AssignPieces.h"
#include "Partitioning/PartitionRun.h"
#include "Partitioning/PieceAssembly.h"
#include "Threads/ParallelFor.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

/// [first, last) of this rank.
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
  // The heaviest first, so that threads end together.
  std::vector<std::size_t> order(last - first);
  std::iota(order.begin(), order.end(), first);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return run.Cells->rows(a) > run.Cells->rows(b); });
  std::vector<FinishedPiece> finished(order.size());
  std::atomic<std::size_t> done{ 0 };
  // Progress is for the calling thread alone, which waits; it hears of every stretch.
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

/// A finished piece on its way to the other ranks.
void pack(const FinishedPiece& piece, std::string& bytes)
{
  const auto append = [&](const void* from, std::size_t count)
  { bytes.append(static_cast<const char*>(from), count); };
  const auto appendGroups = [&](const std::vector<LentGroup>& groups)
  {
    const std::uint64_t count = groups.size();
    append(&count, 8);
    for (const LentGroup& group : groups)
    {
      const std::uint64_t head[2] = { std::uint64_t(group.Count), group.To.size() };
      append(head, 16);
      append(group.To.data(), group.To.size() * 4);
    }
  };
  append(&piece.Summary, sizeof(PieceSummary));
  appendGroups(piece.Table.PointGroups);
  appendGroups(piece.Table.CellGroups);
  const std::uint64_t sizes[3] = { piece.Table.HeaderBytes, piece.Table.HeaderChecksum,
    piece.Table.Offsets.size() };
  append(sizes, 24);
  append(piece.Table.Offsets.data(), piece.Table.Offsets.size() * 8);
  for (const std::vector<std::uint64_t>& checksums : piece.Table.Checksums)
  {
    const std::uint64_t count = checksums.size();
    append(&count, 8);
    append(checksums.data(), checksums.size() * 8);
  }
}

/// Takes pieces out of what pack() has made in this very program.
class Unpacker
{
public:
  explicit Unpacker(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  bool atEnd() const { return this->At == this->Bytes.size(); }

  FinishedPiece take()
  {
    FinishedPiece piece;
    this->copy(&piece.Summary, sizeof(PieceSummary));
    piece.Table.PointGroups = this->groups();
    piece.Table.CellGroups = this->groups();
    std::uint64_t sizes[3];
    this->copy(sizes, 24);
    piece.Table.HeaderBytes = sizes[0];
    piece.Table.HeaderChecksum = sizes[1];
    piece.Table.Offsets.resize(sizes[2]);
    this->copy(piece.Table.Offsets.data(), sizes[2] * 8);
    piece.Table.Checksums.resize(sizes[2]);
    for (std::vector<std::uint64_t>& checksums : piece.Table.Checksums)
    {
      checksums.resize(this->word());
      this->copy(checksums.data(), checksums.size() * 8);
    }
    return piece;
  }

private:
  void copy(void* to, std::size_t count)
  {
    this->Bytes.copy(static_cast<char*>(to), count, this->At);
    this->At += count;
  }

  std::uint64_t word()
  {
    std::uint64_t value = 0;
    this->copy(&value, 8);
    return value;
  }

  std::vector<LentGroup> groups()
  {
    std::vector<LentGroup> groups(this->word());
    for (LentGroup& group : groups)
    {
      group.Count = std::int64_t(this->word());
      group.To.resize(this->word());
      this->copy(group.To.data(), group.To.size() * 4);
    }
    return groups;
  }

  const std::string& Bytes;
  std::size_t At = 0;
};

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
      // The system has been writing since the first piece was complete.
      const auto [first, last] = shareOfPieces(run);
      for (std::size_t piece = first; piece < last; ++piece)
      {
        syncToDisk(run.Result.piecePath(piece));
      }
    });
  run.Team.attempt(
    [&]
    {
      std::vector<FinishedPiece> pieces;
      for (const std::string& bytes : all)
      {
        for (Unpacker unpacker(bytes); !unpacker.atEnd();)
        {
          pieces.push_back(unpacker.take());
        }
      }
      if (run.Team.isFirst())
      {
        run.Statistics.MeshBytes = publishPieces(run.Result, pieces);
      }
    });
}

} // namespace tipp

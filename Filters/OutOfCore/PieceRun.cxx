// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceRun.h"

#include "Engine/RankEngine.h"
#include "OutOfCore/FinishPieces.h"
#include "OutOfCore/LoadedPiece.h"
#include "OutOfCore/OutOfCoreMessages.h"
#include "Partitioned/GrowingPiece.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// A rank's part of a triangulation out of core. It loads its pieces one after the other, as many
/// at a time as fit in memory, triangulates their partitions in threads, and writes a piece's
/// results when its last partition is done.
///
/// Pieces are assigned to ranks in order; no rank is a master. A message for a partition goes to
/// the rank that has its piece. If that piece is loaded, the message goes to the partition's inbox;
/// otherwise it stays in memory until the sender's piece is on disk. So only messages of unfinished
/// pieces are in memory, and all others are in the results of finished pieces.
class PieceRun : private RankEngine<VertexMessage>
{
public:
  PieceRun(const PieceWork& work, const MemoryPlan& memory, int threads,
    const std::function<bool(double)>& progress, Communicator& ranks)
    : RankEngine(ranks, std::size_t(work.Plan.Partitions.size()),
        std::size_t(work.Points.starts().back()), progress)
    , Work(work)
    , Memory(memory)
    , Threads(threads)
    , Pieces(std::size_t(work.Plan.pieces()))
  {
  }

  /// See triangulatePieces().
  void run(const std::vector<char>& isDone)
  {
    this->writeEmptyPieces(isDone);
    this->prepare(isDone);
    this->Ranks.barrier(); // a rank that is not set up yet could not handle messages
    std::vector<std::function<void()>> parts(
      std::size_t(this->Threads) + 1, [this] { this->work(); });
    parts.front() = [this] { this->loadPieces(); };
    this->runThreads(parts, [](const std::function<void()>& part) { part(); });
  }

private:
  using Lock = std::unique_lock<std::mutex>;
  /// The state of a piece.
  struct Piece
  {
    std::int32_t Rank = 0; ///< the rank that triangulates it
    PartitionIndex PartitionsLeft = 0;
    std::unique_ptr<LoadedPiece> Loaded;
    std::unique_ptr<StoredResult> Result; ///< once it is done; only if this rank needs it
    SentMessages Pending;                 ///< messages to its partitions, until it is loaded
  };

  bool isOwn(PartitionIndex piece) const { return this->at(piece).Rank == this->Ranks.rank(); }
  Piece& at(PartitionIndex piece) { return this->Pieces[std::size_t(piece)]; }
  const Piece& at(PartitionIndex piece) const { return this->Pieces[std::size_t(piece)]; }
  PartitionIndex pieceOf(PartitionIndex partition) const
  {
    return this->Work.Plan.PieceOf[std::size_t(partition)];
  }

  std::int32_t ownerOf(PartitionIndex p) const override { return this->at(this->pieceOf(p)).Rank; }
  ReadyPartitions& source() override { return *this->Ready; }

  void put(PartitionIndex to, VertexMessage&& message) override
  {
    const Lock lock(this->Mutex);
    Piece& piece = this->at(this->pieceOf(to));
    if (piece.Loaded)
    {
      RankEngine::put(to, std::move(message));
    }
    else
    {
      piece.Pending.emplace_back(to, std::move(message));
    }
  }

  void setDoneHere(PartitionIndex p) override
  {
    const PartitionIndex piece = this->pieceOf(p);
    bool isLast = false;
    {
      const Lock lock(this->Mutex);
      isLast = --this->at(piece).PartitionsLeft == 0;
    }
    this->Ready->finish(p);
    if (isLast && !this->Ready->isStopped())
    {
      this->finishPiece(piece);
    }
  }

  void receive(const Message& message) override
  {
    if (message.Kind != PieceMessage)
    {
      RankEngine::receive(message);
      return;
    }
    const auto piece = unpacked<PartitionIndex>(message.Content);
    if (piece < 0 || std::size_t(piece) >= this->Pieces.size() ||
      this->at(piece).Rank != message.Source)
    {
      throw std::runtime_error("A message from another rank is damaged: no such piece.");
    }
    // Once this rank's pieces are done, it does not need the result, and the first rank may have
    // removed it.
    if (!this->isFinished())
    {
      const Lock lock(this->Mutex);
      this->setPieceDone(piece);
    }
    this->PointsDone += std::size_t(this->Work.Points.count(piece));
    this->AwaitedPieces -= this->Ranks.isFirst() ? 1 : 0;
  }

  bool isFinished() const override { return this->LeftPartitions == 0 && this->AwaitedPieces == 0; }

  void prepare(const std::vector<char>& isDone)
  {
    const PiecePlan& plan = this->Work.Plan;
    this->OrderOfPieces = std::make_unique<PieceOrder>(plan, this->Work.Points, this->Threads);
    if (this->Work.takesBordersEarly())
    {
      this->Borders = std::make_unique<BorderQueue>(plan, this->OrderOfPieces->partitions());
    }
    const std::vector<PartitionIndex>& sequence = this->OrderOfPieces->sequence();
    std::vector<char> isPending(this->Inboxes.size(), 0);
    std::vector<PartitionIndex> left;
    for (std::size_t i = 0; i < sequence.size(); ++i)
    {
      const PartitionIndex piece = sequence[i];
      const PartitionIndex begin = plan.FirstPartition[std::size_t(piece)];
      const PartitionIndex end = plan.FirstPartition[std::size_t(piece) + 1];
      this->at(piece).Rank = std::int32_t(i % std::size_t(this->Ranks.size()));
      if (isDone[std::size_t(piece)])
      {
        this->PointsDone += std::size_t(this->Work.Points.count(piece));
        continue;
      }
      this->at(piece).PartitionsLeft = end - begin;
      this->AwaitedPieces += this->Ranks.isFirst() && !this->isOwn(piece) ? 1 : 0;
      for (PartitionIndex p = begin; p < end; ++p)
      {
        isPending[std::size_t(p)] = char(this->isOwn(piece));
        left.push_back(p);
      }
    }
    this->begin(this->OrderOfPieces->partitions(), left);
    // All processes make the same messages and keep those for their own pieces.
    for (auto& [to, message] :
      sendInitialMesh(this->OrderOfPieces->takeInitialMesh(), this->OrderOfPieces->partitions()))
    {
      if (isPending[std::size_t(to)])
      {
        this->put(to, std::move(message));
      }
    }
    this->Ready = std::make_unique<ReadyPartitions>(
      this->OrderOfPieces->partitions(), ReadyPartitions::Waits::ForEarlierAndLoad, isPending);
    for (PartitionIndex piece : sequence)
    {
      if (isDone[std::size_t(piece)])
      {
        this->setPieceDone(piece);
        const PartitionIndex end = plan.FirstPartition[std::size_t(piece) + 1];
        for (PartitionIndex p = plan.FirstPartition[std::size_t(piece)]; p < end; ++p)
        {
          this->Ready->finish(p);
        }
      }
    }
  }

  /// Pieces without points may still own triangles, so they have files, too.
  void writeEmptyPieces(const std::vector<char>& isDone)
  {
    for (PartitionIndex piece = 0; this->Ranks.isFirst() && piece < this->Work.Plan.pieces();
         ++piece)
    {
      if (this->Work.Points.count(piece) == 0 && !isDone[std::size_t(piece)])
      {
        PieceResult result;
        InteriorContent none;
        none.First = this->Work.Points.first(piece);
        result.Interior =
          writeInterior(this->Work.Mesh, this->Work.Plan.number(piece), this->Work.Rows, none);
        StoredResult::write(this->Work.resultPath(piece), result);
      }
    }
  }

  void loadPieces()
  {
    for (const PartitionIndex piece : this->OrderOfPieces->sequence())
    {
      if (this->isOwn(piece) && this->at(piece).PartitionsLeft > 0)
      {
        this->waitForMemory(piece);
        if (this->Ready->isStopped())
        {
          return;
        }
        this->load(piece);
      }
    }
  }

  /// Reserves memory for the piece, or returns when the run is stopped.
  void waitForMemory(PartitionIndex piece)
  {
    constexpr std::chrono::milliseconds pause(10);
    const std::uint64_t bytes = LoadedPiece::bytesOf(this->Work, piece);
    Lock lock(this->Mutex);
    while (!this->Ready->isStopped() && this->LoadedBytes > 0 &&
      this->LoadedBytes + bytes > this->Memory.LoadedBytes)
    {
      this->Changed.wait_for(lock, pause);
    }
    this->LoadedBytes += bytes;
  }

  void load(PartitionIndex piece)
  {
    auto loaded = std::make_unique<LoadedPiece>(this->Work, piece);
    std::vector<const StoredResult*> results;
    {
      // From now on messages for its partitions go directly to their inboxes. Earlier messages are
      // in Pending or, if their sender's piece is done, in its result.
      const Lock lock(this->Mutex);
      this->at(piece).Loaded = std::move(loaded);
      for (auto& [to, message] : std::exchange(this->at(piece).Pending, {}))
      {
        this->Inboxes[std::size_t(to)].put(std::move(message));
      }
      for (const Piece& other : this->Pieces)
      {
        if (other.Result && other.Result->sentBytes(piece) > 0)
        {
          results.push_back(other.Result.get());
        }
      }
    }
    for (const StoredResult* result : results)
    {
      for (auto& [to, message] : result->readMessages(piece))
      {
        this->Inboxes.at(std::size_t(to)).put(std::move(message));
      }
    }
    const PartitionIndex end = this->Work.Plan.FirstPartition[std::size_t(piece) + 1];
    for (PartitionIndex p = this->Work.Plan.FirstPartition[std::size_t(piece)]; p < end; ++p)
    {
      this->Ready->setLoaded(p);
    }
  }

  void work()
  {
    LoadedPiece::Workspace space(*this->OrderOfPieces);
    for (PartitionIndex p = this->take(); p != NoPartition; p = this->take())
    {
      LoadedPiece& piece = *this->at(this->pieceOf(p)).Loaded;
      const auto points = std::size_t(piece.pointsOf(p));
      this->finish(p, piece.triangulate(space, p, this->Inboxes[std::size_t(p)].take()), points);
    }
  }

  void finishPiece(PartitionIndex piece)
  {
    PieceResult result = this->at(piece).Loaded->write();
    StoredResult::write(this->Work.resultPath(piece), result);
    std::vector<PartitionIndex> borders;
    {
      const Lock lock(this->Mutex);
      this->at(piece).Loaded.reset();
      borders = this->setPieceDone(piece);
    }
    this->takeBorders(borders);
    {
      const Lock lock(this->Mutex);
      this->LoadedBytes -= LoadedPiece::bytesOf(this->Work, piece);
    }
    for (int to = 0; to < this->Ranks.size(); ++to)
    {
      if (to != this->Ranks.rank())
      {
        this->queue(to, PieceMessage, packed(piece));
      }
    }
  }

  /// Records that the piece's result is on disk. Returns the pieces whose borders can now be passed
  /// to the consumer.
  std::vector<PartitionIndex> setPieceDone(PartitionIndex piece)
  {
    this->at(piece).Result = std::make_unique<StoredResult>(this->Work.resultPath(piece));
    for (const PartitionIndex other : this->OrderOfPieces->sequence())
    {
      if (this->at(piece).Result->sentBytes(other) == 0)
      {
        continue;
      }
      SentMessages& pending = this->at(other).Pending;
      const auto isOfPiece = [&](const SentMessages::value_type& sent)
      { return sent.second.Sender != NoPartition && this->pieceOf(sent.second.Sender) == piece; };
      pending.erase(std::remove_if(pending.begin(), pending.end(), isOfPiece), pending.end());
    }
    return this->Borders ? this->Borders->setDone(piece) : std::vector<PartitionIndex>();
  }

  /// Passes borders to the consumer. Must happen before other ranks learn that this piece is done:
  /// once all pieces are done, PieceRun passes nothing more. If two ranks finish at the same time
  /// and miss a border, finishPieces() passes it.
  void takeBorders(const std::vector<PartitionIndex>& pieces)
  {
    const auto resultOf = [this](PartitionIndex piece) -> const StoredResult&
    {
      const Lock lock(this->Mutex);
      return *this->at(piece).Result;
    };
    for (const PartitionIndex piece : pieces)
    {
      takeBorder(this->Work, piece, resultOf);
    }
  }

  const PieceWork Work;
  const MemoryPlan& Memory;
  const int Threads;
  std::unique_ptr<PieceOrder> OrderOfPieces;
  std::unique_ptr<ReadyPartitions> Ready;
  std::size_t AwaitedPieces = 0; ///< on the first rank: other ranks' pieces that are not done

  // Protected by Mutex.
  std::vector<Piece> Pieces;
  std::unique_ptr<BorderQueue> Borders; ///< null: no consumer
  std::uint64_t LoadedBytes = 0;
};

} // namespace

void triangulatePieces(const PieceWork& work, const MemoryPlan& memory, int threads,
  const std::function<bool(double)>& progress, Communicator& ranks, const std::vector<char>& isDone)
{
  PieceRun(work, memory, threads, progress, ranks).run(isDone);
}

} // namespace tipp

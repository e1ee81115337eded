// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceRun.h"

#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Partitioned/GrowingPiece.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

namespace tipp
{

PieceRun::PieceRun(const PieceWork& work, const MemoryPlan& memory, int threads,
  const std::function<bool(double)>& progress, Communicator& ranks)
  : RankEngine(ranks, std::size_t(work.Plan.Partitions.size()),
      std::size_t(work.Points.starts().back()), progress)
  , Work(work)
  , Memory(memory)
  , Threads(threads)
  , Pieces(std::size_t(work.Plan.pieces()))
{
}

void PieceRun::prepare(const std::vector<char>& isDone)
{
  const PiecePlan& plan = this->Work.Plan;
  this->OrderOfPieces = std::make_unique<PieceOrder>(plan, this->Work.Points, this->Threads);
  if (this->Work.takesBordersEarly())
  {
    this->Borders = std::make_unique<BorderQueue>(plan, this->OrderOfPieces->partitions());
  }
  const std::vector<PartitionIndex>& sequence = this->OrderOfPieces->sequence();
  std::vector<char> isToDo(this->Inboxes.size(), 0);
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
      isToDo[std::size_t(p)] = char(this->isOwn(piece));
      left.push_back(p);
    }
  }
  this->begin(this->OrderOfPieces->partitions(), left);
  // All processes make the same messages and keep those for their own pieces.
  for (auto& [to, message] :
    sendInitialMesh(this->OrderOfPieces->takeInitialMesh(), this->OrderOfPieces->partitions()))
  {
    if (isToDo[std::size_t(to)])
    {
      this->put(to, std::move(message));
    }
  }
  this->Ready = std::make_unique<ReadyPartitions>(
    this->OrderOfPieces->partitions(), ReadyPartitions::Waits::ForEarlierAndLoad, isToDo);
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
void PieceRun::writeEmptyPieces(const std::vector<char>& isDone)
{
  for (PartitionIndex piece = 0; this->Ranks.isFirst() && piece < this->Work.Plan.pieces(); ++piece)
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

/// Records that the piece's result is on disk. Returns the pieces whose borders can now be passed
/// to the consumer.
std::vector<PartitionIndex> PieceRun::setPieceDone(PartitionIndex piece)
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
    { return sent.second.Sender >= 0 && this->pieceOf(sent.second.Sender) == piece; };
    pending.erase(std::remove_if(pending.begin(), pending.end(), isOfPiece), pending.end());
  }
  return this->Borders ? this->Borders->setDone(piece) : std::vector<PartitionIndex>();
}

/// Passes borders to the consumer. Must happen before other ranks learn that this piece is done:
/// once all pieces are done, PieceRun passes nothing more. If two ranks finish at the same time and
/// miss a border, finishPieces() passes it.
void PieceRun::takeBorders(const std::vector<PartitionIndex>& pieces)
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

void PieceRun::loadPieces()
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
void PieceRun::waitForMemory(PartitionIndex piece)
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

void PieceRun::load(PartitionIndex piece)
{
  auto loaded = std::make_unique<LoadedPiece>(this->Work, piece);
  std::vector<const StoredResult*> results;
  {
    // From now on messages for its partitions go directly to their inboxes. Earlier messages are in
    // Pending or, if their sender's piece is done, in its result.
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

void PieceRun::work()
{
  LoadedPiece::Workspace space(*this->OrderOfPieces);
  for (PartitionIndex p = this->take(); p >= 0; p = this->take())
  {
    LoadedPiece& piece = *this->at(this->pieceOf(p)).Loaded;
    const auto points = std::size_t(piece.pointsOf(p));
    this->finish(p, piece.triangulate(space, p, this->Inboxes[std::size_t(p)].take()), points);
  }
}

void PieceRun::put(PartitionIndex to, VertexMessage&& message)
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

void PieceRun::setDoneHere(PartitionIndex p)
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

void PieceRun::finishPiece(PartitionIndex piece)
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

void PieceRun::receive(const Message& message)
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

bool PieceRun::isFinished() const
{
  return this->LeftPartitions == 0 && this->AwaitedPieces == 0;
}

void PieceRun::run(const std::vector<char>& isDone)
{
  this->writeEmptyPieces(isDone);
  this->prepare(isDone);
  this->Ranks.barrier(); // a rank that is not set up yet could not handle messages
  std::vector<std::function<void()>> parts(
    std::size_t(this->Threads) + 1, [this] { this->work(); });
  parts.front() = [this] { this->loadPieces(); };
  this->runThreads(parts, [](const std::function<void()>& part) { part(); });
}

} // namespace tipp

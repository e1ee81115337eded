// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceRun.h"

#include "OutOfCore/OutOfCoreTriangulation.h"
#include "Partitioned/GrowingPiece.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>
#include <utility>

namespace tipp
{

PieceRun::PieceRun(const PieceWork& work, const MemoryPlan& memory, int threads,
  std::function<bool(std::int64_t)> progress, Communicator* ranks)
  : Work(work)
  , Memory(memory)
  , Threads(threads)
  , Progress(std::move(progress))
  , Post(ranks)
  , Inboxes(std::size_t(work.Plan.Partitions.size()))
  , Pieces(std::size_t(work.Plan.pieces()))
{
}

void PieceRun::prepare(const std::vector<char>& isDone)
{
  const PiecePlan& plan = this->Work.Plan;
  this->Order = std::make_unique<PieceOrder>(plan, this->Work.Points, this->Threads);
  if (this->Work.takesBordersEarly())
  {
    this->Borders = std::make_unique<BorderQueue>(plan, this->Order->partitions());
  }
  const std::vector<PartitionIndex>& sequence = this->Order->sequence();
  const std::size_t ranks = this->Post ? std::size_t(this->Post->size()) : 1;
  std::vector<char> isToDo(this->Inboxes.size(), 0);
  for (std::size_t i = 0; i < sequence.size(); ++i)
  {
    const PartitionIndex piece = sequence[i];
    const PartitionIndex begin = plan.FirstPartition[std::size_t(piece)];
    const PartitionIndex end = plan.FirstPartition[std::size_t(piece) + 1];
    this->at(piece).Rank = int(i % ranks);
    if (isDone[std::size_t(piece)])
    {
      this->PointsDone += this->Work.Points.count(piece);
      continue;
    }
    this->at(piece).PartitionsLeft = end - begin;
    this->PiecesLeft += this->isOwn(piece) || this->rank() == 0 ? 1 : 0;
    std::fill(isToDo.begin() + begin, isToDo.begin() + end, char(this->isOwn(piece)));
  }
  // All processes make the same messages and keep those for their own pieces. A triangle with a
  // true corner meets the corner's partition. So triangles that meet no partition have only
  // artificial corners, which the hull repair does not need.
  FinalBoundary<std::int64_t> none;
  sendInitialMesh(
    this->Order->takeInitialMesh(), this->Order->partitions(),
    [&](PartitionIndex to, VertexMessage&& message)
    {
      if (isToDo[std::size_t(to)])
      {
        this->at(this->pieceOf(to)).Pending.emplace_back(to, std::move(message));
      }
    },
    none);
  this->Ready = std::make_unique<ReadyPartitions>(
    this->Order->partitions(), ReadyPartitions::Waits::ForEarlierAndLoad, isToDo);
  for (PartitionIndex piece : sequence)
  {
    if (isDone[std::size_t(piece)])
    {
      this->setDone(piece);
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
  for (PartitionIndex piece = 0; this->rank() == 0 && piece < this->Work.Plan.pieces(); ++piece)
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
std::vector<PartitionIndex> PieceRun::setDone(PartitionIndex piece)
{
  this->at(piece).Result = std::make_unique<StoredResult>(this->Work.resultPath(piece));
  for (const PartitionIndex other : this->Order->sequence())
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
    isBorderTaken(this->Work, piece) ? void() : takeBorder(this->Work, piece, resultOf);
  }
}

void PieceRun::loadPieces()
{
  for (const PartitionIndex piece : this->Order->sequence())
  {
    const bool isToDo = this->isOwn(piece) && this->at(piece).PartitionsLeft > 0;
    if (isToDo && !this->waitForMemory(piece))
    {
      return;
    }
    if (isToDo)
    {
      this->load(piece);
    }
  }
}

/// Reserves memory for the piece. Returns false if the run was stopped.
bool PieceRun::waitForMemory(PartitionIndex piece)
{
  const std::uint64_t bytes = LoadedPiece::bytesOf(this->Work, piece);
  Lock lock(this->Mutex);
  this->Changed.wait(lock,
    [&]
    {
      return this->Ready->isStopped() || this->LoadedBytes == 0 ||
        this->LoadedBytes + bytes <= this->Memory.LoadedBytes;
    });
  this->LoadedBytes += bytes;
  return !this->Ready->isStopped();
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
  LoadedPiece::Workspace space(*this->Order);
  for (PartitionIndex p = this->Ready->take(); p >= 0; p = this->Ready->take())
  {
    LoadedPiece& piece = *this->at(this->pieceOf(p)).Loaded;
    this->finishPartition(p, piece.triangulate(space, p, this->Inboxes[std::size_t(p)].take()));
    if (!this->reportProgress())
    {
      this->stop(nullptr);
    }
  }
}

void PieceRun::finishPartition(PartitionIndex p, SentMessages&& sent)
{
  const PartitionIndex piece = this->pieceOf(p);
  bool isLast = false;
  {
    const Lock lock(this->Mutex);
    this->PointsDone += this->at(piece).Loaded->pointsOf(p);
    this->sendToRanks(p, sent);
    for (auto& [to, message] : sent)
    {
      if (this->isOwn(this->pieceOf(to)))
      {
        this->deliver(to, std::move(message));
      }
    }
    isLast = --this->at(piece).PartitionsLeft == 0;
  }
  this->Ready->finish(p);
  if (isLast && !this->Ready->isStopped())
  {
    this->finishPiece(piece);
  }
}

/// Call with the mutex locked. Notifies other ranks that partition p is done: one message, with the
/// vertices sent there, to each rank that has a later conflicting partition.
void PieceRun::sendToRanks(PartitionIndex p, const SentMessages& sent)
{
  if (!this->hasOtherRanks())
  {
    return;
  }
  const auto rankOf = [this](PartitionIndex q) { return this->at(this->pieceOf(q)).Rank; };
  std::set<int> ranks;
  for (const PartitionIndex q : this->Order->partitions().later(p))
  {
    ranks.insert(rankOf(q));
  }
  ranks.erase(this->rank());
  for (const int to : ranks)
  {
    this->ToSend.push_back({ to, PartitionMessage,
      writeDone(p, sent, [&](PartitionIndex q) { return rankOf(q) == to; }) });
  }
}

/// Call with the mutex locked.
void PieceRun::deliver(PartitionIndex to, VertexMessage message)
{
  Piece& piece = this->at(this->pieceOf(to));
  if (piece.Loaded)
  {
    this->Inboxes[std::size_t(to)].put(std::move(message));
  }
  else
  {
    piece.Pending.emplace_back(to, std::move(message));
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
    borders = this->setDone(piece);
  }
  this->takeBorders(borders);
  const Lock lock(this->Mutex);
  this->LoadedBytes -= LoadedPiece::bytesOf(this->Work, piece);
  --this->PiecesLeft;
  for (int to = 0; this->hasOtherRanks() && to < this->Post->size(); ++to)
  {
    if (to != this->rank())
    {
      SaveArchive writer;
      writer(piece);
      this->ToSend.push_back({ to, PieceMessage, writer.take() });
    }
  }
  this->Changed.notify_all();
}

/// Runs until all pieces that this rank waits for are done; on ranks other than the first, until
/// the first rank ends the run.
void PieceRun::coordinate()
{
  constexpr auto pause = std::chrono::microseconds(300);
  for (;;)
  {
    const bool moved = this->sendAndReceive();
    if (!this->reportProgress())
    {
      throw RankFailure(this->rank(), true, "The run was stopped.");
    }
    {
      const Lock lock(this->Mutex);
      const bool isEnded = this->rank() == 0 ? this->PiecesLeft == 0 : this->IsEnded;
      if (this->Ready->isStopped() || (isEnded && this->ToSend.empty()))
      {
        return;
      }
    }
    if (!moved)
    {
      std::this_thread::sleep_for(pause);
    }
  }
}

/// Returns false if there was nothing to do.
bool PieceRun::sendAndReceive()
{
  std::vector<Outgoing> outgoing;
  {
    const Lock lock(this->Mutex);
    outgoing.swap(this->ToSend);
  }
  bool moved = !outgoing.empty();
  for (Outgoing& message : outgoing)
  {
    this->Post->post(message.Rank, message.Kind, std::move(message.Content));
  }
  for (Message message; this->Post->poll(message); moved = true)
  {
    this->receive(message);
  }
  return moved;
}

void PieceRun::receive(const Message& message)
{
  if (message.Kind == EndMessage)
  {
    this->IsEnded = true;
    return;
  }
  if (message.Kind == PartitionMessage)
  {
    this->receivePartition(message);
    return;
  }
  const auto piece = unpacked<PartitionIndex>(message.Content);
  const Lock lock(this->Mutex);
  if (message.Kind != PieceMessage || piece < 0 || std::size_t(piece) >= this->Pieces.size() ||
    this->at(piece).Rank != message.Source)
  {
    throw std::runtime_error("A message from another rank is damaged: no such piece.");
  }
  if (this->PiecesLeft == 0)
  {
    return; // no piece of this rank needs the result, and the first rank may have removed it
  }
  this->setDone(piece);
  this->PiecesLeft -= this->rank() == 0 ? 1 : 0;
}

/// A partition of another rank is done: passes on the vertices that it sends to this rank's
/// partitions.
void PieceRun::receivePartition(const Message& message)
{
  PartitionIndex sender = -1;
  SentMessages sent = readDone<VertexMessage>(message.Content, this->Inboxes.size(), sender);
  const auto rankOf = [this](PartitionIndex p) { return this->at(this->pieceOf(p)).Rank; };
  if (rankOf(sender) != message.Source ||
    std::any_of(
      sent.begin(), sent.end(), [&](const auto& to) { return rankOf(to.first) != this->rank(); }))
  {
    throw std::runtime_error(
      "A message from another rank is damaged: it is for a partition of another rank.");
  }
  {
    const Lock lock(this->Mutex);
    for (auto& [to, vertices] : sent)
    {
      this->deliver(to, std::move(vertices));
    }
  }
  this->Ready->finish(sender);
}

/// Reports progress, in the caller's thread only. Returns false if that stops the run.
bool PieceRun::reportProgress()
{
  if (std::this_thread::get_id() != this->Caller)
  {
    return true;
  }
  std::int64_t done = 0;
  {
    const Lock lock(this->Mutex);
    done = this->PointsDone;
  }
  return std::exchange(this->PointsTold, done) == done || this->Progress(done);
}

void PieceRun::stop(const std::exception_ptr& reason)
{
  this->Ready->stop(reason);
  const Lock lock(this->Mutex); // otherwise the loading thread could miss the notification
  this->Changed.notify_all();
}

void PieceRun::guard(const std::function<void()>& body)
{
  try
  {
    body();
  }
  catch (...)
  {
    this->stop(std::current_exception());
  }
}

void PieceRun::runThreads()
{
  std::vector<std::thread> threads;
  this->guard(
    [&]
    {
      threads.emplace_back([this] { this->guard([this] { this->loadPieces(); }); });
      for (int i = this->hasOtherRanks() ? 0 : 1; i < this->Threads; ++i)
      {
        threads.emplace_back([this] { this->guard([this] { this->work(); }); });
      }
      this->hasOtherRanks() ? this->coordinate() : this->work();
    });
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (this->Ready->failure())
  {
    std::rethrow_exception(this->Ready->failure());
  }
}

bool PieceRun::run(const std::vector<char>& isDone)
{
  this->writeEmptyPieces(isDone);
  this->prepare(isDone);
  if (this->hasOtherRanks())
  {
    this->Post->barrier(); // a rank that is not set up yet could not handle messages
  }
  this->runThreads();
  return !this->Ready->isStopped() && this->reportProgress();
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
// The part of PieceRun that has other ranks work, too, and finishes pieces wherever they are.
#include "OutOfCore/PieceMessages.h"
#include "OutOfCore/PieceRun.h"

#include <chrono>
#include <utility>

namespace tipp
{

/// When all of its partitions are finished. Of another rank's piece only the thread that speaks to
/// other ranks learns this.
void PieceRun::finishPiece(PartitionIndex piece, Lock& lock)
{
  const InteriorTask task = this->Schedule->startInterior(piece);
  const int rank = this->Schedule->rankOf(piece);
  if (rank > 0)
  {
    this->Post->post(rank, WriteMessage, pack(task));
    return;
  }
  lock.unlock();
  GrowingPiece interior = this->Own.writeInterior(task);
  lock.lock();
  this->takeInterior(piece, std::move(interior));
}

/// Of the thread that speaks to other ranks, as long as one of them works.
void PieceRun::serve()
{
  constexpr std::chrono::microseconds moment(500);
  for (;;)
  {
    Message message;
    while (this->Post->poll(message))
    {
      this->take(message);
    }
    Lock lock(this->Mutex);
    this->tell(lock);
    if (this->Stopped || this->Schedule->allInterior())
    {
      return;
    }
    if (!this->giveOrders())
    {
      this->Changed.wait_for(lock, moment);
    }
  }
}

/// From another rank.
void PieceRun::take(const Message& message)
{
  if (message.Kind == PartitionMessage)
  {
    PartitionResult result;
    unpack(message.Content, result);
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      ++this->Ranks[std::size_t(message.Source)].IdleThreads;
    }
    this->bringBack(std::move(result));
    return;
  }
  Lock lock(this->Mutex);
  Rank& rank = this->Ranks[std::size_t(message.Source)];
  if (message.Kind == WrittenMessage)
  {
    WrittenInterior written;
    unpack(message.Content, written);
    this->takeInterior(written.Piece, std::move(written.Growing));
    this->writeBorders(lock);
    this->saveSometimes();
    return;
  }
  std::int32_t number = 0;
  unpack(message.Content, number);
  if (message.Kind == LoadedMessage)
  {
    rank.IsLoading = false;
    this->addLoaded(number, message.Source, lock);
  }
  else if (message.Kind == ReadyMessage)
  {
    rank.IsReady = true;
    rank.IdleThreads = number;
  }
}

/// Pieces to load, and partitions to triangulate, for ranks that can take them. False if there are
/// none now.
bool PieceRun::giveOrders()
{
  bool isGiven = false;
  for (int to = 1; to < int(this->Ranks.size()); ++to)
  {
    Rank& rank = this->Ranks[std::size_t(to)];
    LoadOrder order;
    order.Piece = rank.IsLoading || !rank.IsReady ? -1 : this->takeToLoad(to);
    if (order.Piece >= 0)
    {
      order.Finished = this->Schedule->finishedPartitions(order.Piece);
      this->Post->post(to, LoadMessage, pack(order));
      this->Changed.notify_all(); // it may have been the last that waited
      rank.IsLoading = isGiven = true;
    }
    PartitionTask task;
    while (rank.IdleThreads > 0 &&
      (task.Partition = this->Schedule->activateNext(task.Vertices, to)) >= 0)
    {
      this->Post->post(to, TriangulateMessage, pack(task));
      --rank.IdleThreads;
      isGiven = true;
    }
  }
  return isGiven;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/ReadyPartitions.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace tipp
{
namespace
{

/// A short wait leaves the core to another thread; longer ones let it rest.
void waitAWhile(int turn)
{
  constexpr int yields = 32;
  if (turn < yields)
  {
    std::this_thread::yield();
  }
  else
  {
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
}

} // namespace

ReadyPartitions::ReadyPartitions(const PartitionOrder& order, bool barrierBetweenColours)
  : Order(order)
  , Barrier(barrierBetweenColours && !order.isTotal())
  , Awaited(order.partitionCount())
  , LeftInColour(this->Barrier ? order.colourCount() : 0)
  , Queue(order.sequence().size())
{
  for (auto& place : this->Queue)
  {
    place.store(-1, std::memory_order_relaxed);
  }
  if (this->Barrier)
  {
    for (std::size_t colour = 0; colour < order.colourCount(); ++colour)
    {
      this->LeftInColour[colour] = std::int64_t(order.ofColour(colour).size());
    }
  }
  else if (!order.isTotal())
  {
    for (const PartitionIndex p : order.sequence())
    {
      for (const PartitionIndex later : order.later(p))
      {
        ++this->Awaited[std::size_t(later)];
      }
    }
  }
  if (order.colourCount() > 0)
  {
    for (const PartitionIndex p : order.ofColour(0))
    {
      this->release(p);
    }
  }
}

void ReadyPartitions::release(PartitionIndex p)
{
  const std::size_t place = this->QueueEnd.fetch_add(1, std::memory_order_relaxed);
  this->Queue[place].store(p, std::memory_order_release);
}

PartitionIndex ReadyPartitions::take()
{
  const std::size_t ticket = this->Tickets.fetch_add(1, std::memory_order_relaxed);
  if (ticket >= this->Queue.size())
  {
    return -1;
  }
  for (int turn = 0; !this->isStopped(); ++turn)
  {
    const PartitionIndex p = this->Queue[ticket].load(std::memory_order_acquire);
    if (p >= 0)
    {
      return p;
    }
    waitAWhile(turn);
  }
  return -1;
}

void ReadyPartitions::finish(PartitionIndex p)
{
  if (this->Barrier)
  {
    const std::size_t colour = this->Order.colourOf(p);
    const bool isLast = this->LeftInColour[colour].fetch_sub(1, std::memory_order_acq_rel) == 1;
    if (isLast && colour + 1 < this->Order.colourCount())
    {
      for (const PartitionIndex next : this->Order.ofColour(colour + 1))
      {
        this->release(next);
      }
    }
    return;
  }
  const PartitionOrder::Range later = this->Order.later(p);
  if (this->Order.isTotal())
  {
    if (later.size() > 0)
    {
      this->release(*later.begin());
    }
    return;
  }
  for (const PartitionIndex q : later)
  {
    if (this->Awaited[std::size_t(q)].fetch_sub(1, std::memory_order_acq_rel) == 1)
    {
      this->release(q);
    }
  }
}

void ReadyPartitions::stop(const std::exception_ptr& reason)
{
  const std::lock_guard<std::mutex> lock(this->FailureMutex);
  if (reason && !this->Failure)
  {
    this->Failure = reason;
  }
  this->Stopped = true;
}

} // namespace tipp

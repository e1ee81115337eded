// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/ReadyPartitions.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

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

ReadyPartitions::ReadyPartitions(const PartitionOrder& order, Waits waits, std::vector<char> isOwn)
  : Order(order)
  , For(waits)
  , Own(std::move(isOwn))
  , Awaited(order.partitionCount())
  , LeftInColour(waits == Waits::ForColour ? order.colourCount() : 0)
  , Queue(this->ownCount())
{
  for (auto& entry : this->Queue)
  {
    entry.store(-1, std::memory_order_relaxed);
  }
  waits == Waits::ForColour ? this->countColours() : this->awaitEarlier();
}

std::size_t ReadyPartitions::ownCount() const
{
  const auto& sequence = this->Order.sequence();
  return std::size_t(std::count_if(
    sequence.begin(), sequence.end(), [this](PartitionIndex p) { return this->isOwn(p); }));
}

void ReadyPartitions::countColours()
{
  for (std::size_t colour = 0; colour < this->Order.colourCount(); ++colour)
  {
    this->LeftInColour[colour] = std::int64_t(this->Order.colourSize(colour));
  }
  if (this->Order.colourCount() > 0)
  {
    this->releaseColour(0);
  }
}

void ReadyPartitions::awaitEarlier()
{
  for (const PartitionIndex p : this->Order.sequence())
  {
    this->Awaited[std::size_t(p)] += this->For == Waits::ForEarlier ? 0 : 1;
    if (this->For != Waits::ForLoad)
    {
      for (const PartitionIndex later : this->Order.later(p))
      {
        ++this->Awaited[std::size_t(later)];
      }
    }
  }
  for (const PartitionIndex p : this->Order.sequence())
  {
    if (this->Awaited[std::size_t(p)] == 0 && this->isOwn(p))
    {
      this->release(p);
    }
  }
}

/// The order has no windows: a colour's partitions come in a row.
void ReadyPartitions::releaseColour(std::size_t colour)
{
  const auto& sequence = this->Order.sequence();
  const auto first = std::partition_point(sequence.begin(), sequence.end(),
    [&](PartitionIndex p) { return this->Order.colourOf(p) < colour; });
  std::for_each(first, first + std::ptrdiff_t(this->Order.colourSize(colour)),
    [this](PartitionIndex p)
    {
      if (this->isOwn(p))
      {
        this->release(p);
      }
    });
}

void ReadyPartitions::release(PartitionIndex p)
{
  const std::size_t end = this->QueueEnd.fetch_add(1, std::memory_order_relaxed);
  this->Queue[end].store(p, std::memory_order_release);
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

PartitionIndex ReadyPartitions::tryTake()
{
  const std::size_t ticket = this->Tickets.load(std::memory_order_relaxed);
  const PartitionIndex p = ticket < this->Queue.size() && !this->isStopped()
    ? this->Queue[ticket].load(std::memory_order_acquire)
    : -1;
  if (p >= 0)
  {
    this->Tickets.store(ticket + 1, std::memory_order_relaxed);
  }
  return p;
}

void ReadyPartitions::finish(PartitionIndex p)
{
  if (this->For == Waits::ForLoad)
  {
    return;
  }
  if (this->For == Waits::ForColour)
  {
    const std::size_t colour = this->Order.colourOf(p);
    const bool isLast = this->LeftInColour[colour].fetch_sub(1, std::memory_order_acq_rel) == 1;
    if (isLast && colour + 1 < this->Order.colourCount())
    {
      this->releaseColour(colour + 1);
    }
    return;
  }
  for (const PartitionIndex q : this->Order.later(p))
  {
    this->countDown(q);
  }
}

void ReadyPartitions::countDown(PartitionIndex p)
{
  if (this->isOwn(p) && this->Awaited[std::size_t(p)].fetch_sub(1, std::memory_order_acq_rel) == 1)
  {
    this->release(p);
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
